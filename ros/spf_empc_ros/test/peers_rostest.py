#!/usr/bin/python3
"""Two robots that must pass each other, with half of their messages lost and the rest up to 0.3 s late."""
import math
import sys
import unittest

import rospy
import rostest
from spf_empc_msgs.msg import Trajectory

from robot_world import LossyAir, Robot, World, wait_until

TOPICS = ["/air0", "/air1"]


class Peers(unittest.TestCase):
    def test_pass_without_contact(self):
        robots = [Robot(0, -5.0, 0.0), Robot(1, 5.0, 0.1)]
        world = World(robots)
        air = LossyAir(TOPICS, Trajectory, loss=0.5, longest_delay=0.3)
        try:
            for robot, topic in zip(robots, TOPICS):
                robot.start_all("/swarm/trajectories:=" + topic)
            goals = [(5.0, 0.0), (-5.0, 0.0)]
            for robot, goal in zip(robots, goals):
                robot.send_goal(*goal)
            arrived = lambda: all(math.hypot(robot.x - x, robot.y - y) < 0.15 for robot, (x, y) in zip(robots, goals))
            self.assertTrue(wait_until(arrived, 45.0), [robot.status.reason for robot in robots])
            print("%d of %d messages lost, least distance %.2f m" % (air.lost, air.sent, world.least_distance))
            self.assertGreater(air.lost, 0.3 * air.sent)
            self.assertGreater(air.sent, 50)
            self.assertGreater(world.least_distance, 0.6)
            for robot in robots:
                self.assertGreater(robot.status.messages_accepted, 5)
        finally:
            world.end()


if __name__ == "__main__":
    rospy.init_node("peers_test")
    rostest.rosrun("spf_empc_ros", "peers", Peers, sys.argv)
