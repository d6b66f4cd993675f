"""A method written in Python runs in the harness beside the built-in ones."""
import math

import numpy as np
import pytest

import spf
from project import ROOT

YARD = ROOT / "examples" / "own_method" / "yard.yaml"


class StraightAhead:
    """Follows the guide at half the speed and stops for what is in its way."""

    def __init__(self, parameters):
        self.robot = parameters.robot
        self.hold = 0.2  # [s]

    def plan(self, request):
        here = request.position
        speed = min(0.5 * self.robot.max_speed, math.sqrt(self.robot.max_acceleration * request.cost_to_go(here)))
        target = speed * request.direction(here)
        plan = spf.Trajectory(request.time)
        change = np.linalg.norm(target - request.velocity)
        velocity = request.velocity
        for end, duration in ((target, max(change / self.robot.max_acceleration, 0.05)), (target, self.hold),
                              (np.zeros(2), max(speed / self.robot.max_acceleration, 0.05))):
            plan.append(spf.constant_acceleration(here, velocity, end, duration), duration)
            here = here + 0.5 * duration * (velocity + end)
            velocity = end
        return plan


def table(make, **more):
    methods = spf.MethodTable()
    methods.add("straight_ahead", "follows the guide", make, **more)
    return methods


def test_it_arrives_and_repeats_on_any_number_of_threads():
    scenario = spf.Scenario.load(YARD, methods=table(StraightAhead))
    trial = scenario.run()
    assert trial.succeeded and trial.method == "straight_ahead"
    assert scenario.run(jobs=2).same_result(trial)
    rows = spf.Campaign.of(scenario, trials=4).run(jobs=2).rows
    assert rows[0]["success"] == 4 and rows[0]["method"] == "straight_ahead"


def test_it_runs_beside_others_in_a_campaign():
    campaign = spf.Campaign.load(YARD.with_name("yard_campaign.yaml"), methods=table(StraightAhead))
    assert [row["method"] for row in campaign.run().rows] == ["straight_ahead", "space_time"]


def test_the_table_knows_its_methods():
    methods = table(StraightAhead)
    assert "straight_ahead" in methods and "orca" in methods and "straight_ahead" not in spf.MethodTable()
    assert methods.all["straight_ahead"] == "follows the guide"
    with pytest.raises(ValueError, match="orca"):
        methods.add("orca", "again", StraightAhead)
    with pytest.raises(ValueError, match="did you mean straight_ahead"):
        spf.Scenario.load(YARD, {"method": "strait_ahead"}, methods=methods)


def test_it_may_change_parameters():
    seen = []

    def make(parameters):
        seen.append(parameters.robot.max_speed)
        return StraightAhead(parameters)

    def slow(parameters):
        parameters.heading_mode = "motion"
        parameters.team.plan_period = 0.2

    scenario = spf.Scenario.load(YARD, methods=table(make, change=slow))
    assert scenario["agent.heading_mode"] == "motion" and scenario["agent.team.plan_period"] == 0.2
    assert scenario.run().succeeded and seen == [1.0]


def test_a_planner_of_its_own_by_name():
    ground = spf.OccupancyMap((-6, -6), (6, 6))
    result = spf.Planner("straight_ahead", methods=table(StraightAhead)).plan(ground, (-4, 0), (4, 0))
    assert result.outcome == "success" and result.trajectory.velocity(0.6)[0] == pytest.approx(0.5)


def test_requests_hold_what_they_promise_and_expire():
    kept = []

    class Curious(StraightAhead):
        def plan(self, request):
            if not kept:
                assert request.robot_id == 0 and request.peers == [] and request.goal.tolist() == [4, 0]
                assert request.goal_heading is None and request.position_sigma >= 0 and not request.braking
                assert request.committed is not None and request.heading == 0.0 and request.yaw_rate == 0.0
                track, = request.tracks
                assert track.radius == 0.4 and track.sigma(1.0) >= track.sigma() and track.id == 0
                np.testing.assert_allclose(track.velocity, [0, 0.5])
                assert request.distance(request.position) == request.copy_map().distance(request.position)
                assert request.distance_gradient([[0, 0]]).shape == (1, 2)
                np.testing.assert_allclose(request.descend(request.position, 0.0), request.position)
                kept.append(request)
            return super().plan(request)

    assert spf.Scenario.load(YARD, methods=table(Curious)).run().succeeded
    with pytest.raises(ValueError, match="valid during the call of plan"):
        kept[0].position


@pytest.mark.parametrize("answer, words", [
    (lambda request: 1 / 0, "ZeroDivisionError"),
    (lambda request: "left", "must be a Trajectory, or None to stop"),
    (lambda request: spf.Trajectory(request.time), "must have pieces"),
    (lambda request: spf.Trajectory.standing(request.position, request.time + 1), "must start at request.time"),
    (lambda request: spf.Trajectory.standing(request.position + 1, request.time), "must start at request.position"),
])
def test_a_bad_answer_ends_the_run_with_its_reason(answer, words):
    class Bad:
        def plan(self, request):
            return answer(request)

    scenario = spf.Scenario.load(YARD, methods=table(lambda parameters: Bad()))
    with pytest.raises((RuntimeError, ValueError), match=words):
        scenario.run()
    with pytest.raises(RuntimeError, match="trial 0"):
        spf.Campaign.of(scenario, trials=2).run(jobs=2)


def test_stopping_is_an_answer():
    class Lazy:
        def plan(self, request):
            return None

    trial = spf.Scenario.load(YARD, {"trial.time_limit": 3}, methods=table(lambda parameters: Lazy())).run()
    assert trial.outcome == "overtime"


def test_a_robot_that_cannot_move_sideways_needs_headings():
    scenario = spf.Scenario.load(YARD, {"robot.drive": "differential"}, methods=table(StraightAhead))
    with pytest.raises(ValueError, match="cannot move sideways"):
        scenario.run()
    with pytest.raises(ValueError, match="must have a plan"):
        spf.Scenario.load(YARD, methods=table(lambda parameters: 3)).run()
