"""Parameter classes: every field with its meaning, and what is said of bad values."""
import copy
import pickle

import numpy as np
import pytest

import spf

CLASSES = [value for name, value in sorted(vars(spf).items()) if name.endswith(("Parameters", "Weights"))]


def test_every_class_has_documented_fields_with_limits():
    assert len(CLASSES) == 18
    for kind in CLASSES:
        sample = kind()
        for row in sample.rows():
            if "." in row.key:
                continue
            field = getattr(kind, row.key)
            assert row.what in field.__doc__ and row.range in field.__doc__, (kind, row.key)
            assert getattr(sample, row.key) == sample.to_dict()[row.key]
        assert kind(**sample.to_dict()) == sample
        for twin in (copy.copy(sample), copy.deepcopy(sample), pickle.loads(pickle.dumps(sample)), eval("spf." + repr(sample))):
            assert twin == sample and twin is not sample


def test_fields_are_set_by_name_and_groups_by_dict():
    agent = spf.AgentParameters(field={"attention": 0.3}, heading_mode="motion")
    agent.tracker.mpc.horizon = np.int64(8)
    agent.robot = spf.RobotParameters(radius=np.float32(0.5), drive="differential")
    assert (agent.field.attention, agent.heading_mode, agent.tracker.mpc.horizon) == (0.3, "motion", 8)
    assert (agent.robot.radius, agent.robot.drive) == (0.5, "differential")
    assert agent != spf.AgentParameters() and agent != 3


def test_copies_do_not_share():
    agent = spf.AgentParameters()
    twin = copy.deepcopy(agent)
    twin.field.attention = 0.0
    assert agent.field.attention == 0.5


def test_a_group_outlives_its_owner():
    assert spf.AgentParameters(field={"attention": 0.25}).field.attention == 0.25


def test_defaults_follow_the_robot():
    small, large = (spf.defaults_for(spf.RobotParameters(radius=radius)) for radius in (0.3, 0.6))
    assert large.orca.margin == 2 * small.orca.margin


@pytest.mark.parametrize("kind, field, value, words", [
    (spf.RobotParameters, "radius", -1, "RobotParameters.radius = -1 must lie in [0.01, 5] m"),
    (spf.RobotParameters, "radius", float("nan"), "RobotParameters.radius = nan must lie in"),
    (spf.RobotParameters, "radius", "0.3", "RobotParameters.radius = '0.3' must be a number"),
    (spf.RobotParameters, "radius", None, "RobotParameters.radius = None must be a number"),
    (spf.RobotParameters, "radius", [0.3], "RobotParameters.radius = [0.3] must be a number"),
    (spf.RobotParameters, "wheels", 3.5, "RobotParameters.wheels = 3.5 must be a whole number"),
    (spf.RobotParameters, "wheels", 10**400, "must lie in [3, 6]"),
    (spf.RobotParameters, "drive", "omny", "must be one of omni, mecanum, differential, car; did you mean omni?"),
    (spf.RobotParameters, "drive", 0, "RobotParameters.drive = 0 must be one of"),
    (spf.RobotParameters, "may_reverse", 1, "RobotParameters.may_reverse = 1 must be True or False"),
    (spf.AgentParameters, "robot", 1, "AgentParameters.robot = 1 must be a RobotParameters or a dict"),
    (spf.AgentParameters, "robot", {"radius": 9}, "RobotParameters.radius = 9 must lie in [0.01, 5] m"),
    (spf.FieldParameters, "atention", 0.5, "FieldParameters has no field 'atention'; did you mean attention?"),
])
def test_bad_values_are_refused_by_name(kind, field, value, words):
    before = kind()
    with pytest.raises(ValueError) as refused:
        setattr(before, field, value)
    assert words in str(refused.value)
    assert before == kind()
    with pytest.raises(ValueError) as refused:
        kind(**{field: value})
    assert words in str(refused.value)
