# `cmake --install` puts the library where find_package(spf) finds it. The core is target spf::spf, every room of spf/ but
# testing/, and needs Eigen alone. COMPONENTS of the package, each a folder or two of the repository:
#   host        spf::host, spf::config     robots' hosts, and parameter files for them (needs yaml-cpp)
#   simulator   spf::sim, spf::study, spf::simulator   the world, scenario files for it, and what serves it to robots
#               elsewhere (needs host, libpng and nlohmann-json)
#   report      spf::report                tables, charts, still pictures and replay pages (needs nlohmann-json)
#   experiments spf::experiments           trials and campaigns (needs simulator and report)
#   program     spf::apps                  the spf program as a function, for methods of one's own (needs experiments and CLI11)
include(CMakePackageConfigHelpers)

get_property(core_targets GLOBAL PROPERTY SPF_CORE_TARGETS)
add_library(spf_core INTERFACE)  # not `spf`: that name is the program's
add_library(spf::spf ALIAS spf_core)
set_target_properties(spf_core PROPERTIES EXPORT_NAME spf)
target_link_libraries(spf_core INTERFACE ${core_targets})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/spf)
set(test_files PATTERN "testing" EXCLUDE PATTERN "test" EXCLUDE PATTERN "*_test.hpp" EXCLUDE)

# spf_install_component(NAME rooms...): their libraries and headers, as export set spf_NAME.
function(spf_install_component NAME)
  foreach(room IN LISTS ARGN)
    string(REPLACE "/" "_" target spf_${room})
    if(NOT TARGET ${target})
      return()
    endif()
    install(TARGETS ${target} EXPORT spf_${NAME} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
    cmake_path(GET room PARENT_PATH above)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spf_rooms/${above} COMPONENT development
      FILES_MATCHING PATTERN "*.hpp" ${test_files} PATTERN "test_data" EXCLUDE)
  endforeach()
  install(EXPORT spf_${NAME} FILE spf_${NAME}.cmake NAMESPACE spf:: DESTINATION ${package_dir} COMPONENT development)
endfunction()

if(PROJECT_IS_TOP_LEVEL)
  install(TARGETS spf_core ${core_targets} EXPORT spfTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT spfTargets NAMESPACE spf:: DESTINATION ${package_dir} COMPONENT development)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/spf/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spf COMPONENT development
    FILES_MATCHING PATTERN "*.hpp" ${test_files})
  spf_install_component(host host config)
  spf_install_component(simulator sim study wire simulator)
  spf_install_component(report report)
  spf_install_component(experiments parallel experiments)
  spf_install_component(program ros2/messages mcap apps)

  configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/spfConfig.cmake.in
    ${PROJECT_BINARY_DIR}/spfConfig.cmake INSTALL_DESTINATION ${package_dir})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/spfConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/spfConfig.cmake ${PROJECT_BINARY_DIR}/spfConfigVersion.cmake
    DESTINATION ${package_dir} COMPONENT development)
endif()
