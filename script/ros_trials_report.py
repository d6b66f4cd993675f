#!/usr/bin/env python3
"""ros_trials_report.py FOLDER [--speed X] [--one-process true|false] [--commit C] [--report FILE]

Compares the trials that script/ros-trials ran through ROS (FOLDER/ros-K.json) with those of `spf run`
(FOLDER/program/trials.jsonl), prints a table, and writes a page. Exit status: 1 when ROS lost more than one trial more.
"""
import argparse
import json
import platform
import statistics
import sys
import time
from pathlib import Path

ALLOWED = 1  # trial that ROS may lose more than one process
LATE_SHARE = 0.05  # above this share of late control ticks, the machine was too slow for the speed


def program_trials(folder):
    lines = (folder / "program" / "trials.jsonl").read_text(encoding="utf-8").splitlines()
    return {record["trial"]: record for record in map(json.loads, lines)}


def ros_trials(folder):
    return {int(file.stem.split("-")[1]): json.loads(file.read_text(encoding="utf-8"))
            for file in folder.glob("ros-*.json")}


def last_arrival(trial):
    times = [robot["arrived_s"] for robot in trial["robots"]]
    return max(times) if all(time is not None for time in times) else None


def program_last_arrival(record):
    robots = record["robots"]
    return max(robot["travel_time"] for robot in robots) if all(robot["arrived"] for robot in robots) else None


def text(value, form="{:.1f}"):
    return "-" if value is None else form.format(value)


def ticks(trial, kind):
    counts = [robot[kind] for robot in trial["robots"]]
    return sum(count["count"] for count in counts), sum(count["late"] for count in counts)


def machine():
    model = "unknown processor"
    for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    return f"{model}, {len(sorted(Path('/sys/devices/system/cpu').glob('cpu[0-9]*')))} processors, {platform.system()} " \
           f"{platform.release()}"


def lines_of(ros, program, options):
    yield "| trial | ROS | last arrival [s] | one process | last arrival [s] | plans (late) | control ticks (late) |"
    yield "|---|---|---|---|---|---|---|"
    for trial in sorted(ros):
        plans, late_plans = ticks(ros[trial], "plans")
        controls, late_controls = ticks(ros[trial], "control")
        yield (f"| {trial} | {ros[trial]['outcome']} | {text(last_arrival(ros[trial]))} | {program[trial]['outcome']} | "
               f"{text(program_last_arrival(program[trial]))} | {plans} ({late_plans}) | {controls} ({late_controls}) |")


def figures(ros):
    """What was measured over all trials, as (name, text)."""
    def median_of(key, part):
        return statistics.median(trial[key][part] for trial in ros.values() if trial[key]["count"])

    def largest_of(key, part):
        return max(trial[key][part] for trial in ros.values() if trial[key]["count"])

    usages = [robot["usage"] for trial in ros.values() for robot in trial["robots"] if robot["usage"]]
    yield "plan, computing time", (f"median {median_of('plan_ms', 'median'):.2f} ms, p99 {median_of('plan_ms', 'p99'):.1f} ms"
                                   f" (worst trial's p99 {largest_of('plan_ms', 'p99'):.1f} ms)")
    yield "control tick, computing time", (f"median {median_of('control_us', 'median'):.0f} us, "
                                           f"p99 {median_of('control_us', 'p99'):.0f} us")
    yield "scan to first command that follows from it", (
        f"median {median_of('latency_ms', 'median'):.0f} ms, p99 {median_of('latency_ms', 'p99'):.0f} ms "
        f"(worst trial's p99 {largest_of('latency_ms', 'p99'):.0f} ms); simulated time, in steps of 10 ms")
    yield "age of what was seen, at every command", (
        f"median {median_of('age_ms', 'median'):.0f} ms, p99 {median_of('age_ms', 'p99'):.0f} ms")
    if usages:
        shares = sorted(usage["processor_of_core"] for usage in usages)
        memory = sorted(usage["memory_mb"] for usage in usages)
        yield "processor per robot", (f"median {100 * statistics.median(shares):.1f} % of one core, largest "
                                      f"{100 * shares[-1]:.1f} % ({usages[0]['processes']} processes)")
        yield "memory per robot (PSS)", f"median {statistics.median(memory):.0f} MB, largest {memory[-1]:.0f} MB"


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--speed", default="1.0")
    parser.add_argument("--one-process", default="false")
    parser.add_argument("--commit", default="unknown")
    parser.add_argument("--report", type=Path)
    options = parser.parse_args(arguments)
    ros, program = ros_trials(options.folder), program_trials(options.folder)
    ros_successes = sum(trial["outcome"] == "success" for trial in ros.values())
    program_successes = sum(program[trial]["outcome"] == "success" for trial in ros)
    controls, late_controls = map(sum, zip(*(ticks(trial, "control") for trial in ros.values())))
    plans, late_plans = map(sum, zip(*(ticks(trial, "plans") for trial in ros.values())))
    speeds = [trial["speed"] for trial in ros.values() if trial["speed"]]
    verdict = [f"Success: {ros_successes} of {len(ros)} through ROS, {program_successes} of {len(ros)} in one process.",
               f"Late (more than 1.5 periods after the one before): {late_plans} of {plans} plans, {late_controls} of "
               f"{controls} control ticks. Speed: {statistics.median(speeds):.2f} simulated seconds per second of "
               f"{options.speed} asked for."]
    if late_controls > LATE_SHARE * controls:
        verdict.append(f"More than {100 * LATE_SHARE:.0f} % of the control ticks came late: the machine was too slow, or "
                       "too busy, for this speed.")
    body = list(lines_of(ros, program, options)) + [""] + [f"- {name}: {value}" for name, value in figures(ros)]
    print("\n".join(verdict + [""] + body))
    if options.report:
        load = Path("/proc/loadavg").read_text(encoding="utf-8").split()[0]
        one = " --one-process" if options.one_process == "true" else ""
        head = [f"# Table 2 through ROS, {time.strftime('%Y-%m-%d')}", "",
                f"Written by `script/ros-trials --first {min(ros)} --trials {len(ros)} --speed {options.speed}{one} --report "
                f"{options.report}`, commit {options.commit}, on {machine()}; load at the end {load}.",
                "Five robots cross the field of Table 2 among four discs (walk, 1 Sigma). On ROS every robot has "
                + ("one process" if one else "three processes (perception, planner, tracker)")
                + ", talks over TCP on one machine, and is moved by `simulator_node`; in one process it is `spf run`. The two "
                "do not run in step, so the same scene does not give the same motion.", ""]
        options.report.write_text("\n".join(head + verdict + [""] + body) + "\n", encoding="utf-8")
    return 0 if ros_successes >= program_successes - ALLOWED else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
