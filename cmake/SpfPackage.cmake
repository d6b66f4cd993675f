# Debian packages by CPack (script/package): spf (the program, its pages, scenarios and documents), libspf-dev (headers, static
# libraries, find_package(spf), examples) and python3-spf. Each is an install component: program, development, python.
if(NOT PROJECT_IS_TOP_LEVEL OR NOT SPF_BUILD_APPS OR SPF_SANITIZE)
  return()
endif()

# The man page and the completion are read off the program's help at every build, so they say what it says.
find_package(Python3 COMPONENTS Interpreter)
find_program(SPF_GZIP gzip)
if(NOT Python3_FOUND OR NOT SPF_GZIP)
  message(STATUS "Python 3 or gzip not found: no man page, no completion, no packages")
  return()
endif()
set(pages ${PROJECT_BINARY_DIR}/pages)
set(made ${pages}/spf ${pages}/spf.1.gz ${pages}/changelog.gz)
add_custom_command(OUTPUT ${made}
  COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/script/program_pages.py $<TARGET_FILE:spf> ${pages}
  COMMAND ${SPF_GZIP} -9nf ${pages}/spf.1
  COMMAND ${SPF_GZIP} -9nc ${PROJECT_SOURCE_DIR}/packaging/changelog > ${pages}/changelog.gz
  DEPENDS spf ${PROJECT_SOURCE_DIR}/script/program_pages.py ${PROJECT_SOURCE_DIR}/packaging/changelog
  COMMENT "Man page and completion of the program" VERBATIM)
add_custom_target(spf_pages ALL DEPENDS ${made})

install(FILES ${pages}/spf.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${pages}/spf DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(DIRECTORY scenarios DESTINATION ${CMAKE_INSTALL_DATADIR}/spf COMPONENT program)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spf/docs COMPONENT program
  FILES_MATCHING PATTERN "*.md" PATTERN "results" EXCLUDE PATTERN "examples" EXCLUDE)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libspf-dev COMPONENT development
  FILES_MATCHING PATTERN "*.[ch]pp" PATTERN "*.yaml" PATTERN "CMakeLists.txt" PATTERN "own_method/CMakeLists.txt" EXCLUDE)
if(TARGET spf_python)
  install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-spf COMPONENT python
    FILES_MATCHING PATTERN "*.py" PATTERN "yard.yaml" PATTERN "__pycache__" EXCLUDE)
endif()
foreach(component IN ITEMS program:spf development:libspf-dev python:python3-spf)
  string(REGEX MATCH "(.*):(.*)" _ ${component})
  if(CMAKE_MATCH_1 STREQUAL "python" AND NOT TARGET spf_python)
    continue()
  endif()
  install(FILES packaging/copyright ${pages}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CMAKE_MATCH_2} COMPONENT ${CMAKE_MATCH_1})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME spf)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "planner and simulator for robots among people")
set(CPACK_PACKAGE_CONTACT "SPF-EMPC contributors <spf-empc@spf-empc.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program development python)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME spf)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "The program spf simulates fleets of ground robots that reach
their goals among people and machines that move unpredictably, runs
experiments, and shows trials in a replay page. It holds the SPF-EMPC planner
and controller, a space-time planner, and baselines.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libspf-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)  # static libraries
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libeigen3-dev (>= 3.4), libyaml-cpp-dev, libpng-dev, nlohmann-json3-dev (>= 3.11), libcli11-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake (>= 3.25), g++, spf")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Headers, static libraries and CMake's find_package(spf) for
programs that plan for, control or simulate fleets of ground robots, with
examples.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-spf)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
# Python's byte code is made when the package is installed, and removed with it.
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/packaging/python/postinst ${PROJECT_SOURCE_DIR}/packaging/python/prerm)
if(SPF_PYTHON_VERSION MATCHES "^([0-9]+)\\.([0-9]+)$")
  math(EXPR next "${CMAKE_MATCH_2} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= ${SPF_PYTHON_VERSION}), python3 (<< ${CMAKE_MATCH_1}.${next}), python3-numpy")
endif()
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The Python module spf: scenarios, campaigns, the simulated world
step by step, and the parts of a robot as objects, with numpy.")
include(CPack)
