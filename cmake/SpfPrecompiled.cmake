# Headers of other libraries, parsed once for many sources. Headers of the project are never among them, and every source
# includes what it uses: -D SPF_PRECOMPILE=OFF must build as well.
option(SPF_PRECOMPILE "Precompile headers of other libraries" ON)

# spf_precompiled(SET STANDARD LIBRARIES ... HEADERS ...): declares a set for sources of that C++ standard.
function(spf_precompiled SET STANDARD)
  cmake_parse_arguments(SET "" "" "LIBRARIES;HEADERS" ${ARGN})
  if(NOT SPF_PRECOMPILE)
    return()
  endif()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${SET}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Only its precompiled headers count.\n")
  add_library(${SET} OBJECT ${source})
  spf_compile_options(${SET} ${STANDARD})
  target_link_libraries(${SET} PRIVATE ${SET_LIBRARIES})
  target_precompile_headers(${SET} PRIVATE ${SET_HEADERS})
endfunction()

# spf_precompile(TARGET SET): the target's sources have the set's headers ready.
function(spf_precompile TARGET SET)
  if(SPF_PRECOMPILE)
    target_precompile_headers(${TARGET} REUSE_FROM ${SET})
  endif()
endfunction()

set(standard_headers <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <optional> <set> <sstream>
  <stdexcept> <string> <string_view> <unordered_map> <utility> <vector>)
spf_precompiled(spf_headers_17 17 LIBRARIES Eigen3::Eigen HEADERS ${standard_headers} <Eigen/Dense>)
set(host_headers "")
if(SPF_BUILD_APPS OR BUILD_ROS OR BUILD_ROS2)
  # Not those of JSON and of command lines: what they make every source instantiate costs it more than parsing them costs the few
  # that use them.
  set(host_headers <filesystem> <fstream> <iostream>)
  spf_precompiled(spf_headers_20 20 LIBRARIES Eigen3::Eigen HEADERS ${standard_headers} ${host_headers} <Eigen/Dense>)
endif()
if(SPF_BUILD_TESTS)
  spf_precompiled(spf_headers_tests 20 LIBRARIES Eigen3::Eigen GTest::gtest GTest::gmock
    HEADERS ${standard_headers} ${host_headers} <Eigen/Dense> <gmock/gmock.h> <gtest/gtest.h>)
endif()
