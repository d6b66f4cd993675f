#!/usr/bin/python3
"""Two robots on two machines: two network namespaces joined by a cable (veth), which this test makes and removes.
The first holds master, simulator and robot 0, the second robot 1, each started as docs/ros_tutorial.md says. Both must
reach their goals, must have heard each other over the cable, and robot 1 must survive that the cable is pulled for a while.
Exit status 77 (skipped) where the kernel or the rights do not allow namespaces.
"""
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SCENARIO = """\
family: explicit
robots:
  - {start: [-4, -1], goal: [4, 1]}
  - {start: [4, -1], goal: [-4, 1]}
border: {low: [-8, -6], high: [8, 6]}
"""
ADDRESS = {"a": "10.83.0.1", "b": "10.83.0.2"}
MASTER = f"http://{ADDRESS['a']}:11311"
CUT = 1.5  # [s] without the cable


def ip(*arguments):
    subprocess.run(["ip", *arguments], check=True, capture_output=True, text=True)


class Machine:
    """A network namespace with one end of the cable."""

    def __init__(self, letter, folder):
        self.name = f"spf{os.getpid()}{letter}"
        self.address = ADDRESS[letter]
        self.folder = folder / letter
        self.folder.mkdir()
        self.started = []
        ip("netns", "add", self.name)

    def run(self, *command):
        ip("netns", "exec", self.name, *command)

    def connect(self, interface):
        self.interface = interface
        ip("link", "set", interface, "netns", self.name)
        self.run("ip", "address", "add", f"{self.address}/24", "dev", interface)
        self.run("ip", "link", "set", interface, "up")
        self.run("ip", "link", "set", "lo", "up")

    def start(self, name, *command):
        environment = dict(os.environ, ROS_MASTER_URI=MASTER, ROS_IP=self.address, ROS_HOME=str(self.folder),
                           ROS_LOG_DIR=str(self.folder))
        environment.pop("ROS_HOSTNAME", None)
        with open(self.folder / f"{name}.log", "w", encoding="utf-8") as log:
            process = subprocess.Popen(["ip", "netns", "exec", self.name, *command], env=environment, stdout=log,
                                       stderr=subprocess.STDOUT, start_new_session=True)
        self.started.append(process)
        return process

    def log(self, name):
        return (self.folder / f"{name}.log").read_text(encoding="utf-8", errors="replace")

    def processes(self):
        found = subprocess.run(["ip", "netns", "pids", self.name], capture_output=True, text=True, check=False)
        return [int(word) for word in found.stdout.split()]

    def remove(self):
        for process in reversed(self.started):
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
        for process in self.started:
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                pass
        for process in self.processes():
            os.kill(process, signal.SIGKILL)
        for process in self.started:
            process.wait()
        subprocess.run(["ip", "netns", "delete", self.name], check=False, capture_output=True)


def longest_gap(log, robot):
    """Between two commands that reached a base, as the simulator tells at its end [s]."""
    return float(re.search(rf"robot{robot}: \d+ commands, \d+ late, longest gap ([\d.]+) s", log).group(1))


def drive_and_pull(first, second, folder):
    scenario = folder / "scenario.yaml"
    scenario.write_text(SCENARIO, encoding="utf-8")
    fleet = first.start("fleet", "roslaunch", "spf_empc_ros", "fleet.launch", f"scenario:={scenario}", "robots:=1")
    second.start("robot", "roslaunch", "--wait", "spf_empc_ros", "robot.launch", "robot_id:=1")
    watch = first.start("watch", "bash", "-c", "until rosparam list >/dev/null 2>&1; do sleep 0.3; done; exec rosrun "
                        f"spf_empc_ros fleet_watch --timeout 120 --json {folder}/outcome.json --at 3 'touch {folder}/on_way'")
    deadline = time.monotonic() + 150.0
    cut = False
    while watch.poll() is None and time.monotonic() < deadline:
        time.sleep(0.2)
        if not cut and (folder / "on_way").exists():
            second.run("ip", "link", "set", second.interface, "down")
            time.sleep(CUT)
            second.run("ip", "link", "set", second.interface, "up")
            cut = True
    fleet.send_signal(signal.SIGINT)
    fleet.wait(30)
    print(first.log("watch"))
    outcome = json.loads((folder / "outcome.json").read_text(encoding="utf-8"))
    gaps = [longest_gap(first.log("fleet"), robot) for robot in range(2)]
    print(f"longest gaps between commands: {gaps} s")
    problems = []
    if not cut:
        problems.append("the trial was over before the cable could be pulled")
    if outcome["outcome"] != "success":
        problems.append(f"the trial ended with {outcome['outcome']}: {outcome['cause']}")
    for robot in outcome["robots"]:
        if robot["heard"] < 10:
            problems.append(f"robot {robot['robot']} heard {robot['heard']} messages of the other")
    if gaps[1] < 0.8 * CUT:
        problems.append("robot 1 was commanded while its cable was pulled: it is not on another machine")
    if gaps[0] >= 0.8 * CUT:
        problems.append("robot 0 stopped when robot 1's cable was pulled")
    return problems


def main():
    machines = []
    with tempfile.TemporaryDirectory(prefix="spf-two-machines-") as name:
        folder = Path(name)
        try:
            try:
                for letter in "ab":
                    machines.append(Machine(letter, folder))
                ends = [f"spf{os.getpid() % 100000}{machine.name[-1]}0" for machine in machines]
                ip("link", "add", ends[0], "type", "veth", "peer", "name", ends[1])
                for machine, end in zip(machines, ends):
                    machine.connect(end)
            except (OSError, subprocess.CalledProcessError) as error:
                print(f"skipped: no network namespaces here ({getattr(error, 'stderr', '') or error})")
                return 77
            problems = drive_and_pull(*machines, folder)
        finally:
            for machine in reversed(machines):
                machine.remove()
    print("\n".join(problems) if problems else "both machines' robots arrived")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
