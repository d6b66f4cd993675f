#!/usr/bin/python3
"""Two robots on two machines: two network namespaces joined by a cable (veth), which this test makes and removes.
The first holds master, simulator and robot 0, the second robot 1, each started as docs/ros_tutorial.md says. Both must
reach their goals, must have heard each other over the cable, and robot 1 must survive that the cable is pulled for a while.
Exit status 77 (skipped) where the kernel or the rights do not allow namespaces.
"""
import json
import signal
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "script"))
from machines import ADDRESS, longest_gap, test_on_two_machines  # noqa: E402

SCENARIO = """\
family: explicit
robots:
  - {start: [-4, -1], goal: [4, 1]}
  - {start: [4, -1], goal: [-4, 1]}
border: {low: [-8, -6], high: [8, 6]}
"""
MASTER = f"http://{ADDRESS['a']}:11311"
CUT = 1.5  # [s] without the cable


def drive_and_pull(first, second, folder):
    for machine in (first, second):
        machine.variables = {"ROS_MASTER_URI": MASTER, "ROS_IP": machine.address, "ROS_HOSTNAME": None,
                             "ROS_HOME": str(machine.folder), "ROS_LOG_DIR": str(machine.folder)}
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
            second.pull()
            time.sleep(CUT)
            second.plug()
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


if __name__ == "__main__":
    sys.exit(test_on_two_machines(drive_and_pull))
