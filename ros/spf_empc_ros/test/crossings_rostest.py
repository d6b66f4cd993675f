#!/usr/bin/python3
"""A robot whose scanner is all it has, among those who never yield: they cross its way from four directions, or walk in
and stop before it. The environment's SPF_CROSSINGS says how often each crossing is tried, with half as many stops; without it two
crossings and one stop."""
import math
import os
import random
import sys
import time

import rospy
import rostest

from robot_world import NOWHERE, ScannerAloneTest, drive, wait_until

REPEATS = int(os.environ.get("SPF_CROSSINGS") or 0)  # 3: 24 crossings, 12 stops
ROBOT, DISC, PERSON = 0.3, 0.3, 0.25  # [m] radii
DIRECTIONS = {"from the left": -90.0, "from the right": 90.0, "from ahead": 180.0, "from behind, aslant": 45.0}  # [deg]
UNTIL = 4.0  # [s] before they would meet, something comes


class Crossings(ScannerAloneTest):
    chance = random.Random(7)

    def under_way(self):
        """+1 or -1: where it goes, at full speed."""
        robot = self.robot
        robot.walkers = [(DISC, lambda now: NOWHERE)]
        self.assertTrue(drive(robot), robot.status.reason)
        return math.copysign(1.0, robot.command.linear.x)

    def least_gap(self, radius, path, seconds):
        """[m] between the robot and one who goes that way, and how fast the robot went where it was least [m/s]."""
        robot = self.robot
        robot.walkers = [(radius, path)]
        end, least = time.time() + seconds, (math.inf, 0.0)
        while time.time() < end:
            x, y = path(time.time())
            least = min(least, (math.hypot(x - robot.x, y - robot.y) - ROBOT - radius, robot.speed()))
            time.sleep(0.005)
        return least

    def crossing(self, direction, speed):
        ahead = self.under_way()
        turn = math.radians(direction) + (0.0 if ahead > 0.0 else math.pi)
        meeting = (self.robot.x + ahead * (UNTIL + self.chance.uniform(-0.3, 0.3)),
                   self.robot.y + self.chance.uniform(-0.1, 0.1))
        meets = time.time() + UNTIL

        def path(now):
            distance = speed * (now - meets)
            return meeting[0] + distance * math.cos(turn), meeting[1] + distance * math.sin(turn)
        return self.least_gap(DISC, path, UNTIL + 4.0)

    def test_nobody_who_crosses_is_touched(self):
        kinds = [(name, speed) for speed in (0.5, 1.0) for name in DIRECTIONS]
        chosen = kinds * REPEATS if REPEATS > 0 else self.chance.sample(kinds, 2)
        for name, speed in chosen:
            gap, robot_speed = self.crossing(DIRECTIONS[name], speed)
            print("%s at %.1f m/s: least gap %.3f m, robot at %.2f m/s" % (name, speed, gap, robot_speed))
            with self.subTest(name=name, speed=speed):
                self.assertGreater(gap, 0.0)

    def test_nobody_who_stops_before_it_is_touched(self):
        robot = self.robot
        for number in range(4 * REPEATS if REPEATS > 0 else 1):
            ahead, side = self.under_way(), self.chance.choice((-1.0, 1.0))
            speed, comes = self.chance.uniform(0.8, 1.4), 2.5  # [m/s], [s]
            stop = (robot.x + ahead * (comes * robot.speed() + ROBOT + 1.0), robot.y + self.chance.uniform(-0.2, 0.2))
            stops = time.time() + comes
            gap, robot_speed = self.least_gap(
                PERSON, lambda now: (stop[0], stop[1] + side * speed * max(0.0, stops - now)), comes + 5.0)
            print("stop %d, %.1f m/s: least gap %.3f m, robot at %.2f m/s" % (number, speed, gap, robot_speed))
            with self.subTest(number=number):
                self.assertGreater(gap, 0.0)
                self.assertTrue(wait_until(lambda: abs(robot.x) > 38.0 or (robot.x - stop[0]) * ahead > 0.5, 20.0),
                                robot.status.reason)


if __name__ == "__main__":
    rospy.init_node("crossings_test")
    rostest.rosrun("spf_empc_ros", "crossings", Crossings, sys.argv)
