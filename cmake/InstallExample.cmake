# cmake -D BUILD_DIR=... -D CONFIG=... -D EXAMPLE_DIR=... -D CXX_COMPILER=... -P InstallExample.cmake
# Installs the built library into an empty prefix, then configures, builds and runs a program that knows it only by
# find_package(spf).
set(work ${BUILD_DIR}/install_example)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
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
run(${CMAKE_COMMAND} -S ${EXAMPLE_DIR} -B ${work}/build -D CMAKE_PREFIX_PATH=${work}/prefix
  -D CMAKE_CXX_COMPILER=${CXX_COMPILER} -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${work}/build --config Release)
file(GLOB program ${work}/build/minimal ${work}/build/Release/minimal)
run(${program})
