#!/usr/bin/python3
"""A robot whose scanner is all it has: nobody reports obstacles to it, and it finds who walks there in its own scans."""
import math
import sys
import time

import rospy
import rostest
from spf_empc_msgs.msg import ObstacleTracks

from robot_world import NOWHERE, ScannerAloneTest, drive, wait_until

ROBOT, WALKER = 0.3, 0.25  # [m] radii
SPEED = 0.6  # [m/s] of the walker


class ScansAlone(ScannerAloneTest):
    def test_somebody_who_comes_towards_it_is_found_and_evaded(self):
        robot = self.robot
        self.assertTrue(drive(robot), robot.status.reason)
        ahead = math.copysign(1.0, robot.command.linear.x)
        begun = time.time()
        meeting = (robot.x + 7.0 * ahead, robot.y + 0.1)
        walker = lambda now: (meeting[0] - ahead * SPEED * (now - begun), meeting[1])
        robot.walkers = [(WALKER, walker)]
        errors = []  # of the position [m] and the velocity [m/s]

        def on_tracks(message):
            x, y = walker(message.header.stamp.to_sec())
            for track in message.tracks:
                off = math.hypot(track.position.x - x, track.position.y - y)
                if off < 0.5 and abs(x - robot.x) < 4.0:
                    errors.append((off, math.hypot(track.velocity.x + ahead * SPEED, track.velocity.y)))

        subscriber = rospy.Subscriber("/robot0/tracks", ObstacleTracks, on_tracks)
        least = [math.inf]

        def behind():
            x, y = walker(time.time())
            least[0] = min(least[0], math.hypot(x - robot.x, y - robot.y) - ROBOT - WALKER)
            return (x - robot.x) * ahead < -1.0

        self.assertTrue(wait_until(behind, 20.0), robot.status.reason)
        subscriber.unregister()
        self.assertGreater(len(errors), 10)
        errors.sort()
        print("least gap %.2f m, %d tracks, median position error %.3f m" % (least[0], len(errors), errors[len(errors) // 2][0]))
        self.assertLess(errors[len(errors) // 2][0], 0.15)
        self.assertLess(sorted(velocity for _, velocity in errors)[len(errors) // 2], 0.3)
        self.assertGreater(least[0], 0.02)
        robot.walkers = [(WALKER, lambda now: NOWHERE)]
        self.assertTrue(wait_until(lambda: robot.speed() > 0.9, 10.0), robot.status.reason)


if __name__ == "__main__":
    rospy.init_node("scans_alone_test")
    rostest.rosrun("spf_empc_ros", "scans_alone", ScansAlone, sys.argv)
