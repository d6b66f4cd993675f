"""A robot with a user who sends it to goals by the action move_base, in a hall with a room that nothing leads into."""
import math
import unittest

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal

import robot_world
from robot_world import Robot, World, wait_until

CLOSED_ROOM = (20.0, 26.0, -3.0, 3.0)  # [m] its walls' outer edges


def hall_with_closed_room():
    grid = robot_world.hall()
    low_x, high_x, low_y, high_y = CLOSED_ROOM
    for row in range(grid.info.height):
        y = grid.info.origin.position.y + (row + 0.5) * grid.info.resolution
        for column in range(grid.info.width):
            x = grid.info.origin.position.x + (column + 0.5) * grid.info.resolution
            inside = low_x < x < high_x and low_y < y < high_y
            deep = low_x + 0.4 < x < high_x - 0.4 and low_y + 0.4 < y < high_y - 0.4
            if inside and not deep:
                grid.data[row * grid.info.width + column] = 100
    return grid


def goal_at(x, y, heading=0.0):
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = "map"
    goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = x, y
    goal.target_pose.pose.orientation.z = math.sin(0.5 * heading)
    goal.target_pose.pose.orientation.w = math.cos(0.5 * heading)
    return goal


def angle_between(a, b):
    return abs(math.remainder(a - b, 2.0 * math.pi))


class User:
    """Sends goals to a robot by the action."""

    def __init__(self, robot):
        self.client = actionlib.SimpleActionClient("/robot%d/move_base" % robot.number, MoveBaseAction)
        self.positions = []  # of the feedback

    def send(self, *position):
        self.positions = []
        self.client.send_goal(goal_at(*position),
                              feedback_cb=lambda f: self.positions.append(f.base_position.pose.position))

    def result(self, seconds):
        """State and text once there is a result."""
        self.client.wait_for_result(rospy.Duration(seconds))
        return self.client.get_state(), self.client.get_goal_status_text()


class GoalsTest(unittest.TestCase):
    number = 0
    nodes = ("planner_node", "tracker_node", "perception_node")
    planner = "planner"  # the node that has the goals
    arguments = ()

    @classmethod
    def setUpClass(cls):
        cls.robot = Robot(cls.number)
        cls.world = World([cls.robot])
        cls.world.map.publish(hall_with_closed_room())
        for node in cls.nodes:
            cls.robot.start(node, *cls.arguments)
        cls.user = User(cls.robot)
        assert cls.user.client.wait_for_server(rospy.Duration(20.0)), "no action server"
        assert wait_until(lambda: cls.robot.status.reason == "no goal", 20.0), cls.robot.status.reason

    @classmethod
    def tearDownClass(cls):
        cls.world.end()
        try:  # of a test that failed
            rospy.delete_param(cls.kept_goal())
        except KeyError:
            pass

    @classmethod
    def kept_goal(cls):
        """The parameter by which a goal outlives its nodes."""
        return "/robot%d/%s/kept_goal" % (cls.number, cls.planner)

    def distance(self, x, y):
        return math.hypot(self.robot.x - x, self.robot.y - y)

    def end_ahead(self):
        """A position 6 m away, towards the middle of the free part of the hall."""
        return (self.robot.x - 6.0 if self.robot.x > 0.0 else self.robot.x + 6.0), 0.0

    def under_way(self, seconds=15.0):
        return wait_until(lambda: self.robot.speed() > 0.8, seconds)

    def at_rest(self):
        """By what its base does, which stands when nothing is told."""
        return wait_until(lambda: math.hypot(self.robot.command.linear.x, self.robot.command.linear.y) < 0.01, 3.0)

    def goes_on_after(self, *programs):
        x, y = self.end_ahead()
        self.user.send(x, y, 1.0)
        self.assertTrue(self.under_way())
        for program in programs:
            self.robot.kill(program)
        self.assertTrue(self.at_rest())
        for program in programs:
            self.robot.start(program, *self.arguments)
        state, text = self.user.result(30.0)
        self.assertEqual((state, text), (GoalStatus.SUCCEEDED, "reached"), programs)
        self.assertLess(self.distance(x, y), 0.08)
        self.assertLess(angle_between(self.robot.heading, 1.0), 0.12)
