#!/usr/bin/python3
"""Nodes that are killed and started again: the robot stands meanwhile, and goes on without a jump."""
import sys
import unittest

import rospy
import rostest

from robot_world import OneRobotTest, Robot, World, braking_begins, drive, stands, wait_until


class Processes(OneRobotTest):
    def setUp(self):
        self.assertTrue(drive(self.robot), self.robot.status.reason)

    def goes_on_smoothly(self):
        """By itself, since its goal is latched; no two commands differ by more than 3 m/s^2 would make them."""
        first = len(self.robot.speeds)
        self.assertTrue(wait_until(lambda: self.robot.speed() > 0.9, 15.0), self.robot.status.reason)
        pairs = list(zip(self.robot.speeds[first:], self.robot.speeds[first + 1:]))
        self.assertTrue(pairs)
        for (before, slow), (after, fast) in pairs:
            self.assertLess(abs(fast - slow), 3.0 * max(after - before, 0.05))

    def test_planner(self):
        self.robot.kill("planner_node")
        killed = rospy.Time.now().to_sec()
        begun = braking_begins(self.robot, killed)
        self.assertIsNotNone(begun)
        print("planner killed: brakes after %.3f s" % (begun - killed))
        self.assertLess(begun - killed, 0.5 + 0.1 + 0.1)  # HostParameters::plan_silence
        self.assertTrue(stands(self.robot))
        self.assertEqual(self.robot.tracker.mode, "stale plan")
        self.robot.start("planner_node")
        self.goes_on_smoothly()

    def test_planner_that_is_back_before_the_robot_stands(self):
        self.robot.kill("planner_node")
        self.robot.start("planner_node")
        self.assertTrue(stands(self.robot))
        self.goes_on_smoothly()

    def test_tracker(self):
        self.robot.kill("tracker_node")
        self.assertTrue(wait_until(lambda: self.robot.command.linear.x == 0.0, 2.0))  # the base's own time-out
        self.robot.start("tracker_node")
        self.assertTrue(wait_until(lambda: self.robot.speed() > 0.9, 15.0), self.robot.tracker.mode)

    def test_perception(self):
        self.robot.kill("perception_node")
        killed = rospy.Time.now().to_sec()
        begun = braking_begins(self.robot, killed - 0.1)
        self.assertIsNotNone(begun)
        print("perception killed: brakes after %.3f s" % (begun - killed))
        self.assertLess(begun - killed, 0.3 + 0.1 + 0.1)
        self.assertTrue(stands(self.robot))
        self.robot.start("perception_node")
        self.goes_on_smoothly()


class OneProcess(unittest.TestCase):
    def test_robot_node_is_killed_and_goes_on(self):
        robot = Robot(1)
        world = World([robot])
        try:
            robot.start("robot_node")
            self.assertTrue(drive(robot), robot.status.reason)
            robot.kill("robot_node")
            self.assertTrue(wait_until(lambda: robot.command.linear.x == 0.0, 2.0))
            robot.speeds.clear()
            robot.start("robot_node")
            self.assertTrue(wait_until(lambda: robot.speed() > 0.9, 15.0), robot.status.reason)
        finally:
            world.end()


class Suite(unittest.TestSuite):
    def __init__(self):
        super().__init__()
        for case in (Processes, OneProcess):
            self.addTests(unittest.defaultTestLoader.loadTestsFromTestCase(case))


if __name__ == "__main__":
    rospy.init_node("processes_test")
    rostest.rosrun("spf_empc_ros", "processes", "processes_rostest.Suite", sys.argv)
