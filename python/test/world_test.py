"""The world step by step: its robots, driven from Python, move as they do in the program, to the bit."""
import numpy as np
import pytest

import spf
from project import SCENARIOS

T2 = spf.Scenario.load(SCENARIOS / "t2.yaml")


def drive(world, robots):
    """The loop of docs/python.md: every robot thinks, then all move."""
    observation, _ = world.reset(options={"trial": 3})
    actions = np.zeros((world.robots, 3))
    done = False
    while not done:
        now = observation["time"]
        told = []
        for i, robot in enumerate(robots):
            if not world.active[i]:
                continue
            robot.add_pose(now, observation["pose"][i], now)
            for message in world.messages(i):
                robot.add_message(message, now)
            if observation["observed"][i]:
                robot.add_observation(world.observation(i), now)
            output = robot.step(now)
            actions[i] = output["wheel_speeds"]
            if output["broadcast"] is not None:
                told.append((i, output["broadcast"]))
        for i, message in told:
            world.broadcast(i, message)
        observation, reward, terminated, truncated, info = world.step(actions)
        done = terminated or truncated
    return reward, info


def test_robots_of_python_move_as_in_a_trial_bit_for_bit():
    world = spf.World(T2, trial=3)
    trial = T2.run(3)
    _, info = drive(world, [world.robot(i) for i in range(world.robots)])
    result = world.result()
    assert f"{result['digest']:016x}" == trial.digest.rjust(16, "0")
    assert result["outcome"] == trial.outcome and result["sim_time"] == trial.sim_time
    assert info["arrived"].all() and info["contacts"] == 0
    assert result["dynamic_distance"] == trial.dynamic_distance


def test_a_fleet_drives_itself_trial_after_trial():
    world = spf.World(T2)
    fleet = spf.Fleet(world)
    for number in (3, 0):
        world.reset(options={"trial": number})
        while not world.finished:
            world.step(fleet.act())
        assert f"{world.result()['digest']:016x}" == T2.run(number).digest


def test_a_fleet_obeys_as_in_a_trial():
    events = [{"at": 2, "robot": 0, "do": "pause"}, {"at": 4, "robot": 0, "do": "resume"},
              {"at": 3, "robot": 1, "do": "break_down"}, {"at": 9, "robot": 1, "do": "repair"},
              {"at": 5, "robot": 2, "do": "goal", "goal": [-9, 0]}, {"at": 6, "robot": 3, "do": "cancel"},
              {"at": 1, "robot": 4, "do": "leave"}, {"at": 7, "robot": 4, "do": "join"}]
    told = T2.changed({"events": events, "trial.goals": "drawn", "trial.time_limit": 25})
    world = spf.World(told)
    fleet = spf.Fleet(world)
    observation, _ = world.reset()
    seen = []
    while not world.finished:
        seen += [(order["robot"], order["do"]) for order in world.orders]
        observation, *_ = world.step(fleet.act())
    assert {(event["robot"], event["do"]) for event in events} <= set(seen)
    assert len(seen) > len(events)  # goals that were drawn
    assert np.isnan(observation["goal"][3]).all()
    assert f"{world.result()['digest']:016x}" == told.run(0).digest


def test_a_robot_is_told_another_goal_and_to_pause():
    world = spf.World(T2)
    world.reset()
    robot = world.robot(0)
    robot.set_goal([1.0, 2.0], heading=0.5)
    robot.set_switches(paused=True)
    robot.cancel()
    with pytest.raises(ValueError, match="goal"):
        robot.set_goal([float("nan"), 0.0])


def test_robots_of_several_kinds_drive_as_in_a_trial():
    mixed = T2.changed({"fleet": [{"robot": {"drive": "car", "max_acceleration": 0.8}},
                                  {"robot": {"drive": "mecanum", "radius": 0.2}, "method": "orca"}]})
    world = spf.World(mixed)
    fleet = spf.Fleet(world)
    world.reset()
    while not world.finished:
        action = fleet.act()
        assert action.shape == (5, 4) and (action[0, 2:] == 0.0).all()  # a car has two inputs
        world.step(action)
    assert f"{world.result()['digest']:016x}" == mixed.run(0).digest


def test_a_robot_of_a_fleet_can_be_driven_otherwise():
    world = spf.World(T2)
    fleet = spf.Fleet(world)
    del fleet
    fleet = spf.Fleet(spf.World(T2))  # the world lives as long as its fleet
    assert fleet.act().shape == (5, 3)
    fleet = spf.Fleet(world)
    start = world.reset()[1]["pose"]
    for _ in range(100):
        action = fleet.act()
        action[0] = 0.0
        *_, info = world.step(action)
    moved = np.linalg.norm(info["pose"][:, :2] - start[:, :2], axis=1)
    assert moved[0] < 1e-6 and moved[1:].min() > 0.3


def test_a_robot_starts_afresh_after_a_jump_of_its_clock():
    robot = spf.World(T2).robot(0)
    robot.step(0.0)
    assert len(robot.trajectory) > 0
    robot.step(1e6)
    assert robot.trajectory is None and robot.status["reason"] != "moving"


def test_shapes_and_rewards():
    world = spf.World(T2)
    observation, info = world.reset()
    assert info["trial"] == 0 and world.reset()[1]["trial"] == 1
    observation, info = world.reset(options={"trial": 7})
    assert observation["time"] == 0.0 and observation["observed"].all()
    assert observation["pose"].shape == info["pose"].shape == (5, 3)
    assert observation["goal"].shape == info["velocity"].shape == (5, 2)
    assert observation["obstacles"].shape[0] == 5 and observation["obstacles"].shape[2] == 5
    start = info["pose"].copy()
    forward = np.tile(spf.Drive().input_for((0.5, 0.0, 0.0)), (5, 1))
    gained = np.zeros(5)
    for _ in range(50):
        observation, reward, terminated, truncated, info = world.step(forward)
        gained += reward
        assert not terminated and not truncated
    goal = observation["goal"]
    apart = [np.linalg.norm(goal - poses[:, :2], axis=1) for poses in (start, info["pose"])]
    np.testing.assert_allclose(gained, apart[0] - apart[1])
    assert observation["time"] == pytest.approx(0.5) and np.linalg.norm(info["velocity"], axis=1).min() > 0.2


def test_a_trial_and_a_seed_are_drawn_anew_and_repeat():
    world = spf.World(T2)
    first = world.reset(options={"trial": 2})[1]["pose"]
    other_seed = world.reset(seed=5, options={"trial": 2})[1]["pose"]
    assert not np.array_equal(first, other_seed)
    np.testing.assert_array_equal(other_seed, spf.World(T2.changed({"seed": 5}), trial=2).reset()[1]["pose"])
    np.testing.assert_array_equal(first, spf.World(T2).reset(options={"trial": 2})[1]["pose"])


def test_time_and_contacts_end_a_trial():
    world = spf.World(T2.changed({"trial.time_limit": 0.1}))
    world.reset()
    still = np.zeros((5, 3))
    flags = [world.step(still)[2:4] for _ in range(10)]
    assert flags[-1] == (False, True) and flags[:-1] == [(False, False)] * 9
    with pytest.raises(ValueError, match="has ended"):
        world.step(still)
    wall = spf.World(spf.Scenario.from_dict({"family": "explicit", "border": {"low": [-2, -2], "high": [2, 2]},
                                             "robots": [{"start": [0, 0], "goal": [0, 1], "heading": 0.0}]}))
    wall.reset()
    ahead = [spf.Drive().input_for((1.0, 0.0, 0.0))]
    for _ in range(400):
        *_, terminated, truncated, info = wall.step(ahead)
        if terminated:
            break
    assert terminated and not truncated and info["contacts"] == 1 and wall.result()["outcome"] == "collision"


def test_scans_are_seen():
    sensed = spf.World(spf.Scenario.load(SCENARIOS / "t2.yaml", {"sensing.map": "sensed"}))
    sensed.reset()
    ranges = sensed.observation(0).ranges
    assert ranges.shape == (180,) and (ranges > 0).all()
    assert spf.World(T2).observation(0).ranges is None
    own = spf.Observation(0.5, [(1, 2, 0, 0.1, 0.3)])
    np.testing.assert_array_equal(own.detections, [(1, 2, 0, 0.1, 0.3)])


@pytest.mark.parametrize("call, words", [
    (lambda w: w.step(np.zeros((5, 2))), "must be numbers in [-1000, 1000] of shape (5, 3)"),
    (lambda w: w.step(None), "action = None must be numbers"),
    (lambda w: w.step(np.full((5, 3), np.nan)), "must be numbers in [-1000, 1000]"),
    (lambda w: w.reset(options={"trail": 1}), "may hold trial alone"),
    (lambda w: w.reset(options={"trial": -1}), "must be a whole number in [0, 1000000000]"),
    (lambda w: w.reset(seed=-1), "seed = -1 must"),
    (lambda w: w.robot(5), "robot = 5 must lie in [0, 4]"),
    (lambda w: w.observation(-1), "robot = -1 must lie in [0, 4]"),
    (lambda w: w.messages(9), "robot = 9 must lie in [0, 4]"),
    (lambda w: w.robot(0).step(float("nan")), "now = nan must be a number"),
    (lambda w: spf.World(T2.changed({"trial.tracking": "ideal"})), "trial.tracking = ideal must be full"),
    (lambda w: spf.Observation(0.0, [(1, 2, 0, 0, -1)]), "must end with a radius greater than 0 m"),
])
def test_bad_arguments_are_refused_by_name(call, words):
    world = spf.World(T2)
    world.reset()
    with pytest.raises(ValueError) as refused:
        call(world)
    assert words in str(refused.value)
