#!/usr/bin/python3
"""simulator_node as seen by its robots' nodes: their clock, their sensors, their bases, and how a trial ends."""
import math
import os
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped, Twist
from nav_msgs.msg import OccupancyGrid, Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from spf_empc_msgs.msg import ObstacleTracks, TrialOutcome

from robot_world import node_program, wait_until

SPEED = 2.0
WATCHDOG = 0.5  # [s]
SCENARIO = """\
family: explicit
robots:
  - {start: [-2, 0], goal: [2, 0], heading: 0}
border: {low: [-6, -4], high: [6, 4]}
boxes:
  - {low: [3, 1], high: [4, 2]}
moving:
  - {position: [0, -3], velocity: [0.5, 0], radius: 0.3}
trial: {time_limit: 60}
"""
BLIND = (4.0, 5.0)  # [s] without odometry
FAULTS = [{"topic": "odom", "robot": 0, "from": BLIND[0], "to": BLIND[1]}]


class Driver:
    """A base's only friend: keeps the newest of everything, and commands a constant velocity while it is told to."""

    def __init__(self):
        self.clock, self.odom, self.map, self.goal, self.outcome = None, [], None, None, None
        self.scans, self.obstacles = [], []
        self.velocity, self.ended = None, False
        rospy.Subscriber("/clock", Clock, lambda m: setattr(self, "clock", m.clock))
        rospy.Subscriber("/map", OccupancyGrid, lambda m: setattr(self, "map", m))
        rospy.Subscriber("/simulator/outcome", TrialOutcome, lambda m: setattr(self, "outcome", m))
        rospy.Subscriber("/robot0/odom", Odometry, self.odom.append, queue_size=1000)
        rospy.Subscriber("/robot0/scan", LaserScan, self.scans.append)
        rospy.Subscriber("/robot0/obstacles", ObstacleTracks, self.obstacles.append)
        self.publisher = None

    def appear(self):
        """What the simulator waits for: somebody who listens and commands."""
        rospy.Subscriber("/robot0/goal", PoseStamped, lambda m: setattr(self, "goal", m))
        self.publisher = rospy.Publisher("/robot0/cmd_vel", Twist, queue_size=1)
        threading.Thread(target=self.command, daemon=True).start()

    def command(self):
        while not self.ended:
            if self.velocity is not None:
                message = Twist()
                message.linear.x = self.velocity
                self.publisher.publish(message)
            time.sleep(0.02)

    def position(self):
        return self.odom[-1].pose.pose.position.x

    def speed(self):
        return self.odom[-1].twist.twist.linear.x


class Simulator(unittest.TestCase):
    def setUp(self):
        with tempfile.NamedTemporaryFile("w", suffix=".yaml", delete=False) as file:
            file.write(SCENARIO)
        self.scenario = file.name
        self.process = None

    def tearDown(self):
        if self.process is not None and self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        os.remove(self.scenario)

    def start(self, *arguments):
        self.process = subprocess.Popen([node_program("simulator_node"), "_scenario:=" + self.scenario, *arguments],
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def test_refuses_what_it_cannot_run_with_all_reasons(self):
        rospy.set_param("/refused/overrides", ["robots.size=3"])
        rospy.set_param("/refused/faults", [{"topic": "smell", "robot": 0, "from": 0, "to": 1}])
        self.start("_speed:=-1", "_command:=thrust", "__name:=refused")
        output, _ = self.process.communicate(timeout=30)
        self.assertEqual(self.process.returncode, 1, output)
        for word in ("speed", "command = thrust", "robots.size", "smell"):
            self.assertIn(word, output)

    def test_a_trial_from_the_first_clock_to_the_end(self):
        driver = Driver()
        rospy.set_param("/simulator/faults", FAULTS)
        self.start("_speed:=%g" % SPEED, "_quit_when_done:=true")
        # Nobody is there: time is told, but stands.
        self.assertTrue(wait_until(lambda: driver.clock is not None, 20.0))
        first = driver.clock
        time.sleep(1.0)
        self.assertEqual(driver.clock, first)
        start = first.to_sec()
        driver.appear()
        self.assertTrue(wait_until(lambda: driver.clock > first and driver.odom, 20.0))
        self.check_what_is_latched(driver)

        self.check_watchdog(driver)
        self.check_sensors(driver)

        # The rest of the path, and the end.
        driver.velocity = 0.5
        self.assertTrue(wait_until(lambda: driver.position() > 1.9, 40.0), driver.position())
        driver.velocity = 0.0
        self.assertTrue(wait_until(lambda: self.process.poll() is not None, 20.0))
        output = self.process.stdout.read()
        self.assertEqual(self.process.returncode, 0, output)
        self.assertEqual(driver.outcome.outcome, TrialOutcome.SUCCESS, output)
        self.assertAlmostEqual(driver.outcome.path_lengths[0], 3.95, delta=0.2)
        self.assertIn("robot0: ", output)
        self.check_stamps(driver, start)
        driver.ended = True

    def check_what_is_latched(self, driver):
        self.assertTrue(wait_until(lambda: driver.map is not None and driver.goal is not None, 10.0))
        self.assertEqual((driver.map.info.width, driver.map.info.height), (240, 160))
        self.assertEqual(driver.map.data[int(5.5 / 0.05) * 240 + int(9.5 / 0.05)], 100)
        self.assertEqual((driver.goal.pose.position.x, driver.goal.pose.orientation.w), (2.0, 1.0))

    def check_watchdog(self, driver):
        self.assertAlmostEqual(driver.position(), -2.0, delta=1e-9)
        driver.velocity = 0.4
        self.assertTrue(wait_until(lambda: abs(driver.speed() - 0.4) < 0.02, 10.0), driver.speed())
        driver.velocity = None
        told_until = driver.clock.to_sec()
        self.assertTrue(wait_until(lambda: abs(driver.speed()) < 0.02, 10.0), driver.speed())
        # The last command may have been on its way; the plant takes a little to stop.
        self.assertGreater(driver.clock.to_sec() - told_until, WATCHDOG - 0.1)
        self.assertLess(driver.clock.to_sec() - told_until, WATCHDOG + 0.6)

    def check_sensors(self, driver):
        self.assertTrue(wait_until(lambda: driver.scans and driver.obstacles, 5.0))
        scan, obstacles = driver.scans[-1], driver.obstacles[-1]
        self.assertEqual(scan.header.frame_id, "robot0/base_link")
        self.assertEqual(obstacles.header.frame_id, "map")
        self.assertEqual(len(obstacles.tracks), 1)
        disc = obstacles.tracks[0]
        self.assertAlmostEqual(disc.radius, 0.3, delta=1e-9)
        # The beam towards the disc ends at its rim.
        x, y = disc.position.x - driver.position(), disc.position.y
        beam = int(round((math.atan2(y, x) - scan.angle_min) / scan.angle_increment)) % len(scan.ranges)
        self.assertAlmostEqual(scan.ranges[beam], math.hypot(x, y) - 0.3, delta=0.15)

    def check_stamps(self, driver, start):
        stamps = [message.header.stamp.to_sec() - start for message in driver.odom]
        gaps = [(after - before, before) for before, after in zip(stamps, stamps[1:])]
        self.assertTrue(all(gap >= 0.0 for gap, _ in gaps))
        longest, where = max(gaps)
        self.assertAlmostEqual(longest, BLIND[1] - BLIND[0], delta=0.1)
        self.assertAlmostEqual(where, BLIND[0], delta=0.1)
        usual = sorted(gap for gap, _ in gaps)[len(gaps) // 2]
        self.assertAlmostEqual(usual, 0.01, delta=1e-6)


if __name__ == "__main__":
    rospy.init_node("simulated_world_test")
    rostest.rosrun("spf_empc_ros", "simulated_world", Simulator, sys.argv)
