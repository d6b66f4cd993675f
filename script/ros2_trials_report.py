#!/usr/bin/env python3
"""ros2_trials_report.py FOLDER : the trials that script/ros2-trials ran over DDS beside those of `spf run`.

Prints a table (Markdown). Exit status 1 when the fleet over DDS lost more than one trial more than the program.
"""
import json
import sys
from pathlib import Path

from ros_trials_report import ALLOWED, program_last_arrival, program_trials, text


def dds_trials(folder):
    return {int(file.parent.name): json.loads(file.read_text(encoding="utf-8")) for file in folder.glob("*/outcome.json")}


def row(trial, dds, program):
    robots = dds["by_robot"]
    processor = 100.0 * sum(robot["cpu_s"] for robot in robots) / len(robots) / dds["wall_s"]
    return (f"| {trial} | {dds['outcome']} | {dds['duration_s']:.1f} | {program['outcome']} | {text(program_last_arrival(program))} | "
            f"{sum(robot['commands'] for robot in robots)} ({sum(robot['late_commands'] for robot in robots)}) | "
            f"{max(robot['longest_gap_s'] for robot in robots):.3f} | {dds['clock_shifted_s']:.2f} | {processor:.0f} % | "
            f"{max(robot['memory_mb'] for robot in robots):.0f} MB |")


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    folder = Path(arguments[0])
    dds, program = dds_trials(folder), program_trials(folder)
    print("| trial | over DDS | ended [s] | one process | last arrival [s] | commands (late) | longest gap [s] | clock shifted [s] | "
          "processor of a robot | memory of a robot |\n|---|---|---|---|---|---|---|---|---|---|")
    for trial in sorted(dds):
        print(row(trial, dds[trial], program[trial]))
    wins = [sum(trial["outcome"] == "success" for trial in trials.values()) for trials in (dds, program)]
    print(f"\nover DDS {wins[0]} of {len(dds)} trials succeed, in one process {wins[1]}")
    return 0 if wins[0] >= wins[1] - ALLOWED else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
