# cmake -D BUILD_DIR=... -D CONFIG=... -D ROS_DIR=... -D LAUNCHER=... -P RosStandAlone.cmake
# Installs the built library into an empty prefix and builds the ROS packages in a catkin workspace that knows it only by
# find_package(spf), as somebody with robots would: the messages, a program with all the libraries that the nodes link, and
# the sources that see most of their headers. The rest of the sources is compiled once, as part of the whole.
set(work ${BUILD_DIR}/ros_stand_alone)
file(REMOVE_RECURSE ${work}/prefix)
file(MAKE_DIRECTORY ${work})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status WORKING_DIRECTORY ${work} OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${output}\n${command}: ${status}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --config "${CONFIG}" --component development --prefix ${work}/prefix)
set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} "${LAUNCHER}")  # a list, which would not survive as an argument
# Type None: that it compiles and links counts, not how fast it runs.
set(workspace catkin_make_isolated --source ${ROS_DIR} --build ${work}/build --devel ${work}/devel)
set(options --cmake-args -DCMAKE_PREFIX_PATH=${work}/prefix -DCATKIN_ENABLE_TESTING=OFF -DCMAKE_BUILD_TYPE=None)
run(${workspace} --ignore-pkg spf_empc_ros ${options})
run(${workspace} --pkg spf_empc_ros ${options} --make-args
  robot_file src/planner_node.o src/simulator_node.o)
if(NOT EXISTS ${work}/devel/spf_empc_ros/lib/spf_empc_ros/robot_file)
  message(FATAL_ERROR "robot_file was not built")
endif()
