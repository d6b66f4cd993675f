"""What the tests know of the project: its folder, its program, and what a Python session needs of both."""
import json
import os
import subprocess
from pathlib import Path

ROOT = Path(os.environ["SPF_SOURCE_DIR"])
SCENARIOS = ROOT / "scenarios"
TIMINGS = {"plan_ms_median", "plan_ms_p99", "plan_ms_max", "control_us_median", "control_us_p99", "wall_seconds"}


def program(*arguments):
    """What the program prints."""
    return subprocess.run([os.environ["SPF_PROGRAM"], *map(str, arguments)], check=True, text=True, cwd=ROOT,
                          capture_output=True).stdout


def without_timings(row):
    """A row of results, or its line of JSON, without what differs from run to run."""
    row = json.loads(row) if isinstance(row, str) else row
    return {key: value for key, value in row.items() if key not in TIMINGS}
