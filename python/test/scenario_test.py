"""Scenarios from files, texts and dicts, and what is said of bad ones."""
import numpy as np
import pytest

import spf
from project import ROOT, SCENARIOS, program

YARD = {"family": "explicit", "border": {"low": [-6, -6], "high": [6, 6]},
        "robots": [{"start": [-4, 0], "goal": np.array([4.0, 0.0])}],
        "boxes": [{"low": np.array([-1.5, -0.4]), "high": (-0.5, 1.5)}], "trial": {"tracking": "ideal"}}


def test_values_are_read_by_key():
    scenario = spf.Scenario.load(SCENARIOS / "t2.yaml", {"noise": {"level": 0.5}, "sensing.range": 5})
    assert scenario.family == "t2" and scenario.method == "space_time" and scenario.seed == 20240501
    assert scenario["noise.level"] == 0.5 and scenario["sensing.range"] == 5.0 and scenario["noise.model"] == "walk"
    assert scenario["agent.planner"]["weights"] == scenario["agent.planner.weights"]
    assert scenario.agent.robot.max_speed == scenario["robot.max_speed"]
    assert scenario.trial_count is None and "t2.yaml" in repr(scenario)
    with pytest.raises(KeyError, match="did you mean noise.level"):
        scenario["noise.levle"]


def test_changes_carry_defaults_along():
    small = spf.Scenario.load(SCENARIOS / "t2.yaml")
    large = small.changed({"robot.radius": 2 * small["robot.radius"]})
    assert small["robot.radius"] * 2 == large["robot.radius"]
    assert large["agent.orca.margin"] == 2 * small["agent.orca.margin"]  # a default that follows the size
    assert large.changed({"agent.orca.margin": 0.05})["agent.orca.margin"] == 0.05


def test_text_dict_and_back():
    scenario = spf.Scenario.from_dict(YARD)
    np.testing.assert_array_equal(scenario["robots"][0]["goal"], [4.0, 0.0])
    np.testing.assert_array_equal(scenario["boxes"][0]["low"], [-1.5, -0.4])
    trial = scenario.run()
    assert trial.succeeded
    for again in (spf.Scenario.from_dict(scenario.to_dict()), spf.Scenario.from_text(scenario.to_yaml()),
                  spf.Scenario.from_text(scenario.to_yaml(explains=True))):
        assert again.run().digest == trial.digest


def test_parameters_are_those_of_the_program():
    table = program("parameters", "--json").splitlines()
    rows = spf.all_parameters()
    assert len(rows) == len(table) > 200
    speed = next(row for row in rows if row.key == "robot.max_speed")
    assert (speed.unit, speed.range) == ("m/s", "[0.01, 20]") and "largest planned speed" in speed.what
    changed = spf.Scenario.load(SCENARIOS / "t2.yaml", {"robot.max_speed": 0.5}).parameters()
    assert next(row for row in changed if row.key == "robot.max_speed").value == "0.5"


def test_every_scenario_of_the_repository_loads():
    for path in sorted(SCENARIOS.glob("*.yaml")):
        assert spf.Scenario.load(path).family


def test_contradictions_are_told():
    warned = spf.Scenario.load(SCENARIOS / "t2.yaml", {"sensing.range": 1.0}).warnings
    assert any("sensing.range" in warning for warning in warned)


@pytest.mark.parametrize("settings, words", [
    ({"noise.level": -1}, "noise.level = -1 must lie in [0, 100]"),
    ({"noise.levle": 1}, "did you mean noise.level?"),
    ({"noise.level": float("nan")}, "noise.level = .nan must"),
    ({"noise.level": None}, "noise.level = none must"),
    ({"method": "space_tme"}, "did you mean space_time?"),
    ({"robots": 0, "sensing.range": 1e9}, "sensing.range = 1e+09 must lie in [0.1, 1000] m"),
    ({"robots": "a: [b"}, "robots = "),
    ({"robots": object()}, "must hold numbers, texts, lists and dicts"),
])
def test_bad_settings_are_refused_by_name(settings, words):
    with pytest.raises(ValueError) as refused:
        spf.Scenario.load(SCENARIOS / "t2.yaml", settings)
    assert words in str(refused.value)


def test_errors_name_file_line_and_key(tmp_path):
    path = tmp_path / "bad.yaml"
    path.write_text("family: t2\nnoise:\n  level: 1000\n")
    with pytest.raises(spf.InputError) as refused:
        spf.Scenario.load(path)
    assert f"{path}:3:10: noise.level = 1000 must lie in [0, 100]" in str(refused.value)
    with pytest.raises(spf.InputError, match="nowhere.yaml"):
        spf.Scenario.load(tmp_path / "nowhere.yaml")
    with pytest.raises(spf.InputError, match="robots"):
        spf.Scenario.from_dict({"family": "explicit"})
    assert issubclass(spf.InputError, ValueError) and (ROOT / "scenarios").is_dir()
