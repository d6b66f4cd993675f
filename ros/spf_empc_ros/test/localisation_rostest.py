#!/usr/bin/python3
"""Odometry in a frame of its own that a localisation places: what it does not tell, what it corrects, a map that is told
again, a second node of a name that is taken, and one level for the robot that is good only when all is well."""
import sys
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticStatus

from robot_world import Robot, World, braking_begins, drive, hall, stands, wait_until

STALE = 0.3  # [s] TeamParameters::stale_time
# [s] begins within 0.1 s, seen at the next control tick; the rest is for a busy machine.
LATEST = STALE + 0.1 + 0.05 + 0.05


class Localisation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.robot = Robot(0)
        cls.robot.odom_frame, cls.robot.base_frame = "odom_of_0", "base_footprint"
        cls.robot.map_to_odom = (3.0, -1.0, 0.7)
        cls.world = World([cls.robot])
        cls.robot.start_all("_base_frame:=base_footprint")

    @classmethod
    def tearDownClass(cls):
        cls.world.end()

    def level(self):
        return self.world.health.get("robot0", (None, ""))[0]

    def assert_level(self, level, text="", seconds=3.0):
        self.assertTrue(wait_until(lambda: self.level() == level and text in self.world.health["robot0"][1], seconds),
                        self.world.health)

    def test_dead_localisation(self):
        robot = self.robot
        self.assertTrue(drive(robot), robot.status.reason)
        self.assert_level(DiagnosticStatus.OK, "moving")
        robot.localised = False
        begun = braking_begins(robot, robot.last["localisation"])
        self.assertIsNotNone(begun, "never braked")
        print("localisation dies: brakes after %.3f s" % (begun - robot.last["localisation"]))
        self.assertGreater(begun - robot.last["localisation"], STALE - 0.02)
        self.assertLess(begun - robot.last["localisation"], LATEST)
        self.assertTrue(stands(robot))
        self.assert_level(DiagnosticStatus.ERROR, "stale localisation")
        robot.localised = True
        self.assertTrue(wait_until(lambda: robot.speed() > 0.9, 5.0), robot.status.reason)
        self.assert_level(DiagnosticStatus.OK)

    def test_small_corrections_and_a_map_that_is_told_again(self):
        robot = self.robot
        self.assertTrue(drive(robot), robot.status.reason)
        slowest = 9.0
        for number in range(30):
            x, y, turn = robot.map_to_odom
            robot.map_to_odom = (x, y + (0.03 if number % 2 else -0.03), turn)
            grid = hall()
            grid.data[number] = 100  # behind a corner, far away
            if number % 3 == 0:
                self.world.map.publish(grid)
            time.sleep(0.1)
            slowest = min(slowest, robot.speed())
        print("slowest: %.2f m/s" % slowest)
        self.assertGreater(slowest, 0.7)

    def test_a_second_node_of_the_same_name_does_not_start(self):
        self.assertTrue(drive(self.robot), self.robot.status.reason)
        first = self.robot.processes["planner_node"]
        self.robot.start("planner_node")
        self.assertEqual(self.robot.processes["planner_node"].wait(10.0), 1)
        self.robot.processes["planner_node"] = first
        self.assertIsNone(first.poll())
        self.assertTrue(drive(self.robot), self.robot.status.reason)


if __name__ == "__main__":
    rospy.init_node("localisation_test")
    rostest.rosrun("spf_empc_ros", "localisation", Localisation, sys.argv)
