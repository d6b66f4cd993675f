"""A small world for the nodes under test: robots that obey cmd_vel at once, their sensors, and switches to make these
fail. Nodes run as processes of their own, which can be killed and started again."""
import math
import os
import signal
import subprocess
import threading
import time
import unittest

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, TransformStamped, Twist
from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import LaserScan
from spf_empc_msgs.msg import ObstacleTracks, RobotStatus, TrackerStatus, WheelSpeeds
from tf2_msgs.msg import TFMessage

HALF_LENGTH, HALF_WIDTH, CELL = 45.0, 4.0, 0.2  # [m] of the hall
BASE_TIMEOUT = 0.5  # [s] after which a base stands without commands, as real ones do (host.command_silence)
MAX_SPEED = 1.0  # [m/s] of config/robot.yaml
PERIOD = 0.05  # [s] of control
MAX_CHANGE = 1.0 * PERIOD  # [m/s] by its largest acceleration
GUARD_MEMORY = 0.2  # [s] for which a change may still be the guard's, which alone may stop a robot harder


def node_program(name):
    folder = os.environ.get("SPF_ROS_NODES") or subprocess.check_output(
        ["catkin_find", "--first-only", "--libexec", "spf_empc_ros"], text=True).strip()
    return os.path.join(folder, name)


class Robot:
    """One robot: its truth, its sensors, and what its nodes said."""

    def __init__(self, number, x=0.0, y=0.0):
        self.number = number
        self.x, self.y, self.heading = x, y, 0.0
        self.odom_on = self.scan_on = self.obstacles_on = self.localised = True
        self.odom_frame, self.base_frame = "map", "robot%d/base_link" % number
        self.map_to_odom = (0.0, 0.0, 0.0)  # x, y, heading of the odometry's frame, told by tf unless it is the map's
        self.walkers = []  # (radius [m], function of the time [s] that gives x, y): what its scanner meets
        self.largest_speed = 0.0  # [m/s] of the commands
        self.changes = []  # (time [s], change [m/s]) from one command to the next
        self.guard_times = []  # at which the guard held a command back
        self.last = {}  # stamp of the last message of each sensor
        self.command, self.command_time = Twist(), 0.0
        self.speeds = []  # (stamp [s], commanded speed [m/s]) of every control tick
        self.status, self.tracker = RobotStatus(), TrackerStatus()
        self.processes = {}
        space = "/robot%d/" % number
        self.odom = rospy.Publisher(space + "odom", Odometry, queue_size=10, tcp_nodelay=True)
        self.scan = rospy.Publisher(space + "scan", LaserScan, queue_size=2, tcp_nodelay=True)
        self.obstacles = rospy.Publisher(space + "obstacles", ObstacleTracks, queue_size=2, tcp_nodelay=True)
        self.transforms = rospy.Publisher("/tf", TFMessage, queue_size=10, tcp_nodelay=True)
        self.goal = rospy.Publisher(space + "goal", PoseStamped, queue_size=1, latch=True)
        rospy.Subscriber(space + "cmd_vel", Twist, self.on_command, tcp_nodelay=True)
        rospy.Subscriber(space + "wheel_speeds", WheelSpeeds, self.on_wheels, tcp_nodelay=True)
        rospy.Subscriber(space + "status", RobotStatus, lambda m: setattr(self, "status", m))
        rospy.Subscriber(space + "tracker_status", TrackerStatus, lambda m: setattr(self, "tracker", m))

    # ---- nodes
    def start(self, program, *arguments):
        name = program.replace("_node", "")
        environment = dict(os.environ, ROS_NAMESPACE="/robot%d" % self.number)
        log = open(os.path.join(os.environ.get("ROS_LOG_DIR", "/tmp"), "robot%d_%s.log" % (self.number, name)), "a")
        self.processes[program] = subprocess.Popen(
            [node_program(program), "__name:=" + name, "_robot_id:=%d" % self.number] + list(arguments),
            env=environment, stdout=log, stderr=log)
        log.close()

    def start_all(self, *arguments):
        for program in ("planner_node", "tracker_node", "perception_node"):
            self.start(program, *arguments)

    def kill(self, program):
        self.processes[program].send_signal(signal.SIGKILL)
        self.processes[program].wait()

    def alive(self):
        return all(process.poll() is None for process in self.processes.values())

    # ---- what it is told, and tells
    def on_command(self, message):
        before = self.command
        now = time.monotonic()
        self.largest_speed = max(self.largest_speed, math.hypot(message.linear.x, message.linear.y))
        self.changes.append((now, self.change(before, message, now - self.command_time)))
        self.command, self.command_time = message, now

    @staticmethod
    def change(before, after, seconds):
        """[m/s] from one command to the next: as seen from the body that turns, or in the map, where that is less. When a
        command was given is known to a period, since messages take their time."""
        def in_map(seconds):
            turn = 0.5 * (before.angular.z + after.angular.z) * seconds
            c, s = math.cos(turn), math.sin(turn)
            x, y = c * after.linear.x - s * after.linear.y, s * after.linear.x + c * after.linear.y
            return math.hypot(x - before.linear.x, y - before.linear.y)
        return min(map(in_map, (0.0, PERIOD, min(seconds, 2.0 * PERIOD))))

    def largest_change(self):
        """[m/s] of all commands but those that the guard held back."""
        return max((change for now, change in self.changes
                    if all(abs(now - guarded) > GUARD_MEMORY for guarded in self.guard_times)), default=0.0)

    def on_wheels(self, message):
        if message.guard != WheelSpeeds.CLEAR:
            self.guard_times.append(time.monotonic())
        if len(message.speeds) == 3:
            # Three wheels 120 degrees apart: the sum of squares is 3/2 of the squared speed without turning.
            self.speeds.append((message.header.stamp.to_sec(), math.sqrt(sum(v * v for v in message.speeds) / 1.5)))

    def speed(self):
        return self.speeds[-1][1] if self.speeds else 0.0

    def send_goal(self, x, y):
        message = PoseStamped()
        message.header.frame_id = "map"
        message.pose.position.x, message.pose.position.y, message.pose.orientation.w = x, y, 1.0
        self.goal.publish(message)

    def move(self, dt):
        if time.monotonic() - self.command_time > BASE_TIMEOUT:
            self.command = Twist()
        c, s = math.cos(self.heading), math.sin(self.heading)
        self.x += dt * (c * self.command.linear.x - s * self.command.linear.y)
        self.y += dt * (s * self.command.linear.x + c * self.command.linear.y)
        self.heading += dt * self.command.angular.z

    def sense(self, stamp, tick):
        if self.odom_on:
            message = Odometry()
            message.header.stamp, message.header.frame_id = stamp, self.odom_frame
            message.child_frame_id = self.base_frame
            x, y = self.x, self.y
            left, up, turn = self.map_to_odom
            c, s = math.cos(turn), math.sin(turn)
            message.pose.pose.position.x = c * (x - left) + s * (y - up)
            message.pose.pose.position.y = -s * (x - left) + c * (y - up)
            message.pose.pose.orientation.z = math.sin(0.5 * (self.heading - turn))
            message.pose.pose.orientation.w = math.cos(0.5 * (self.heading - turn))
            self.odom.publish(message)
            self.last["odom"] = stamp.to_sec()
        if tick % 5 == 0 and self.localised and self.odom_frame != "map":
            self.tell_odom_frame(stamp)
        if tick % 10 == 0 and self.scan_on:
            scan = free_scan(stamp, self.number, 360 if self.walkers else 90)
            self.meet_walkers(scan)
            scan.header.frame_id = self.base_frame
            self.scan.publish(scan)
            self.last["scan"] = stamp.to_sec()
        if tick % 10 == 5 and self.obstacles_on:
            message = ObstacleTracks()
            message.header.stamp, message.header.frame_id = stamp, "map"
            self.obstacles.publish(message)
            self.last["obstacles"] = stamp.to_sec()

    def meet_walkers(self, scan):
        for radius, position in self.walkers:
            x, y = position(scan.header.stamp.to_sec())
            dx, dy = x - self.x, y - self.y
            for i, before in enumerate(scan.ranges):
                angle = self.heading + scan.angle_min + i * scan.angle_increment
                along = dx * math.cos(angle) + dy * math.sin(angle)
                inside = radius * radius - (dx * dx + dy * dy - along * along)
                if along > 0.0 and inside >= 0.0:
                    reading = along - math.sqrt(inside)
                    scan.ranges[i] = min(before, reading if reading < scan.range_max else float("inf"))

    def tell_odom_frame(self, stamp):
        """What a localisation tells: where the odometry's frame is in the map."""
        message = TransformStamped()
        message.header.stamp, message.header.frame_id = stamp, "map"
        message.child_frame_id = self.odom_frame
        x, y, turn = self.map_to_odom
        message.transform.translation.x, message.transform.translation.y = x, y
        message.transform.rotation.z, message.transform.rotation.w = math.sin(0.5 * turn), math.cos(0.5 * turn)
        self.transforms.publish(TFMessage(transforms=[message]))
        self.last["localisation"] = stamp.to_sec()


def free_scan(stamp, number, beams=90):
    message = LaserScan()
    message.header.stamp, message.header.frame_id = stamp, "robot%d/base_link" % number
    message.angle_min, message.angle_max = -math.pi, math.pi - 2.0 * math.pi / beams
    message.angle_increment, message.range_max = 2.0 * math.pi / beams, 8.0
    message.ranges = [float("inf")] * beams
    return message


class World:
    """Moves the robots and their sensors at 100 Hz on a thread."""

    def __init__(self, robots):
        self.robots = robots
        self.least_distance = float("inf")
        self.diagnostics = set()
        self.health = {}  # (level, message) of the newest line of each name
        self.ended = False
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.on_diagnostics)
        self.map = rospy.Publisher("/map", OccupancyGrid, queue_size=1, latch=True)
        self.map.publish(hall())
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def on_diagnostics(self, message):
        for status in message.status:
            self.diagnostics.add((status.name, status.message))
            self.health[status.name] = (status.level, status.message)

    def run(self):
        tick, before = 0, time.monotonic()
        while not self.ended:
            time.sleep(max(0.0, before + 0.01 - time.monotonic()))
            now = time.monotonic()
            dt, before = now - before, now
            tick += 1
            for robot in self.robots:
                robot.move(dt)
                robot.sense(rospy.Time.from_sec(time.time()), tick)
            for i, one in enumerate(self.robots):
                for other in self.robots[:i]:
                    self.least_distance = min(self.least_distance, math.hypot(one.x - other.x, one.y - other.y))

    def end(self):
        """Ends everything; fails where a command has been beyond the limits, whatever the test was about."""
        self.ended = True
        self.thread.join()
        self.end_nodes()
        for robot in self.robots:
            print("robot %d: %d commands, largest %.4f m/s, largest change %.4f m/s" % (
                robot.number, len(robot.changes), robot.largest_speed, robot.largest_change()))
            assert robot.largest_speed <= 1.01 * MAX_SPEED, robot.largest_speed
            assert robot.largest_change() <= 1.1 * MAX_CHANGE, robot.largest_change()

    def end_nodes(self):
        for robot in self.robots:
            for process in robot.processes.values():
                if process.poll() is None:
                    process.terminate()
        for robot in self.robots:
            for process in robot.processes.values():
                try:
                    process.wait(timeout=5)
                except subprocess.TimeoutExpired:
                    process.kill()


def hall():
    """An empty hall; the world ends at its edges."""
    grid = OccupancyGrid()
    grid.header.frame_id = "map"
    grid.info.resolution = CELL
    grid.info.width, grid.info.height = round(2 * HALF_LENGTH / CELL), round(2 * HALF_WIDTH / CELL)
    grid.info.origin.position.x, grid.info.origin.position.y = -HALF_LENGTH, -HALF_WIDTH
    grid.info.origin.orientation.w = 1.0
    grid.data = [0] * (grid.info.width * grid.info.height)
    return grid


def wait_until(condition, seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.01)
    return condition()


def drive(robot, seconds=20.0):
    """Sends it to the end of the hall that is farther away, and waits until it goes there at full speed."""
    goal = 40.0 if robot.x < 0.0 else -40.0
    robot.send_goal(goal, 0.0)

    def under_way():
        forward = robot.command.linear.x * math.copysign(1.0, goal) * math.cos(robot.heading)
        return robot.speed() > 0.9 and forward > 0.8
    return wait_until(under_way, seconds)


def braking_begins(robot, after, longest=3.0):
    """The stamp [s] of the first command that is clearly slower than one before it, from a time on; None: never."""
    def find():
        top = 0.0
        for stamp, speed in list(robot.speeds):
            if stamp < after:
                continue
            if speed < top - 0.03:
                return stamp
            top = max(top, speed)
        return None
    wait_until(lambda: find() is not None, longest)
    return find()


def stands(robot, seconds=3.0):
    return wait_until(lambda: robot.speed() < 0.01, seconds)


class OneRobotTest(unittest.TestCase):
    """Tests that share one robot, its nodes as processes of their own, and its world."""
    number = 0

    @classmethod
    def setUpClass(cls):
        cls.robot = Robot(cls.number)
        cls.world = World([cls.robot])
        cls.robot.start_all()

    @classmethod
    def tearDownClass(cls):
        cls.world.end()


NOWHERE = (0.0, 50.0)  # [m] out of sight
