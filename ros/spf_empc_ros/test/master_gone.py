#!/usr/bin/python3
"""The master is killed: the robot drives on over its connections, and still brakes when its pose is stale."""
import os
import signal
import socket
import subprocess
import sys
import unittest

with socket.socket() as probe:
    probe.bind(("localhost", 0))
    PORT = probe.getsockname()[1]
os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % PORT

import rosgraph  # noqa: E402  (reads the address above)
import rospy  # noqa: E402

from robot_world import Robot, World, braking_begins, drive, stands, wait_until  # noqa: E402


class MasterGone(unittest.TestCase):
    def test_drives_on(self):
        master = subprocess.Popen(["rosmaster", "--core", "-p", str(PORT)], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.DEVNULL)
        world = None
        try:
            self.assertTrue(wait_until(rosgraph.is_master_online, 20.0))
            rospy.init_node("master_gone_test", disable_signals=True)
            robot = Robot(0, -20.0)
            world = World([robot])
            robot.start_all()
            self.assertTrue(drive(robot), robot.status.reason)
            master.send_signal(signal.SIGKILL)
            master.wait()
            self.assertFalse(rosgraph.is_master_online())
            passed = robot.x
            self.assertTrue(wait_until(lambda: robot.x > passed + 3.0, 6.0), robot.status.reason)
            self.assertGreater(robot.speed(), 0.9)
            robot.odom_on = False
            begun = braking_begins(robot, robot.last["odom"])
            self.assertIsNotNone(begun)
            self.assertLess(begun - robot.last["odom"], 0.5)
            self.assertTrue(stands(robot))
            robot.odom_on = True
            self.assertTrue(drive(robot), robot.status.reason)
            self.assertTrue(robot.alive())
        finally:
            if world:
                world.end()
            if master.poll() is None:
                master.kill()


if __name__ == "__main__":
    # No clean goodbye to a master that is gone.
    result = unittest.main(exit=False).result
    sys.stdout.flush()
    os._exit(0 if result.wasSuccessful() else 1)
