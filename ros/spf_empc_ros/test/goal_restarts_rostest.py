#!/usr/bin/python3
"""A goal outlives the nodes that pursue it: they are killed on the way, and started again."""
import sys
import tempfile
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped

from goal_user import GoalsTest, goal_at
from robot_world import wait_until


class Restarts(GoalsTest):
    def test_a_goal_of_the_action_survives_every_node(self):
        self.goes_on_after("planner_node")
        self.goes_on_after("tracker_node")
        self.goes_on_after("perception_node")
        self.goes_on_after("planner_node", "tracker_node", "perception_node")

    def test_a_goal_of_the_topic_survives_and_an_older_latched_one_does_not_come_back(self):
        x = self.robot.x + 0.5
        self.robot.send_goal(x, 0.0)  # latched
        # The goal before it has been reached, too, so the outcome alone does not tell.
        self.assertTrue(wait_until(lambda: self.distance(x, 0.0) < 0.08, 10.0), self.robot.status.reason)
        self.assertTrue(wait_until(lambda: self.robot.status.goal_outcome == "reached", 10.0), self.robot.status.reason)
        self.goes_on_after("planner_node")
        # That the goal is over is told first and noted at the parameter server right after.
        self.assertTrue(wait_until(lambda: not rospy.has_param(self.kept_goal()), 5.0))
        self.robot.kill("planner_node")
        self.robot.start("planner_node")
        self.assertTrue(wait_until(lambda: self.robot.status.goal_outcome == "none", 10.0))
        self.assertTrue(wait_until(lambda: self.robot.status.reason == "no goal", 10.0), self.robot.status.reason)
        topic = rospy.Publisher("/robot0/goal", PoseStamped, queue_size=1)
        self.assertTrue(wait_until(lambda: topic.get_num_connections() > 0, 5.0))
        x, y = self.end_ahead()
        topic.publish(goal_at(x, y).target_pose)
        self.assertTrue(self.under_way())
        self.robot.kill("planner_node")
        self.robot.start("planner_node")
        self.assertTrue(wait_until(lambda: self.robot.status.goal_outcome == "reached", 25.0), self.robot.status.reason)
        self.assertLess(self.distance(x, y), 0.08)


class RestartsOfOneProcess(GoalsTest):
    number = 1
    nodes = ("robot_node",)
    planner = "robot"

    def test_a_goal_of_the_action_survives_the_process(self):
        self.goes_on_after("robot_node")


class LongAbsence(GoalsTest):
    number = 2

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        with open(cls.folder.name + "/robot.yaml", "w") as file:
            file.write("host: {goal_memory: 1}\n")
        cls.arguments = ("_config:=" + cls.folder.name + "/robot.yaml",)
        super().setUpClass()

    @classmethod
    def tearDownClass(cls):
        super().tearDownClass()
        cls.folder.cleanup()

    def test_a_goal_is_not_taken_up_again_after_it(self):
        self.user.send(*self.end_ahead())
        self.assertTrue(self.under_way())
        self.robot.kill("planner_node")
        rospy.sleep(2.5)
        self.robot.start("planner_node", *self.arguments)
        self.assertEqual(self.user.result(10.0)[0], GoalStatus.LOST)
        self.assertTrue(wait_until(lambda: self.robot.status.reason == "no goal", 10.0), self.robot.status.reason)


class Suite(unittest.TestSuite):
    def __init__(self):
        super().__init__()
        for case in (Restarts, RestartsOfOneProcess, LongAbsence):
            self.addTests(unittest.defaultTestLoader.loadTestsFromTestCase(case))


if __name__ == "__main__":
    rospy.init_node("goal_restarts_test")
    rostest.rosrun("spf_empc_ros", "goal_restarts", "goal_restarts_rostest.Suite", sys.argv)
