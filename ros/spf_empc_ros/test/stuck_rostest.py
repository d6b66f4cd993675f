#!/usr/bin/python3
"""Commands keep the robot's limits whatever happens, and a held robot says so, stops pushing and tries again."""
import random
import sys
import time

import rospy
import rostest

from robot_world import OneRobotTest, drive, wait_until


class Stuck(OneRobotTest):
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


if __name__ == "__main__":
    rospy.init_node("stuck_test")
    rostest.rosrun("spf_empc_ros", "stuck", Stuck, sys.argv)
