# The simulator: a world for robots whose nodes cannot tell it from hardware.
add_library(spf_empc_simulator STATIC
  src/simulator_config.cpp src/simulator_messages.cpp src/simulator_node.cpp)
spf_ros_options(spf_empc_simulator)
target_link_libraries(spf_empc_simulator PUBLIC spf_empc_ros spf::simulator)
spf_ros_node(simulator_node SOURCES src/simulator_node_main.cpp LIBRARIES spf_empc_simulator)
spf_ros_node(robot_file SOURCES src/robot_file_main.cpp LIBRARIES spf::simulator)
catkin_install_python(PROGRAMS scripts/fleet_rviz scripts/fleet_watch scripts/send_goal DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY launch config rviz DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})

if(CATKIN_ENABLE_TESTING)
  find_package(GTest REQUIRED)
  add_executable(spf_empc_simulator_tests
    test/composition_test.cpp test/package_files_test.cpp test/simulator_messages_test.cpp)
  spf_ros_options(spf_empc_simulator_tests)
  set_source_files_properties(test/package_files_test.cpp PROPERTIES COMPILE_DEFINITIONS
    SPF_EMPC_ROS_DIR="${CMAKE_CURRENT_SOURCE_DIR}")
  target_link_libraries(spf_empc_simulator_tests PRIVATE spf_empc_simulator GTest::gtest GTest::gtest_main)
  include(GoogleTest)
  gtest_discover_tests(spf_empc_simulator_tests DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES PROPERTIES LABELS ros TIMEOUT 300)
  add_test(NAME fleet_rviz_is_as_generated COMMAND ${CMAKE_COMMAND} -E env bash -c
    "'${CMAKE_CURRENT_SOURCE_DIR}/scripts/fleet_rviz' --robots 5 --print | cmp - '${CMAKE_CURRENT_SOURCE_DIR}/rviz/fleet.rviz'")
  set_tests_properties(fleet_rviz_is_as_generated PROPERTIES LABELS ros)
  # Skipped where network namespaces cannot be made.
  add_test(NAME ros.two_machines COMMAND ${CATKIN_DEVEL_PREFIX}/env.sh /usr/bin/python3
    ${CMAKE_CURRENT_SOURCE_DIR}/test/two_machines.py)
  set_tests_properties(ros.two_machines PROPERTIES LABELS ros RESOURCE_LOCK "ros;two_machines" COST 50 TIMEOUT 300 SKIP_RETURN_CODE 77
    ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)
endif()
