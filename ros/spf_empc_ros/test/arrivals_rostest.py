#!/usr/bin/python3
"""A planner whose period is long plans when something is observed all the same: every scan has a plan that knows it and a
command that follows. What peers tell brings no plan forward. Counted, not timed: scan_latency.py measures."""
import sys

import rospy
import rostest
from spf_empc_msgs.msg import TrackerStatus, Trajectory

from robot_world import ScannerAloneTest, drive, wait_until

CONFIG = """\
agent: {team: {plan_period: 0.5}}
host: {plan_silence: 1.5, relies_on_obstacles: false}
"""
SCANS = 50
SAME = 1e-4  # [s] within which two stamps are one


class Arrivals(ScannerAloneTest):
    start = -30.0
    config = CONFIG

    @classmethod
    def prepare(cls):
        super().prepare()
        cls.plans, cls.commands = [], []  # (what was observed [s], message)
        rospy.Subscriber("/robot0/trajectory", Trajectory,
                         lambda m: cls.plans.append(m.observed.to_sec()), tcp_nodelay=True)
        rospy.Subscriber("/robot0/tracker_status", TrackerStatus, cls.on_tick, tcp_nodelay=True)

    @classmethod
    def on_tick(cls, message):
        if message.latency_ms >= 0.0:
            cls.commands.append(message.header.stamp.to_sec() - 1e-3 * message.latency_ms)

    def scans(self):
        """The stamps of so many scans as they come; and what was planned meanwhile."""
        plans, stamps = len(self.plans), []

        def enough():
            if not stamps or self.robot.last["scan"] != stamps[-1]:
                stamps.append(self.robot.last["scan"])
            return len(stamps) >= SCANS

        self.assertTrue(wait_until(enough, 30.0))
        self.assertTrue(wait_until(lambda: self.plans[-1] > stamps[-1] - SAME, 5.0), self.robot.status.reason)
        return stamps, self.plans[plans:]

    def test_every_scan_is_planned_with_and_followed(self):
        self.assertTrue(drive(self.robot), self.robot.status.reason)
        stamps, plans = self.scans()
        self.assertTrue(wait_until(lambda: self.commands[-1] > stamps[-1] - SAME, 5.0))
        known = lambda stamp, events: any(abs(event - stamp) < SAME for event in events)
        # A machine that is busy elsewhere may let two scans come before a plan.
        self.assertGreater(sum(known(stamp, plans) for stamp in stamps), 0.7 * SCANS)
        self.assertGreater(sum(known(stamp, self.commands) for stamp in stamps), 0.7 * SCANS)
        self.assertLess(len(plans), 1.2 * SCANS)

    def test_peers_bring_no_plan_forward(self):
        self.assertTrue(drive(self.robot), self.robot.status.reason)
        air = rospy.Publisher("/swarm/trajectories", Trajectory, queue_size=100)
        heard = self.robot.status.messages_accepted

        def tell(_):
            message = Trajectory()
            message.header.stamp, message.header.frame_id = rospy.Time.now(), "map"
            message.sequence = tell.sequence = tell.sequence + 1
            message.expiry, message.start = message.header.stamp + rospy.Duration(1.5), message.header.stamp
            message.heading_start = message.header.stamp
            message.radius, message.state = 0.3, Trajectory.STOPPED
            message.durations = [1.0]
            for number in range(1, 11):
                message.robot_id = number
                message.coefficients = [40.0, 0, 0, 0, 0, 0, -3.5 + 0.7 * number, 0, 0, 0, 0, 0]
                air.publish(message)

        tell.sequence = 0
        timer = rospy.Timer(rospy.Duration(0.05), tell)  # 200 messages a second
        try:
            self.assertTrue(wait_until(lambda: self.robot.status.messages_accepted > heard + 100, 10.0))
            _, plans = self.scans()
        finally:
            timer.shutdown()
        self.assertLess(len(plans), 1.2 * SCANS)


if __name__ == "__main__":
    rospy.init_node("arrivals_test")
    rostest.rosrun("spf_empc_ros", "arrivals", Arrivals, sys.argv)
