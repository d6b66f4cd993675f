# cmake -D BUILD_DIR=... -D CONFIG=... -D SOURCE_DIR=... -D CXX_COMPILER=... -D CCACHE=... -P InstallExample.cmake
# Installs the built library into an empty prefix, then configures, builds and runs the examples, which know it only by
# find_package(spf). Each has to end well and to make its picture; script/example_pictures compares the pictures.
set(work ${BUILD_DIR}/install_example)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status WORKING_DIRECTORY ${SOURCE_DIR})
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}: ${status}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --config "${CONFIG}" --component development --prefix ${work}/prefix)
file(GLOB_RECURSE strays ${work}/prefix/*_test.* ${work}/prefix/include/spf/testing/*)
if(strays)
  message(FATAL_ERROR "test code was installed: ${strays}")
endif()
if(CCACHE)  # as for the library itself
  set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} ${CCACHE})
  set(ENV{CCACHE_BASEDIR} ${SOURCE_DIR})
  set(ENV{CCACHE_NOHASHDIR} 1)
  set(ENV{CCACHE_SLOPPINESS} pch_defines,time_macros)
endif()
# Type None: the library is optimised, and a quick compiler counts more than quick examples. What nobody set of a matrix is NaN,
# so that using it shows in every run.
run(${CMAKE_COMMAND} -S ${SOURCE_DIR}/examples -B ${work}/build -D CMAKE_PREFIX_PATH=${work}/prefix
  -D CMAKE_CXX_COMPILER=${CXX_COMPILER} -D CMAKE_BUILD_TYPE=None
  -D CMAKE_CXX_FLAGS=-DEIGEN_INITIALIZE_MATRICES_BY_NAN)
run(${CMAKE_COMMAND} --build ${work}/build --config Release)
run(${SOURCE_DIR}/script/example_pictures --programs ${work}/build)
