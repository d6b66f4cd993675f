"""The types that editors see: every public name has one, and a type checker reads them."""
import importlib.util
import os
import subprocess
import sys

import pytest

import spf
from project import ROOT

STUBS = ROOT / "python" / "spf" / "_core.pyi"


def test_the_stubs_are_those_of_the_module():
    made = subprocess.run([sys.executable, ROOT / "script" / "python_stubs.py"], check=True, text=True,
                          capture_output=True).stdout
    assert made == STUBS.read_text(), "script/python_stubs.py > python/spf/_core.pyi mends this"


def test_every_public_name_has_a_type_and_documentation():
    text = STUBS.read_text()
    for name, value in vars(spf).items():
        if name.startswith("_"):
            continue
        assert f"class {name}" in text or f"def {name}(" in text, name
        assert value.__doc__
        for member, content in vars(value).items() if isinstance(value, type) else ():
            if not member.startswith("_"):
                assert content.__doc__.strip().splitlines()[-1].strip(), f"{name}.{member}"


USE = '''
import numpy as np
import spf
scenario = spf.Scenario.load("t2.yaml", {"noise.level": 1})
trial = scenario.run(3, record=True)
ratio: float = float(trial.robots["path_length_ratio"].mean())
field = spf.ProbabilityField((0, 0), np.zeros(2), 0.3, parameters=spf.FieldParameters(attention=0.3))
robot = spf.RobotParameters()
robot.radius = 0.4
observation, reward, terminated, truncated, info = spf.World(scenario).step(np.zeros((5, 3)))
rows = spf.Campaign.of(scenario, trials=2).run(jobs=2).rows
'''


BAD = ["robot.radius = 'wide'", "trial.succeded", "spf.Scenario.load(3)", "spf.World(scenario).step()"]


def test_a_type_checker_reads_them(tmp_path):
    if importlib.util.find_spec("mypy") is None:
        if os.environ.get("SPF_REQUIRE_TOOLS"):
            pytest.fail("mypy is not installed")
        pytest.skip("mypy is not installed")
    (tmp_path / "use.py").write_text(USE + "\n".join(BAD) + "\n")
    environment = {**os.environ, "MYPYPATH": str(ROOT / "python"), "PYTHONPATH": ""}
    checked = subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", tmp_path, "use.py"], cwd=tmp_path, env=environment,
                             text=True, capture_output=True, check=False)
    refused = [line for line in checked.stdout.splitlines() if ": error: " in line]
    first = USE.count("\n") + 1
    assert [line.split(":")[:2] for line in refused] == [["use.py", str(first + i)] for i in range(len(BAD))], checked.stdout
