#!/usr/bin/env python3
"""two_machines.py PROGRAM CONFIG: two robots on two machines, over DDS: two network namespaces joined by a cable (veth), which this
test makes and removes. The first holds simulator and robot 0, the second robot 1, every robot three processes. Both must reach
their goals without contact, and robot 1 must survive that the cable is pulled again and again. Then all must end when they are
asked to, without a network. Exit status 77 (skipped) where the kernel or the rights do not allow namespaces.
"""
import re
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "script"))
from machines import longest_gap, test_on_two_machines  # noqa: E402

SCENARIO = """\
family: explicit
robots:
  - {start: [-5, -1], goal: [5, 1]}
  - {start: [5, -1], goal: [-5, 1]}
border: {low: [-8, -6], high: [8, 6]}
"""
CUT = 1.5  # [s] without the cable
PLUGGED = 3.0  # [s] with it, until the next time
LATEST = 120.0  # [s]


def start(machine, program, role, **parameters):
    command = [program, role, "--ros-args"]
    if "robot_id" in parameters:
        command += ["-r", f"__ns:=/robot{parameters['robot_id']}"]
    for name, value in parameters.items():
        command += ["-p", f"{name}:={value}"]
    name = role if role == "simulator" else f"robot{parameters['robot_id']}_{role}"
    return machine.start(name, *command)


def drive_and_pull(first, second, folder, program, config):
    for machine in (first, second):
        machine.variables = {"ROS_DOMAIN_ID": "7", "ROS_LOCALHOST_ONLY": "0", "CYCLONEDDS_URI": None}
    scenario = folder / "scenario.yaml"
    scenario.write_text(SCENARIO, encoding="utf-8")
    simulator = start(first, program, "simulator", scenario=scenario, speed=1.0, quit_when_done="true")
    for robot, machine in enumerate((first, second)):
        for role in ("tracker", "planner", "perception"):
            start(machine, program, role, robot_id=robot, use_sim_time="true", config=config)
    deadline = time.monotonic() + LATEST
    next_cut = time.monotonic() + 2.0 * PLUGGED
    while simulator.poll() is None and time.monotonic() < deadline:
        time.sleep(0.1)
        if time.monotonic() < next_cut:
            continue
        second.pull()
        time.sleep(CUT)
        second.plug()
        next_cut = time.monotonic() + PLUGGED
    log = first.log("simulator")
    print(log)
    outcome = re.search(r"^trial \d+: (\w+).* (\d+) contacts?", log, re.MULTILINE)
    if not outcome:
        return ["the trial was not over in time"]
    gaps = [longest_gap(log, robot) for robot in range(2)]
    problems = []
    if outcome[1] != "success" or outcome[2] != "0":
        problems.append(f"the trial ended with {outcome[0]}")
    if gaps[1] < 0.8 * CUT:
        problems.append("robot 1 was commanded while its cable was pulled: it is not on another machine")
    if gaps[0] >= 0.8 * CUT:
        problems.append("robot 0 stopped when robot 1's cable was pulled")
    second.pull()
    for machine in (first, second):
        problems += [f"without a network, {' '.join(process.args[4:6])} does not end" for process in machine.end(5.0)]
    return problems


if __name__ == "__main__":
    paths = [str(Path(argument).resolve()) for argument in sys.argv[1:]]
    sys.exit(test_on_two_machines(lambda first, second, folder: drive_and_pull(first, second, folder, *paths)))
