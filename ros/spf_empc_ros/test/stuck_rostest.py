#!/usr/bin/python3
"""Commands keep the robot's limits whatever happens, and a held robot says so, stops pushing and tries again."""
import random
import sys
import time

import rospy
import rostest

from robot_world import OneRobotTest, drive, wait_until

MAX_SPEED, MAX_CHANGE = 1.0, 0.05  # [m/s] RobotParameters, and its acceleration over a control period


class Stuck(OneRobotTest):
    def check_limits(self):
        robot = self.robot
        print("largest command %.4f m/s, largest change %.4f m/s" % (robot.largest_speed, robot.largest_change))
        self.assertLess(robot.largest_speed, 1.01 * MAX_SPEED)
        # As seen from the body, whose heading the controller corrects a little at each tick.
        self.assertLess(robot.largest_change, 1.1 * MAX_CHANGE)

    def test_held_robot(self):
        robot = self.robot
        self.assertTrue(drive(robot), robot.status.reason)
        robot.held = True
        since = time.monotonic()
        self.assertTrue(wait_until(lambda: robot.tracker.mode == "stuck", 3.0), robot.tracker.mode)
        print("stuck after %.2f s" % (time.monotonic() - since))
        self.assertLess(time.monotonic() - since, 1.6)
        self.assertTrue(wait_until(lambda: robot.status.reason == "stuck", 0.5), robot.status.reason)
        for part in ("tracker", "planner"):
            self.assertTrue(wait_until(lambda: ("robot0: " + part, "stuck") in self.world.diagnostics, 1.5))
        self.assertTrue(wait_until(lambda: robot.speed() == 0.0, 1.5), robot.speed())
        time.sleep(max(0.0, since + 4.0 - time.monotonic()))
        robot.held = False
        self.assertTrue(wait_until(lambda: robot.speed() > 0.9, 12.0), robot.status.reason)
        self.check_limits()

    def test_noise_and_jumps_of_the_poses(self):
        robot = self.robot
        self.assertTrue(drive(robot), robot.status.reason)
        chance = random.Random(1)
        robot.distort = lambda x, y: (x + chance.gauss(0.0, 0.02), y + chance.gauss(0.0, 0.02))
        time.sleep(4.0)
        self.assertGreater(robot.speed(), 0.8)
        robot.distort = lambda x, y: (x - 1.0, y + 1.0)
        time.sleep(3.0)
        robot.distort = lambda x, y: (x, y)
        time.sleep(2.0)
        self.assertTrue(drive(robot), robot.status.reason)
        self.check_limits()


if __name__ == "__main__":
    rospy.init_node("stuck_test")
    rostest.rosrun("spf_empc_ros", "stuck", Stuck, sys.argv)
