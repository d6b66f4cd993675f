#!/usr/bin/python3
"""Messages that are out of order, duplicated or make no sense: counted, named, and without effect."""
import copy
import sys
import time

import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import LaserScan
from spf_empc_msgs.msg import Observation, ObstacleTrack, ObstacleTracks, Trajectory

from robot_world import OneRobotTest, drive, free_scan, wait_until


def spoilt(good):
    """Trajectories with one thing wrong each."""
    def bad(**changes):
        message = copy.deepcopy(good)
        for key, value in changes.items():
            setattr(message, key, value)
        return message
    nan = float("nan")
    return [
        bad(durations=[]), bad(durations=[-1.0]), bad(durations=[nan]), bad(durations=[1e308]),
        bad(coefficients=good.coefficients[:7]), bad(coefficients=[]), bad(coefficients=[nan] * 12),
        bad(coefficients=[1e300] * 12), bad(durations=[1.0] * 33, coefficients=[0.0] * (33 * 12)),
        bad(durations=[1.0] * 1000, coefficients=[0.0] * 12000),
        bad(radius=-1.0), bad(radius=nan), bad(radius=50.0), bad(position_sigma=nan), bad(position_sigma=1e6),
        bad(state=77), bad(robot_id=0xFFFFFFFF), bad(heading_phases=[-1.0, 0.0, 0.0]),
        bad(heading_target=1.0), bad(yaw_rate_initial=nan), bad(yaw_rate_cruise=1e300),
        bad(start=rospy.Time(4000000000)), bad(start=rospy.Time(0)), bad(expiry=rospy.Time(0)),
    ]


def peer(number, sequence, x, y, stamp):
    message = Trajectory()
    message.header.stamp, message.header.frame_id = stamp, "map"
    message.robot_id, message.priority, message.sequence = number, number, sequence
    message.state, message.radius = Trajectory.STOPPED, 0.3
    message.expiry, message.start = stamp + rospy.Duration(1.5), stamp
    message.durations = [1.0]
    message.coefficients = [x, 0.0, 0.0, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, 0.0]
    return message


class Malformed(OneRobotTest):
    number = 3

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.swarm = rospy.Publisher("/swarm/trajectories", Trajectory, queue_size=1000)

    def setUp(self):
        self.assertTrue(drive(self.robot), self.robot.status.reason)

    def still_drives(self):
        self.assertTrue(self.robot.alive())
        # It may be near an end of the hall by now, and turn.
        self.assertTrue(drive(self.robot), self.robot.status.reason)

    def test_peers(self):
        before = self.robot.status.messages_malformed
        now = rospy.Time.now()
        messages = spoilt(peer(1, 1, 0.0, 3.0, now))
        for message in messages:
            self.swarm.publish(message)
        future = peer(1, 2, 0.0, 3.0, now + rospy.Duration(60.0))
        past = peer(1, 3, 0.0, 3.0, now - rospy.Duration(60.0))
        elsewhere = peer(1, 4, 0.0, 3.0, now)
        elsewhere.header.frame_id = "another_map"
        for message in (future, past, elsewhere):
            self.swarm.publish(message)
        # The zero expiry of the list and what is too old or too new are judged by the agent's table.
        expected = before + len(messages)
        self.assertTrue(wait_until(lambda: self.robot.status.messages_malformed >= expected, 2.0),
                        "%d of %d" % (self.robot.status.messages_malformed, expected))
        self.still_drives()

    def test_peers_out_of_order_and_twice(self):
        accepted, old = self.robot.status.messages_accepted, self.robot.status.messages_old
        now = rospy.Time.now()
        for sequence in (100, 102, 101, 102, 103):
            self.swarm.publish(peer(2, sequence, 0.0, 3.0, now))
            time.sleep(0.02)
        self.assertTrue(wait_until(lambda: self.robot.status.messages_accepted == accepted + 3, 2.0))
        self.assertTrue(wait_until(lambda: self.robot.status.messages_old == old + 2, 2.0))

    def test_own_plan(self):
        publisher = rospy.Publisher("/robot3/trajectory", Trajectory, queue_size=100)
        wait_until(lambda: publisher.get_num_connections() > 0, 5.0)
        before = self.robot.tracker.plans_refused
        good = peer(3, 1, self.robot.x, self.robot.y, rospy.Time.now())
        sent = [m for m in spoilt(good) if m.expiry.to_sec() > 0.0 and m.start.to_sec() > 0.0 and m.radius != 50.0
                and m.position_sigma < 1e3]  # the tracker does not look at these
        for message in sent + [peer(8, 1, 0.0, 0.0, rospy.Time.now())]:
            publisher.publish(message)
            time.sleep(0.02)  # its queue is short: what counts is the newest plan
        self.assertTrue(wait_until(lambda: self.robot.tracker.plans_refused >= before + len(sent), 2.0),
                        "%d" % (self.robot.tracker.plans_refused - before))
        publisher.unregister()
        self.still_drives()

    def test_sensors(self):
        before = self.robot.status.inputs_refused
        space = "/robot3/"
        publishers = {name: rospy.Publisher(space + name, kind, queue_size=50) for name, kind in (
            ("odom", Odometry), ("scan", LaserScan), ("obstacles", ObstacleTracks), ("observation", Observation),
            ("goal", PoseStamped))}
        publishers["/map"] = rospy.Publisher("/map", OccupancyGrid, queue_size=5)
        wait_until(lambda: all(p.get_num_connections() > 0 for p in publishers.values()), 5.0)
        for _ in range(20):
            now = rospy.Time.now()
            scan = free_scan(now, 3)
            scan.ranges = scan.ranges[:7]
            publishers["scan"].publish(scan)
            scan = free_scan(now, 3)
            scan.header.frame_id = "a_frame_that_nobody_knows"
            publishers["scan"].publish(scan)
            odom = Odometry()  # neither frame nor orientation
            odom.header.stamp = now
            publishers["odom"].publish(odom)
            odom.header.frame_id, odom.pose.pose.orientation.w = "map", 1.0
            odom.header.stamp = now + rospy.Duration(100.0)
            publishers["odom"].publish(odom)
            odom.header.stamp = now - rospy.Duration(100.0)
            publishers["odom"].publish(odom)
            tracks = ObstacleTracks()
            tracks.header.stamp, tracks.header.frame_id = now, "map"
            tracks.tracks = [ObstacleTrack(id=1, radius=float("nan"))]
            publishers["obstacles"].publish(tracks)
            observation = Observation(has_scan=True, has_detections=True)
            observation.header.stamp, observation.header.frame_id = now, "map"
            publishers["observation"].publish(observation)
            goal = PoseStamped()
            goal.header.frame_id, goal.pose.orientation.w = "map", 1.0
            goal.pose.position.x = float("inf")
            publishers["goal"].publish(goal)
            grid = OccupancyGrid()
            grid.header.frame_id, grid.info.width, grid.info.height = "map", 1000, 1000
            publishers["/map"].publish(grid)
            time.sleep(0.02)
        self.assertTrue(wait_until(lambda: self.robot.status.inputs_refused >= before + 100, 2.0),
                        "%d" % (self.robot.status.inputs_refused - before))
        for publisher in publishers.values():
            publisher.unregister()
        self.still_drives()


if __name__ == "__main__":
    rospy.init_node("malformed_test")
    rostest.rosrun("spf_empc_ros", "malformed", Malformed, sys.argv)
