# Tests of the project itself: its architecture, and the installed package seen from outside. Once is enough, so not in the
# sanitizer builds. Format and lint are `script/check`, since they hold for one version of their tools.
if(NOT PROJECT_IS_TOP_LEVEL OR SPF_SANITIZE)
  return()
endif()

# Exit status 77 means that a tool is not installed; `script/test` installs them all, and sets SPF_REQUIRE_TOOLS, by which it is
# a failure.
function(spf_project_test NAME)
  add_test(NAME ${NAME} COMMAND ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(${NAME} PROPERTIES LABELS project TIMEOUT 900 COST 20 SKIP_RETURN_CODE 77)
endfunction()

find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
  spf_project_test(check_architecture ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_architecture.py)
  spf_project_test(check_architecture_catches ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_architecture_test.py)
  spf_project_test(check_limits ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_limits.py)
  spf_project_test(check_names ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_names.py)
  spf_project_test(check_limits_catches ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_limits_test.py)
  spf_project_test(check_names_catches ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_names_test.py)
  spf_project_test(check_paper_notes_catches ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_paper_notes_test.py)
  spf_project_test(check_citations ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_citations.py)
  spf_project_test(check_citations_catches ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_citations_test.py)
  spf_project_test(paper_notes_tests_exist ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_paper_notes.py)
  if(TARGET spf)
    spf_project_test(document_blocks ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_blocks.py $<TARGET_FILE:spf>)
    spf_project_test(document_blocks_catches ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/check_blocks_test.py $<TARGET_FILE:spf>)
    spf_project_test(program_pages ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/program_pages_test.py $<TARGET_FILE:spf>)
  endif()
endif()
spf_project_test(install_example ${CMAKE_COMMAND}
  -D BUILD_DIR=${PROJECT_BINARY_DIR} -D CONFIG=$<CONFIG> -D SOURCE_DIR=${PROJECT_SOURCE_DIR}
  -D CXX_COMPILER=${CMAKE_CXX_COMPILER} -D CCACHE=$<$<BOOL:${SPF_CCACHE}>:${SPF_CCACHE}>
  -P ${CMAKE_CURRENT_LIST_DIR}/InstallExample.cmake)
if(TARGET spf_python)
  spf_project_test(python_examples ${PROJECT_SOURCE_DIR}/script/example_pictures --python)
  set_tests_properties(python_examples PROPERTIES ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHON=${Python_EXECUTABLE}")
endif()
