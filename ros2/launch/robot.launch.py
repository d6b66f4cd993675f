"""One robot on ROS 2, real or simulated: planner, tracker and perception as one process of the program spf-ros2.

    ros2 launch ros2/launch/robot.launch.py config:=/etc/robot.yaml base_frame:=base_link
    ros2 launch ros2/launch/robot.launch.py robot_id:=3 namespace:=/robot3 config:=/etc/robot3.yaml

Starts no driver, no map server and no localisation: docs/nav2.md says what of Nav2 stays beside it.
"""
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration

ARGUMENTS = {
    "program": ("spf-ros2", "the program, on the path or with its folder"),
    "robot_id": ("0", "number of the robot in the fleet: the smaller goes first"),
    "namespace": ("/", "of its nodes and topics; / has the names that Nav2 uses for one robot"),
    "config": ("''", "parameter file of the robot (docs/ros.md); '': defaults"),
    "frame": ("map", "the fleet's frame"),
    "base_frame": ("base_link", "the robot's own frame: x forward, y left, around its centre"),
    "map": ("wait", "wait: begin when /map is there; none: know only what is sensed"),
    "use_sim_time": ("false", "time is what /clock says"),
    "stamped_cmd_vel": ("false", "cmd_vel is a TwistStamped"),
    "odom": ("odom", "topic of the pose, in the frame `frame` or one that tf knows"),
    "scan": ("scan", "topic of the scanner"),
    "cmd_vel": ("cmd_vel", "topic of the base"),
}
PARAMETERS = ("robot_id", "config", "frame", "base_frame", "map", "use_sim_time", "stamped_cmd_vel")
TOPICS = ("odom", "scan", "cmd_vel")


def generate_launch_description():
    command = [LaunchConfiguration("program"), "robot", "--ros-args", "-r", ["__ns:=", LaunchConfiguration("namespace")]]
    for name in PARAMETERS:
        command += ["-p", [name + ":=", LaunchConfiguration(name)]]
    for topic in TOPICS:
        command += ["-r", [topic + ":=", LaunchConfiguration(topic)]]
    arguments = [DeclareLaunchArgument(name, default_value=value, description=what) for name, (value, what) in ARGUMENTS.items()]
    return LaunchDescription(arguments + [ExecuteProcess(cmd=command, name="spf_ros2", output="screen", respawn=True)])
