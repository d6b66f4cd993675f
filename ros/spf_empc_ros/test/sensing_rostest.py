#!/usr/bin/python3
"""Stale and wrong measurements: the robot brakes in time, says why, and goes on by itself."""
import sys

import rospy
import rostest

from robot_world import OneRobotTest, braking_begins, drive, stands, steady, wait_until

STALE = 0.3  # [s] TeamParameters::stale_time
# [s] begins within 0.1 s, seen at the next control tick; the rest is for a busy machine.
LATEST = STALE + 0.1 + 0.05 + 0.05


class Sensing(OneRobotTest):
    def check_stale(self, switch, sensor, reason):
        robot = self.robot
        self.assertTrue(drive(robot), robot.status.reason)
        self.assertTrue(steady(robot), robot.status.reason)
        setattr(robot, switch, False)
        begun = braking_begins(robot, robot.last[sensor])
        self.assertIsNotNone(begun, "never braked")
        print("%s: brakes %.3f s after the last stamp" % (sensor, begun - robot.last[sensor]))
        self.assertGreater(begun - robot.last[sensor], STALE - 0.02)
        self.assertLess(begun - robot.last[sensor], LATEST)
        self.assertTrue(stands(robot))
        self.assertTrue(wait_until(lambda: robot.status.reason == reason, 1.0), robot.status.reason)
        self.assertTrue(wait_until(lambda: ("robot0: planner", reason) in self.world.diagnostics, 1.5))
        setattr(robot, switch, True)
        self.assertTrue(wait_until(lambda: robot.speed() > 0.9, 5.0), robot.status.reason)  # by itself

    def test_odometry(self):
        self.check_stale("odom_on", "odom", "stale pose")
        self.assertIn(("robot0: tracker", "stale pose"), self.world.diagnostics)

    def test_scan(self):
        self.check_stale("scan_on", "scan", "no scan")

    def test_obstacles(self):
        self.check_stale("obstacles_on", "obstacles", "no report of obstacles")

    def test_poses_that_are_not_numbers_are_none(self):
        robot = self.robot
        self.assertTrue(drive(robot), robot.status.reason)
        robot.distort = lambda x, y: (float("nan"), y)
        since = robot.last["odom"]
        begun = braking_begins(robot, since)
        self.assertIsNotNone(begun)
        self.assertLess(begun - since, LATEST)
        self.assertTrue(stands(robot))
        robot.distort = lambda x, y: (x, y)
        self.assertTrue(drive(robot), robot.status.reason)

    def test_jump_is_a_fault_until_it_persists(self):
        robot = self.robot
        self.assertTrue(drive(robot), robot.status.reason)
        robot.distort = lambda x, y: (x, y + 2.0)
        since = robot.last["odom"]
        begun = braking_begins(robot, since)
        self.assertIsNotNone(begun)
        self.assertLess(begun - since, LATEST)
        # Believed, it plans from there: on a path that comes back to the middle of the hall, 2 m beside.
        self.assertTrue(drive(robot), robot.status.reason)
        robot.distort = lambda x, y: (x, y)
        # It goes on as soon as it stands, so that may be short.
        self.assertTrue(wait_until(lambda: robot.speed() < 0.05, 3.0), robot.status.reason)
        self.assertTrue(drive(robot), robot.status.reason)


if __name__ == "__main__":
    rospy.init_node("sensing_test")
    rostest.rosrun("spf_empc_ros", "sensing", Sensing, sys.argv)
