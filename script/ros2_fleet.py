#!/usr/bin/env python3
"""ros2_fleet.py [options] : one trial of a simulated fleet on ROS 2, every robot with processes of its own, over loopback.

Starts `spf-ros2 simulator` and the nodes of each robot in a DDS domain of their own, waits for the end of the trial, ends what it
has started, and prints what came of it: outcome, contacts, time, processor and memory of each robot. Exit status: 0 all robots
arrived without contact, 1 contact or timeout, 2 it could not be run, or was not done in time.
"""
import argparse
import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ROLES = ("tracker", "planner", "perception")
SUMMARY = re.compile(r"^trial (?P<trial>\d+): (?P<outcome>.+?) after (?P<duration>[\d.]+) s, (?P<arrived>\d+) of (?P<robots>\d+) robots "
                     r"at goal, (?P<contacts>\d+) contacts?(?:: (?P<cause>.*))?$", re.MULTILINE)
PACE = re.compile(r"^simulated (?P<simulated>[\d.]+) s in (?P<wall>[\d.]+) s; the clock was shifted (?P<shifts>\d+) times, by "
                  r"(?P<lost>[\d.]+) s", re.MULTILINE)
COMMANDS = re.compile(r"^robot(?P<robot>\d+): (?P<count>\d+) commands, (?P<late>\d+) late, longest gap (?P<gap>[\d.]+) s", re.MULTILINE)


class Process:
    """A program in the background, its output in a file."""

    def __init__(self, name, command, environment, log):
        self.name, self.status, self.usage = name, None, None
        self.log = Path(log, name + ".log")
        with open(self.log, "wb") as output:
            self.id = subprocess.Popen(command, env=environment, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                                       start_new_session=True).pid

    def ended(self, wait=False):
        if self.status is None:
            pid, status, usage = os.wait4(self.id, 0 if wait else os.WNOHANG)
            if pid:
                self.status, self.usage = os.waitstatus_to_exitcode(status), usage
        return self.status is not None

    def end(self, patience=5.0):
        """Asks for it, and does not ask again."""
        if self.ended():
            return
        os.kill(self.id, signal.SIGINT)
        end = time.monotonic() + patience
        while not self.ended() and time.monotonic() < end:
            time.sleep(0.02)
        if not self.ended():
            os.kill(self.id, signal.SIGKILL)
            self.ended(wait=True)

    def seconds(self):
        return self.usage.ru_utime + self.usage.ru_stime

    def megabytes(self):
        return self.usage.ru_maxrss / 1024


def simulator_command(options):
    given = {"scenario": options.scenario, "trial": options.trial, "speed": float(options.speed), "quit_when_done": "true"}
    command = [options.program, "simulator", "--ros-args"]
    for name, value in given.items():
        command += ["-p", f"{name}:={value}"]
    if options.set:
        command += ["-p", "overrides:=" + json.dumps(options.set)]
    for name, value in (parameter.split(":=", 1) for parameter in options.parameter):
        command += ["-p", f"{name}:={value}"]
    return command


def robot_command(options, role, robot):
    command = [options.program, role, "--ros-args", "-r", f"__ns:=/robot{robot}"]
    for name, value in (("robot_id", robot), ("use_sim_time", "true"), ("config", options.config)):
        command += ["-p", f"{name}:={value}"]
    return command


def run(options):
    """All processes, ended; None when the trial was not done in time or somebody died."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("ROS_", "CYCLONEDDS"))}
    environment.update(ROS_DOMAIN_ID=str(options.domain), ROS_LOCALHOST_ONLY="1")
    log = Path(options.out, "log")
    log.mkdir(parents=True, exist_ok=True)
    processes = []
    try:
        simulator = Process("simulator", simulator_command(options), environment, log)
        processes.append(simulator)
        for robot in range(options.robots):
            for role in ("robot",) if options.one_process else ROLES:
                processes.append(Process(f"robot{robot}_{role}", robot_command(options, role, robot), environment, log))
        end = time.monotonic() + options.timeout
        while not simulator.ended():
            died = [process for process in processes if process.ended() and process is not simulator]
            if died:
                print(f"{died[0].name} ended with status {died[0].status}: {died[0].log}", file=sys.stderr)
                return None
            if time.monotonic() > end:
                print(f"not done within {options.timeout:g} s: {log}", file=sys.stderr)
                return None
            time.sleep(0.05)
    finally:
        for process in processes:
            if process is not processes[0] and not process.ended():
                os.kill(process.id, signal.SIGINT)  # all at once, then one after the other
        for process in processes:
            process.end()
    return processes


def figures(options, processes):
    """What the simulator said, and what the processes used."""
    simulator = processes[0]
    text = simulator.log.read_text(encoding="utf-8", errors="replace")
    summary, pace = SUMMARY.search(text), PACE.search(text)
    if not summary or not pace:
        print(f"the simulator did not say what came of it: {simulator.log}", file=sys.stderr)
        return None
    wall = float(pace["wall"])
    result = {"trial": int(summary["trial"]), "outcome": summary["outcome"], "cause": summary["cause"] or "",
              "robots": int(summary["robots"]), "arrived": int(summary["arrived"]), "contacts": int(summary["contacts"]),
              "duration_s": float(summary["duration"]), "wall_s": wall, "clock_shifts": int(pace["shifts"]),
              "clock_shifted_s": float(pace["lost"]),
              "simulator": {"cpu_s": round(simulator.seconds(), 2), "memory_mb": round(simulator.megabytes(), 1)}, "by_robot": []}
    for match in COMMANDS.finditer(text):
        own = [process for process in processes if process.name.startswith(f"robot{match['robot']}_")]
        result["by_robot"].append({
            "robot": int(match["robot"]), "commands": int(match["count"]), "late_commands": int(match["late"]),
            "longest_gap_s": float(match["gap"]), "cpu_s": round(sum(process.seconds() for process in own), 2),
            "memory_mb": round(sum(process.megabytes() for process in own), 1)})
    return result


def table(result, options):
    robots = result["by_robot"]
    cpu = [100.0 * robot["cpu_s"] / result["wall_s"] for robot in robots]
    rows = [("outcome", result["outcome"] + (": " + result["cause"] if result["cause"] else "")),
            ("robots at goal", f"{result['arrived']} of {result['robots']}"), ("contacts", str(result["contacts"])),
            ("simulated", f"{result['duration_s']:.2f} s in {result['wall_s']:.2f} s, speed {options.speed:g}"),
            ("clock shifted", f"{result['clock_shifts']} times, by {result['clock_shifted_s']:.3f} s in all"),
            ("commands", f"{sum(robot['commands'] for robot in robots)}, {sum(robot['late_commands'] for robot in robots)} late, "
                         f"longest gap {max(robot['longest_gap_s'] for robot in robots):.3f} s"),
            ("a robot's processor", f"{sum(cpu) / len(cpu):.0f} % of a core, at most {max(cpu):.0f} %, all its processes"),
            ("a robot's memory", f"{max(robot['memory_mb'] for robot in robots):.0f} MB at most, all its processes"),
            ("simulator", f"{100.0 * result['simulator']['cpu_s'] / result['wall_s']:.0f} % of a core, "
                          f"{result['simulator']['memory_mb']:.0f} MB")]
    return "\n".join(f"{name:<22} {value}" for name, value in rows)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/spf-ros2"))
    parser.add_argument("--scenario", default=str(ROOT / "ros/spf_empc_ros/config/fleet.yaml"))
    parser.add_argument("--config", default=str(ROOT / "ros/spf_empc_ros/config/robot.yaml"), help="parameter file of every robot")
    parser.add_argument("--robots", type=int, default=5, help="how many robots the scenario has")
    parser.add_argument("--trial", type=int, default=0)
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="a key of the scenario file")
    parser.add_argument("--parameter", action="append", default=[], metavar="NAME:=VALUE", help="a parameter of the simulator")
    parser.add_argument("--speed", type=float, default=1.0, help="simulated seconds per second")
    parser.add_argument("--one-process", action="store_true", help="one process for each robot instead of three")
    parser.add_argument("--domain", type=int, default=1 + os.getpid() % 100, help="DDS domain")
    parser.add_argument("--timeout", type=float, default=240.0, help="seconds until it is given up")
    parser.add_argument("--out", default="results/ros2-demo", help="folder of logs and outcome.json")
    return parser.parse_args()


def main():
    options = arguments()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(130))
    processes = run(options)
    result = figures(options, processes) if processes else None
    if result is None:
        return 2
    Path(options.out, "outcome.json").write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")
    print(table(result, options))
    return 0 if result["outcome"] == "success" else 1


if __name__ == "__main__":
    sys.exit(main())
