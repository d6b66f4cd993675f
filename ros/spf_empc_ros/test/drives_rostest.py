#!/usr/bin/python3
"""A differential robot and a car, as robot.launch starts them, on bases that obey cmd_vel: they reach goals ahead, beside
and behind them, past each other and somebody who crosses, and are never told what their wheels cannot do."""
import math
import sys
import time
import unittest

import rospy
import rostest

from robot_world import NOWHERE, Robot, World, wait_until

RADIUS, PERSON = 0.3, 0.25  # [m]
TOLERANCE = 0.3  # [m] from a goal
TURNING_RADIUS = 0.6  # [m] of the car
ROUNDING = 1e-6
PATIENCE = 45.0  # [s] for a goal


class Base(Robot):
    """Keeps every command that it was given."""

    def __init__(self, number, x, y):
        self.commands = []
        super().__init__(number, x, y)

    def on_command(self, message):
        self.commands.append((message.linear.x, message.linear.y, message.angular.z))
        super().on_command(message)


class Drives(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.differential, cls.car = Base(0, -6.0, -1.0), Base(1, 6.0, 1.0)
        cls.car.heading = math.pi
        cls.robots = [cls.differential, cls.car]
        for robot in cls.robots:
            robot.walkers = [(PERSON, lambda now: NOWHERE)]
        cls.world = World(cls.robots)

    @classmethod
    def tearDownClass(cls):
        cls.world.end()

    def go(self, *goals):
        """Sends each robot to its goal, and waits until all are there."""
        for robot, goal in zip(self.robots, goals):
            robot.send_goal(*goal)

        def there(robot, goal):
            return math.hypot(robot.x - goal[0], robot.y - goal[1]) < TOLERANCE and \
                math.hypot(robot.command.linear.x, robot.command.linear.y) < 0.01
        for robot, goal in zip(self.robots, goals):
            self.assertTrue(wait_until(lambda: there(robot, goal), PATIENCE), "robot %d at (%.2f, %.2f), %s" % (
                robot.number, robot.x, robot.y, robot.status.reason))

    def test_they_arrive_as_their_wheels_allow(self):
        self.go((6.0, 1.0), (-6.0, -1.0))  # past each other
        self.go((5.0, -2.0), (-5.0, 2.0))  # behind them
        began = time.time()
        for robot in self.robots:  # somebody crosses before both
            robot.walkers = [(PERSON, lambda now: (0.0, -3.5 + 0.5 * (now - began)))]
        self.go((-6.0, -2.0), (6.0, 2.0))
        self.assertGreater(self.world.least_distance, 2.0 * RADIUS)
        for robot in self.robots:
            self.assertGreater(len(robot.commands), 200)
            self.assertEqual([c for c in robot.commands if c[1] != 0.0], [], "sideways")
        on_its_wheels = [abs(turn) * TURNING_RADIUS <= abs(speed) + ROUNDING for speed, _, turn in self.car.commands]
        self.assertTrue(all(on_its_wheels), "the car was to turn more than it is steered")
        self.assertTrue(any(abs(turn) > 0.1 and abs(speed) < 0.05 for speed, _, turn in self.differential.commands),
                        "the differential robot never turned on the spot")


if __name__ == "__main__":
    rospy.init_node("drives_test")
    rostest.rosrun("spf_empc_ros", "drives", Drives, sys.argv)
