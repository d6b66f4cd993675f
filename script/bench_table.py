#!/usr/bin/env python3
"""bench_table.py FILE.json... : one line per benchmark, median and worst of its repetitions, and its counters."""
import json
import statistics
import sys

NANOSECONDS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
# What Google Benchmark itself writes for a run; any other number is a counter of ours.
OWN_FIELDS = {
    "family_index", "per_family_instance_index", "repetitions", "repetition_index", "threads", "iterations",
    "real_time", "cpu_time",
}


def human(nanoseconds):
    """Three significant digits in the unit that suits."""
    for unit in ("s", "ms", "us"):
        if nanoseconds >= NANOSECONDS[unit]:
            return f"{nanoseconds / NANOSECONDS[unit]:.3g} {unit}"
    return f"{nanoseconds:.3g} ns"


def read(path):
    """Runs by benchmark name, in the order of the file; failures as sentences."""
    with open(path, encoding="utf-8") as file:
        entries = json.load(file)["benchmarks"]
    runs, failures = {}, []
    for entry in entries:
        if entry.get("error_occurred"):
            failures.append(f"{entry['name']}: {entry.get('error_message', 'failed')}")
        elif entry.get("run_type") == "iteration":
            runs.setdefault(entry.get("run_name", entry["name"]), []).append(entry)
    return runs, failures


def main(paths):
    rows, failures = [("benchmark", "median", "worst", "n", "counters (median)")], []
    for path in paths:
        runs, failed = read(path)
        failures += failed
        for name, entries in runs.items():
            times = [entry["real_time"] * NANOSECONDS[entry["time_unit"]] for entry in entries]
            counters = [
                f"{key} {statistics.median(entry[key] for entry in entries if key in entry):.4g}"
                for key, value in entries[0].items()
                if key not in OWN_FIELDS and isinstance(value, (int, float)) and not isinstance(value, bool)
            ]
            rows.append((name, human(statistics.median(times)), human(max(times)), str(len(times)), ", ".join(counters)))
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    for name, *numbers, counters in rows:
        cells = [name.ljust(widths[0])] + [cell.rjust(width) for cell, width in zip(numbers, widths[1:])]
        print("  ".join(cells + [counters]).rstrip())
    for failure in failures:
        print(f"FAILED {failure}", file=sys.stderr)
    return 1 if failures or len(rows) == 1 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
