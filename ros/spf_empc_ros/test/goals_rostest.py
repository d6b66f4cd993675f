#!/usr/bin/python3
"""Goals as users know them: the action move_base with its feedback and its results, beside the topics; and what may change while a
robot drives."""
import math
import os
import subprocess
import sys
import time
import unittest

import dynamic_reconfigure
import dynamic_reconfigure.client
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped
from std_msgs.msg import Empty

from goal_user import GoalsTest, User, angle_between, goal_at
from robot_world import stands, wait_until


class Action(GoalsTest):
    def test_arrives_with_the_heading_of_the_goal_and_says_so(self):
        for x, y, heading in ((2.0, 1.0, 2.0), (-1.0, -1.0, -1.5)):
            self.user.send(x, y, heading)
            state, text = self.user.result(20.0)
            self.assertEqual((state, text), (GoalStatus.SUCCEEDED, "reached"))
            self.assertLess(self.distance(x, y), 0.08)
            self.assertLess(angle_between(self.robot.heading, heading), 0.12)
            self.assertGreater(len(self.user.positions), 5)
            self.assertLess(math.hypot(self.user.positions[-1].x - x, self.user.positions[-1].y - y), 0.5)
            self.assertTrue(wait_until(lambda: self.robot.status.reason == "arrived", 1.0), self.robot.status.reason)

    def test_gives_up_at_once_where_the_map_forbids_the_goal(self):
        for position, reason in (((20.2, 0.0), "the goal is in a wall, or nearer to one than the robot goes"),
                                 ((80.0, 0.0), "the goal is off the map")):
            x, y = self.robot.x, self.robot.y
            self.user.send(*position)
            state, text = self.user.result(3.0)
            self.assertEqual((state, text), (GoalStatus.ABORTED, reason))
            self.assertLess(self.distance(x, y), 0.02)
            self.assertTrue(wait_until(lambda: self.robot.status.goal_outcome == reason, 1.0))
            self.assertTrue(wait_until(lambda: ("robot0: planner", "gave up: " + reason) in self.world.diagnostics, 2.0))

    def test_gives_up_when_no_path_has_led_there_for_its_timeout(self):
        client = dynamic_reconfigure.client.Client("/robot0/planner", timeout=10.0)
        client.update_configuration({"goal_patience": 2.0})
        begun = time.monotonic()
        self.user.send(23.0, 0.0)
        state, text = self.user.result(20.0)
        self.assertEqual((state, text), (GoalStatus.ABORTED, "no path to the goal for 2 s"))
        self.assertGreater(time.monotonic() - begun, 2.0)
        self.assertTrue(stands(self.robot))
        client.update_configuration({"goal_patience": 10.0})
        client.close()

    def test_a_newer_goal_of_either_kind_takes_its_place(self):
        other = User(self.robot)
        self.assertTrue(other.client.wait_for_server(rospy.Duration(5.0)))
        self.user.send(*self.end_ahead())
        self.assertTrue(self.under_way())
        other.send(self.robot.x, 1.0)
        self.assertEqual(self.user.result(2.0), (GoalStatus.PREEMPTED, "a newer goal"))
        topic = rospy.Publisher("/robot0/goal", PoseStamped, queue_size=1)
        self.assertTrue(wait_until(lambda: topic.get_num_connections() > 0, 5.0))
        topic.publish(goal_at(self.robot.x, 0.0).target_pose)
        self.assertEqual(other.result(2.0), (GoalStatus.PREEMPTED, "a newer goal"))
        self.assertTrue(wait_until(lambda: self.robot.status.goal_outcome == "reached", 15.0), self.robot.status)

    def test_a_cancelled_goal_makes_it_brake_and_hold(self):
        self.user.send(*self.end_ahead())
        self.assertTrue(self.under_way())
        self.user.client.cancel_goal()
        self.assertEqual(self.user.result(2.0), (GoalStatus.PREEMPTED, "cancelled"))
        self.assertTrue(stands(self.robot))
        self.assertEqual(self.robot.status.reason, "no goal")
        cancel = rospy.Publisher("/robot0/cancel", Empty, queue_size=1)
        self.assertTrue(wait_until(lambda: cancel.get_num_connections() > 0, 5.0))
        self.user.send(*self.end_ahead())
        self.assertTrue(self.under_way())
        cancel.publish(Empty())
        self.assertEqual(self.user.result(2.0), (GoalStatus.PREEMPTED, "cancelled"))
        self.assertTrue(stands(self.robot))

    def test_a_goal_that_is_none_is_rejected_and_the_one_before_it_stays(self):
        self.user.send(*self.end_ahead())
        self.assertTrue(self.under_way())
        refused = self.robot.status.inputs_refused
        other = User(self.robot)
        self.assertTrue(other.client.wait_for_server(rospy.Duration(5.0)))
        bad = goal_at(1.0, 1.0)
        bad.target_pose.pose.orientation.w = 0.0
        other.client.send_goal(bad)
        state, text = other.result(2.0)
        self.assertEqual((state, text), (GoalStatus.REJECTED, "its orientation is no unit quaternion"))
        self.assertTrue(wait_until(lambda: self.robot.status.inputs_refused > refused, 1.0))
        self.assertEqual(self.user.result(20.0)[0], GoalStatus.SUCCEEDED)

    def test_the_program_says_what_became_of_it(self):
        program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scripts", "send_goal")
        x, y = self.end_ahead()
        arrives = subprocess.run([program, "/robot0", str(0.3 * x + 0.7 * self.robot.x), str(y), "1.0"], stdout=subprocess.PIPE,
                                 text=True, timeout=40.0)
        self.assertEqual(arrives.returncode, 0, arrives.stdout)
        self.assertEqual(arrives.stdout.splitlines()[-1], "succeeded: reached")
        gives_up = subprocess.run([program, "/robot0", "80", "0"], stdout=subprocess.PIPE, text=True, timeout=40.0)
        self.assertEqual(gives_up.returncode, 1)
        self.assertEqual(gives_up.stdout.splitlines()[-1], "aborted: the goal is off the map")


class RunTime(GoalsTest):
    def setUp(self):
        self.parameters = dynamic_reconfigure.client.Client("/robot0/planner", timeout=10.0)

    def tearDown(self):
        self.parameters.update_configuration({"speed_limit": 1.0, "pause": False})
        self.parameters.close()

    def test_a_limit_of_speed_is_braked_to_within_max_acceleration_and_survives_the_planner(self):
        self.user.send(*self.end_ahead())
        self.assertTrue(self.under_way())
        first = len(self.robot.speeds)
        self.parameters.update_configuration({"speed_limit": 0.3})
        self.assertTrue(wait_until(lambda: self.robot.speed() < 0.32, 2.0), self.robot.speed())
        rospy.sleep(1.0)
        # Over two ticks, since stamps of single ones are up to a tick off on a busy machine.
        speeds = self.robot.speeds[first:]
        for (before, fast), (after, slow) in zip(speeds, speeds[2:]):
            self.assertLess(fast - slow, 1.2 * max(after - before, 0.1))
        self.assertAlmostEqual(self.robot.status.max_speed, 0.3)
        self.robot.kill("planner_node")
        self.assertTrue(self.at_rest())
        first = len(self.robot.speeds)
        self.robot.start("planner_node")
        self.assertTrue(wait_until(lambda: self.robot.speed() > 0.25, 15.0), self.robot.status.reason)
        rospy.sleep(1.0)
        self.assertLess(max(speed for _, speed in self.robot.speeds[first:]), 0.32)
        self.parameters.close()
        self.parameters = dynamic_reconfigure.client.Client("/robot0/planner", timeout=10.0)
        self.parameters.update_configuration({"speed_limit": 1.0})
        self.assertTrue(self.under_way(5.0))
        self.assertEqual(self.user.result(20.0)[0], GoalStatus.SUCCEEDED)

    def test_a_pause_holds_it_and_it_goes_on_with_the_same_goal(self):
        self.user.send(*self.end_ahead())
        self.assertTrue(self.under_way())
        self.parameters.update_configuration({"pause": True})
        self.assertTrue(stands(self.robot))
        self.assertEqual(self.robot.status.reason, "paused")
        self.assertEqual(self.user.client.get_state(), GoalStatus.ACTIVE)
        self.parameters.update_configuration({"pause": False})
        self.assertEqual(self.user.result(20.0)[0], GoalStatus.SUCCEEDED)

    def test_what_is_out_of_range_is_refused_as_in_files(self):
        before = self.parameters.get_configuration(5.0)
        for values in ({"speed_limit": 1.5}, {"speed_limit": 0.0}, {"goal_tolerance": -1.0, "speed_limit": 0.5},
                       {"heading_mode": "sideways"}):
            with self.assertRaises(dynamic_reconfigure.DynamicReconfigureCallbackException):
                self.parameters.update_configuration(values)
        self.assertEqual(self.parameters.get_configuration(5.0), before)
        limits = {field["name"]: (field["min"], field["max"]) for field in self.parameters.get_parameter_descriptions(5.0)}
        self.assertEqual(limits["speed_limit"], (0.01, 1.0))
        self.assertEqual(limits["goal_tolerance"], (0.001, 1.0))
        self.assertEqual(self.parameters.update_configuration({"heading_mode": "motion"})["heading_mode"], "motion")
        self.parameters.update_configuration({"heading_mode": "keep"})


class Suite(unittest.TestSuite):
    def __init__(self):
        super().__init__()
        for case in (Action, RunTime):
            self.addTests(unittest.defaultTestLoader.loadTestsFromTestCase(case))


if __name__ == "__main__":
    rospy.init_node("goals_test")
    rostest.rosrun("spf_empc_ros", "goals", "goals_rostest.Suite", sys.argv)
