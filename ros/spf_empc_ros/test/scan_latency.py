#!/usr/bin/python3
"""How long a scan takes to the first command that follows a plan made with it: a robot drives through a hall past people
who walk there, its scanner is all that it has. Base and scanner are the tests' own; scans keep no step with anything.

  build/release/devel/env.sh ros/spf_empc_ros/test/scan_latency.py [--one-process] [--rate HZ] [--scans N] ...

Prints, in milliseconds from the publication of a scan: when the plan with it began, when that had arrived, the control
tick that followed it first (the stamp of the command, from which on it counts), and when that had arrived; then how many
plans were made, their computing time, and what each program took of a core. The master is one of its own, on loopback.
Exit status 1 when more than one scan in 20 found no command, 2 when the robot does not drive.
"""
import argparse
import bisect
import math
import os
import random
import socket
import subprocess
import sys
import tempfile
import threading
import time

with socket.socket() as probe:
    probe.bind(("localhost", 0))
    PORT = probe.getsockname()[1]
os.environ["ROS_MASTER_URI"] = "http://localhost:%d" % PORT
os.environ["ROS_HOSTNAME"] = "localhost"

import rosgraph  # noqa: E402  (reads the addresses above)
import rospy  # noqa: E402
from sensor_msgs.msg import LaserScan  # noqa: E402
from spf_empc_msgs.msg import RobotStatus, TrackerStatus, Trajectory  # noqa: E402

from robot_world import HALF_LENGTH, HALF_WIDTH, Robot, World, drive, wait_until  # noqa: E402

CONFIG = """\
agent: {perception: {enabled: true}}
host: {relies_on_obstacles: false%s}
"""
BEAMS, RANGE, WALKER = 720, 8.0, 0.25  # [1], [m], [m]
JITTER = 0.1  # [1] of the time between two scans, either way
SAME = 1e-4  # [s] within which two stamps are one
LONGEST = 1.0  # [s] after which no command is waited for


def walkers(now):
    """Eight people who walk up and down beside the robot's path."""
    length = 2.0 * HALF_LENGTH - 4.0
    for number in range(8):
        distance = (number * length / 4.0 + (0.4 + 0.1 * number) * now) % (2.0 * length)
        yield (abs(distance - length) - 0.5 * length, 1.6 if number % 2 else -1.6)


class Scanner:
    """Publishes scans of the hall and of who walks in it, each with the stamp of its publication."""

    def __init__(self, robot, rate):
        self.robot, self.rate = robot, rate
        self.stamps = []
        self.ended = False
        self.random = random.Random(1)
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def run(self):
        due = time.monotonic()
        while not self.ended:
            message = self.scan(time.time())
            time.sleep(max(0.0, due - time.monotonic()))
            due = max(due, time.monotonic() - 0.1) + (1.0 + self.random.uniform(-JITTER, JITTER)) / self.rate
            stamp = time.time()
            message.header.stamp = rospy.Time.from_sec(stamp)
            self.stamps.append(message.header.stamp.to_sec())
            self.robot.scan.publish(message)

    def scan(self, now):
        robot = self.robot
        message = LaserScan()
        message.header.frame_id = robot.base_frame
        message.angle_min, message.angle_increment, message.range_max = -math.pi, 2.0 * math.pi / BEAMS, RANGE
        message.angle_max = message.angle_min + (BEAMS - 1) * message.angle_increment
        ranges = [self.wall(robot, robot.heading + message.angle_min + i * message.angle_increment)
                  for i in range(BEAMS)]
        for x, y in walkers(now):
            dx, dy = x - robot.x, y - robot.y
            distance = math.hypot(dx, dy)
            if distance > RANGE:
                continue
            half = math.asin(min(1.0, WALKER / distance))
            middle = math.atan2(dy, dx) - robot.heading - message.angle_min
            first, last = (math.ceil((middle + side * half) / message.angle_increment) for side in (-1, 1))
            for i in range(first, last):
                off = i * message.angle_increment - middle
                reading = distance * math.cos(off) - math.sqrt(max(0.0, WALKER**2 - (distance * math.sin(off))**2))
                ranges[i % BEAMS] = min(ranges[i % BEAMS], reading)
        message.ranges = [r + self.random.gauss(0.0, 0.01) if r <= RANGE else math.inf for r in ranges]
        return message

    @staticmethod
    def wall(robot, angle):
        across = math.sin(angle)
        return ((HALF_WIDTH if across > 0.0 else -HALF_WIDTH) - robot.y) / across if across else math.inf


class Watcher:
    """What came of each scan, by the stamps in plans and commands."""

    def __init__(self):
        self.plans, self.commands, self.plan_ms = [], [], []
        rospy.Subscriber("/robot0/trajectory", Trajectory, self.on_plan, tcp_nodelay=True)
        rospy.Subscriber("/robot0/tracker_status", TrackerStatus, self.on_tick, tcp_nodelay=True)
        rospy.Subscriber("/robot0/status", RobotStatus, self.on_status, tcp_nodelay=True)

    def on_plan(self, message):
        self.plans.append((message.observed.to_sec(), message.header.stamp.to_sec(), time.time()))

    def on_tick(self, message):
        tick = message.header.stamp.to_sec()
        if message.latency_ms >= 0.0:
            self.commands.append((tick - 1e-3 * message.latency_ms, tick, time.time()))

    def on_status(self, message):
        if message.plan_ms > 0.0:
            self.plan_ms.append(message.plan_ms)


def first_after(stamp, events):
    """The first event of something that was observed at a stamp or later; what has been observed only grows."""
    at = bisect.bisect_left(events, (stamp - SAME,))
    return events[at] if at < len(events) and events[at][1] < stamp + LONGEST else None


def shares(values):
    values = sorted(values)
    at = lambda share: values[min(len(values) - 1, int(share * len(values)))]
    return "median %6.2f   p90 %6.2f   p99 %6.2f   max %6.2f" % (at(0.5), at(0.9), at(0.99), values[-1])


def seconds_of_core(process):
    with open("/proc/%d/stat" % process.pid) as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def drive_up_and_down(robot, scanner, scans):
    """Until so many scans are out."""
    forward = robot.command.linear.x > 0.0
    while len(scanner.stamps) < scans:
        if not robot.alive():
            sys.exit("a node has ended")
        if (robot.x if forward else -robot.x) > HALF_LENGTH - 8.0:
            forward = not forward
            robot.send_goal(40.0 if forward else -40.0, 0.0)
        time.sleep(0.05)


def measure(robot, scanner, watcher, scans):
    if not drive(robot, 30.0):
        print("the robot does not drive:", robot.status.reason)
        return 2
    begin, cores = time.time(), {name: seconds_of_core(process) for name, process in robot.processes.items()}
    begun = len(scanner.stamps)
    drive_up_and_down(robot, scanner, begun + scans)
    seconds = time.time() - begin
    cores = {name: seconds_of_core(process) - cores[name] for name, process in robot.processes.items()}
    time.sleep(LONGEST + 0.2)
    plans, commands = sorted(watcher.plans), sorted(watcher.commands)
    stamps = scanner.stamps[begun:begun + scans]
    planned = [(stamp, first_after(stamp, plans)) for stamp in stamps]
    followed = [(stamp, first_after(stamp, commands)) for stamp in stamps]
    own = sum(plan is not None and abs(plan[0] - stamp) < SAME for stamp, plan in planned)
    rows = {"plan began": [plan[1] - stamp for stamp, plan in planned if plan],
            "plan arrived": [plan[2] - stamp for stamp, plan in planned if plan],
            "command": [tick[1] - stamp for stamp, tick in followed if tick],
            "command arrived": [tick[2] - stamp for stamp, tick in followed if tick]}
    print("%d scans of %d beams at %.1f Hz, %d with a plan of their own, %d followed by a command; ms after a scan:" %
          (len(stamps), BEAMS, len(stamps) / seconds, own, len(rows["command"])))
    for name, values in rows.items():
        print("  %-16s %s" % (name, shares([1e3 * value for value in values]) if values else "never"))
    made = sum(begin <= plan[1] < begin + seconds for plan in plans)
    print("  %.1f plans/s, computing time in ms: %s" % (made / seconds, shares(watcher.plan_ms)))
    print("  of a core: " + ", ".join("%s %.1f %%" % (name, 100.0 * core / seconds) for name, core in cores.items()))
    return 0 if len(rows["command"]) >= 0.95 * len(stamps) else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--scans", type=int, default=600)
    parser.add_argument("--rate", type=float, default=10.0, help="of the scanner [Hz]")
    parser.add_argument("--one-process", action="store_true", help="robot_node instead of three nodes")
    parser.add_argument("--least-plan-interval", type=float, help="host.least_plan_interval [s]; 10: by the period alone")
    options = parser.parse_args()
    interval = options.least_plan_interval
    folder = tempfile.TemporaryDirectory()
    os.environ.setdefault("ROS_LOG_DIR", folder.name)
    config = os.path.join(folder.name, "robot.yaml")
    with open(config, "w") as file:
        file.write(CONFIG % ("" if interval is None else ", least_plan_interval: %g" % interval))
    master = subprocess.Popen(["rosmaster", "--core", "-p", str(PORT)], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL)
    world = None
    try:
        if not wait_until(rosgraph.is_master_online, 20.0):
            sys.exit("no master")
        sys.setswitchinterval(0.0005)
        rospy.init_node("scan_latency", disable_signals=True)
        robot = Robot(0, -30.0)
        robot.scan_on = robot.obstacles_on = False  # scans are the scanner's
        watcher, scanner = Watcher(), Scanner(robot, options.rate)
        world = World([robot])
        if options.one_process:
            robot.start("robot_node", "_config:=" + config)
        else:
            robot.start_all("_config:=" + config)
        result = measure(robot, scanner, watcher, options.scans)
        scanner.ended = True
        return result
    finally:
        if world:
            world.end()
        master.terminate()
        master.wait()
        folder.cleanup()


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    os._exit(status)  # no clean goodbye to a master that is gone
