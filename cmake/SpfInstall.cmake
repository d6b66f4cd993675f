# `cmake --install` puts the core where find_package(spf) finds it: target spf::spf, every room of spf/ but testing/.
# Simulator, experiments and reports are not part of the package.
include(CMakePackageConfigHelpers)

get_property(core_targets GLOBAL PROPERTY SPF_CORE_TARGETS)
add_library(spf_core INTERFACE)  # not `spf`: that name is the program's
add_library(spf::spf ALIAS spf_core)
set_target_properties(spf_core PROPERTIES EXPORT_NAME spf)
target_link_libraries(spf_core INTERFACE ${core_targets})

if(PROJECT_IS_TOP_LEVEL)
  set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/spf)
  install(TARGETS spf_core ${core_targets} EXPORT spfTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT spfTargets NAMESPACE spf:: DESTINATION ${package_dir} COMPONENT development)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/spf/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/spf COMPONENT development
    FILES_MATCHING PATTERN "*.hpp" PATTERN "testing" EXCLUDE PATTERN "test" EXCLUDE PATTERN "*_test.hpp" EXCLUDE)

  configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/spfConfig.cmake.in
    ${PROJECT_BINARY_DIR}/spfConfig.cmake INSTALL_DESTINATION ${package_dir})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/spfConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/spfConfig.cmake ${PROJECT_BINARY_DIR}/spfConfigVersion.cmake
    DESTINATION ${package_dir} COMPONENT development)
endif()
