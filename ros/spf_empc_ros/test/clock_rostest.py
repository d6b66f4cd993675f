#!/usr/bin/python3
"""Simulated time that jumps forwards and back: the robot stops, and goes on in the new time."""
import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist

from robot_world import Robot, World, drive, wait_until


class Clocks(unittest.TestCase):
    def test_jumps(self):
        robot = Robot(0)
        world = World([robot], simulated=True)
        try:
            robot.start_all()
            for number, jump in enumerate((30.0, -25.0, -500.0), 1):
                self.assertTrue(drive(robot, 30.0), robot.status.reason)
                robot.speeds.clear()
                world.simulated_time += jump
                if jump > 0.0:
                    robot.command = Twist()  # by the clock no command has come for so long: a base stands
                self.assertTrue(wait_until(lambda: robot.speeds and robot.speed() < 0.1, 3.0), jump)
                self.assertTrue(drive(robot, 30.0), robot.status.reason)
                self.assertEqual(robot.status.clock_jumps, number)
                self.assertTrue(robot.alive())
        finally:
            world.end()


if __name__ == "__main__":
    rospy.init_node("clock_test")
    rostest.rosrun("spf_empc_ros", "clock", Clocks, sys.argv)
