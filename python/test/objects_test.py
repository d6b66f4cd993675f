"""Field, trajectory, drive, map, cost-to-go, controller and planner as objects, against what they must satisfy."""
import math

import numpy as np
import pytest

import spf


def test_the_field_is_the_gaussian_of_eq_1():
    field = spf.ProbabilityField(position=(1, 2), velocity=(0.6, 0.8), radius=0.4, robot_radius=0.3)
    a, b = field.half_axes
    np.testing.assert_allclose([a, b], [0.7 + 1.0 * 2.0 / 2, 0.7])
    np.testing.assert_allclose(field.center, np.array([1, 2]) + 0.5 * 2.0 * np.array([0.6, 0.8]))
    points = np.random.default_rng(1).uniform(-3, 5, (4, 7, 2))
    along = np.array([0.6, 0.8])
    apart = points - field.center
    squared = (apart @ along / a) ** 2 + (apart @ np.array([-0.8, 0.6]) / b) ** 2
    np.testing.assert_allclose(field.mahalanobis(points), np.sqrt(squared))
    np.testing.assert_allclose(field.risk(points), np.exp(-squared / 2))
    np.testing.assert_allclose(field.density(points), np.exp(-squared / 2) / (2 * math.pi * a * b))
    step = 1e-6
    for axis in np.eye(2):
        slope = (field.density(points + step * axis) - field.density(points - step * axis)) / (2 * step)
        np.testing.assert_allclose(field.density_gradient(points) @ axis, slope, atol=1e-8)
    assert isinstance(field.risk(field.center), float) and field.risk(field.center) == 1.0
    ellipse = field.ellipse(2.0)
    np.testing.assert_allclose(ellipse["half_axes"], [2 * a, 2 * b])
    on_it = field.guide_point(field.center, (0, 1), 2.0)
    assert field.mahalanobis(on_it) == pytest.approx(2.0)
    assert field.clearance(field.center, 1.0) < 0 < field.clearance(field.center + [0, 9], 1.0)
    round_one = spf.ProbabilityField((0, 0), (1, 0), 0.5, 0.0, spf.FieldParameters(directional=False))
    np.testing.assert_allclose(round_one.half_axes, [0.5, 0.5])
    np.testing.assert_allclose(round_one.escape_direction((0, 3)), [0, 1])


def test_a_trajectory_is_its_polynomials():
    coefficients = np.arange(12.0).reshape(6, 2) / 100
    trajectory = spf.Trajectory(start_time=2.0)
    trajectory.append(coefficients, 1.5)
    end = trajectory.position(3.5)
    trajectory.append(spf.constant_acceleration(end, trajectory.velocity(3.5), (0, 0), 1.0), 1.0)
    assert len(trajectory) == 2 and trajectory.end_time == 4.5 and not trajectory.steered
    np.testing.assert_array_equal(trajectory.coefficients[0], coefficients)
    np.testing.assert_array_equal(trajectory.durations, [1.5, 1.0])
    time = np.linspace(2.0, 3.49, 11)
    local = (time - 2.0)[:, None]
    np.testing.assert_allclose(trajectory.position(time), sum(c * local**k for k, c in enumerate(coefficients)))
    step = 1e-5
    np.testing.assert_allclose(trajectory.velocity(time[1:]),
                               (trajectory.position(time[1:] + step) - trajectory.position(time[1:] - step)) / (2 * step),
                               atol=1e-8)
    np.testing.assert_allclose(trajectory.acceleration(time[1:]),
                               (trajectory.velocity(time[1:] + step) - trajectory.velocity(time[1:] - step)) / (2 * step),
                               atol=1e-8)
    fine = np.linalg.norm(np.diff(trajectory.position(np.linspace(2, 4.5, 20001)), axis=0), axis=1).sum()
    assert trajectory.length() == pytest.approx(fine, rel=1e-6)
    assert trajectory.max_speed() == pytest.approx(np.linalg.norm(trajectory.velocity(np.linspace(2, 4.5, 20001)), axis=1).max())
    np.testing.assert_array_equal(trajectory.velocity(99.0), [0, 0])
    assert trajectory.position(np.zeros((2, 3))).shape == (2, 3, 2) and trajectory.heading(2.0).shape == (2,)


def test_the_minimum_jerk_curve_is_smooth_and_least():
    points, durations = np.array([(0, 0), (1, 1), (3, 0), (4, 1)]), [1.0, 1.5, 1.2]
    curve = spf.Trajectory.minimum_jerk(points, durations, start_time=5.0, velocity=(0.5, 0))
    knots = 5.0 + np.concatenate([[0], np.cumsum(durations)])
    np.testing.assert_allclose(curve.position(knots), points, atol=1e-9)
    np.testing.assert_allclose(curve.velocity(5.0), [0.5, 0], atol=1e-9)
    for value in (curve.velocity, curve.acceleration):
        np.testing.assert_allclose(value(knots[1:-1] - 1e-9), value(knots[1:-1] + 1e-9), atol=1e-6)

    def cost(trajectory):
        time = np.linspace(5.0, knots[-1], 40001)
        jerk = np.diff(trajectory.acceleration(time), axis=0) / np.diff(time)[:, None]
        return (jerk**2).sum() * (time[1] - time[0])

    one_piece = spf.Trajectory.minimum_jerk(points[[0, 3]], [3.7], start_time=5.0, velocity=(0.5, 0))
    through = one_piece.position(knots[1:-1])  # through its own points the least curve stays what it is
    same = spf.Trajectory.minimum_jerk([points[0], *through, points[3]], durations, start_time=5.0, velocity=(0.5, 0))
    assert cost(same) == pytest.approx(cost(one_piece), rel=1e-3) and cost(curve) > cost(one_piece)


def test_drives_invert_each_other():
    for kind, inputs in (("omni", 3), ("mecanum", 4), ("differential", 2)):
        drive = spf.Drive(spf.RobotParameters(drive=kind))
        assert drive.inputs == inputs
        twist = np.array([0.2, 0.1 if drive.holonomic else 0.0, 0.3])
        np.testing.assert_allclose(drive.twist_body(drive.input_for(twist)), twist, atol=1e-12)
        assert (np.abs(drive.saturated(np.full(inputs, 99.0))) <= drive.upper).all()


@pytest.fixture(scope="module")
def walled():
    ground = spf.OccupancyMap((-6, -6), (6, 6))
    ground.add_border((-6, -6), (6, 6))
    ground.add_box((-1, -4), (1, 4))
    ground.add_disc((4, 4), 0.5)
    ground.add_polygon([(-5, 3), (-4, 3), (-4.5, 4)])
    return ground


def test_the_map_tells_distances(walled):
    assert walled.distance((3, 0)) == pytest.approx(2.0) and walled.distance((0, 0)) < 0
    assert walled.distance((4, 3)) == pytest.approx(0.5, abs=1e-3)
    np.testing.assert_allclose(walled.distance_gradient((2, 0)), [1, 0], atol=1e-6)
    nodes = walled.node_distances()
    x, y = walled.origin
    column, row = round((2 - x) / walled.resolution), round((0 - y) / walled.resolution)
    assert nodes[row, column] == pytest.approx(1.0, abs=1e-5) and len(walled.occupied) == 0


def test_the_cost_to_go_leads_around(walled):
    guide = spf.CostToGo(walled, goal=(3, 0), robot=(-3, 0))
    assert guide.outcome == "reachable" and guide.reachable((-3, 0))
    cost = guide.cost_to_go((-3, 0))
    straight = 2 * math.hypot(2, 4) + 2  # by the corners of the box
    assert straight < cost < 1.2 * straight
    path = guide.shortest_path((-3, 0))
    np.testing.assert_allclose(path[[0, -1]], [(-3, 0), (3, 0)], atol=1e-6)
    assert np.linalg.norm(np.diff(path, axis=0), axis=1).sum() == pytest.approx(cost, rel=1e-4)
    assert abs(guide.direction((-3, 0))[1]) > 0.5
    np.testing.assert_allclose(guide.descend((-3, 0), 99.0), (3, 0), atol=1e-6)
    closed = spf.OccupancyMap((-2, -2), (2, 2))
    closed.add_box((-2, -2), (2, 2))
    none = spf.CostToGo(closed, goal=(0, 0), robot=(0, 0))
    assert none.outcome == "no free goal"
    with pytest.raises(ValueError, match="no position near it is free"):
        none.cost_to_go((0, 0))


def test_the_controller_follows_a_line():
    line = spf.Trajectory()
    line.append(spf.constant_acceleration((0, 0), (0.5, 0), (0.5, 0), 4.0), 4.0)
    mpc = spf.ModelPredictiveController(spf.MpcParameters(horizon=8))
    answer = mpc.solve(line, time=1.0, pose=(0.5, 0.1, 0.0))
    assert answer["wheel_speeds"].shape == (8, 3) and answer["pose"].shape == (9, 3)
    np.testing.assert_allclose(answer["reference_pose"][:, 0], 0.5 + 0.05 * np.arange(9))
    assert abs(answer["pose"][-1, 1]) < 0.05 and answer["status"] in ("converged", "iteration limit")
    drive = spf.Drive()
    assert drive.twist_body(answer["wheel_speeds"][0])[1] < 0  # back to the line
    assert mpc.parameters.horizon == 8


def test_the_tracker_closes_the_loop():
    line = spf.Trajectory()
    line.append(spf.constant_acceleration((0, 0), (0.4, 0), (0.4, 0), 3.0), 3.0)
    line.append(spf.constant_acceleration((1.2, 0), (0.4, 0), (0, 0), 1.0), 1.0)
    robot = spf.RobotParameters(motor_lag=0.0)
    drive, tracker, pose = spf.Drive(robot), spf.Tracker(robot=robot), np.array([0.0, 0.1, 0.0])
    assert tracker.estimate is None and tracker.step(0.0, line)["status"] == "no estimate"
    for tick in range(100):
        tracker.add_pose(0.05 * tick, pose)
        command = tracker.step(0.05 * tick, line)
        x, y, yaw_rate = drive.twist_body(command["wheel_speeds"])
        heading = pose[2]
        pose = pose + 0.05 * np.array([x * math.cos(heading) - y * math.sin(heading),
                                       x * math.sin(heading) + y * math.cos(heading), yaw_rate])
    assert command["status"] == "tracking"
    np.testing.assert_allclose(pose, [1.4, 0, 0], atol=0.02)
    np.testing.assert_allclose(tracker.estimate["pose"], pose, atol=0.05)


@pytest.mark.parametrize("method", ["space_time", "spf_empc", "orca"])
def test_planners_get_around_what_stands_and_moves(walled, method):
    planner = spf.Planner(method)
    position, velocity, time = np.array([-3.0, 0.0]), np.zeros(2), 0.0
    nearest = math.inf
    for _ in range(300):
        person = np.array([3.0, 4.5 - 0.3 * time])
        track = spf.ObstacleTrack(person, (0, -0.3), radius=0.3, id=7, time=time)
        result = planner.plan(walled, position, (3, 0), velocity=velocity, time=time, tracks=[track])
        np.testing.assert_allclose(result.trajectory.position(time), position, atol=1e-6)
        time += 0.1
        position, velocity = result.trajectory.position(time), result.trajectory.velocity(time)
        nearest = min(nearest, np.linalg.norm(position - person))
        assert walled.distance(position) > 0.25
        if np.linalg.norm(position - (3, 0)) < 0.1:
            break
    assert np.linalg.norm(position - (3, 0)) < 0.1
    assert nearest > 0.6 and 0.0 <= result.risk <= 1.0


def test_candidates_and_refusals_of_a_planner(walled):
    planner = spf.Planner()
    result = planner.plan(walled, (-3, 0), (3, 0), keep_candidates=True)
    assert result.succeeded and result.outcome == "success" and result.action == "follow"
    assert sum(candidate.chosen for candidate in result.candidates) == 1
    assert result.stats["evaluations"] >= 0 and result.blocking_track == -1
    blocked = spf.OccupancyMap((-6, -6), (6, 6))
    blocked.add_box((-6, -6), (6, 6))
    assert spf.Planner().plan(blocked, (-3, 0), (3, 0)).outcome == "no path"
    planner.reset()
    assert planner.parameters.robot.radius == 0.3


EMPTY = spf.Trajectory()


@pytest.mark.parametrize("call, words", [
    (lambda: spf.ProbabilityField((0, 0, 0), (0, 0), 1), "position = (0, 0, 0) must be 2 numbers"),
    (lambda: spf.ProbabilityField((0, math.nan), (0, 0), 1), "position = (0, nan) must be 2 numbers"),
    (lambda: spf.ProbabilityField("ab", (0, 0), 1), "position = 'ab' must be 2 numbers"),
    (lambda: spf.ProbabilityField((0, 0), (0, 0), 0), "radius = 0 must be greater than 0"),
    (lambda: spf.ProbabilityField((0, 0), (0, 0), 1).risk([1, 2, 3]), "points = [1, 2, 3] must hold numbers"),
    (lambda: EMPTY.position(0.0), "has no pieces"),
    (lambda: EMPTY.max_speed(), "has no pieces"),
    (lambda: spf.Trajectory().append(np.zeros((5, 2)), 1), "coefficients = "),
    (lambda: spf.Trajectory().append(np.full((6, 2), math.inf), 1), "coefficients = "),
    (lambda: spf.Trajectory().append(np.zeros((6, 2)), 0), "duration = 0 must be greater than 0"),
    (lambda: spf.Trajectory().append(np.zeros((6, 2)), 1, heading_from=(0, 0)), "must both be given"),
    (lambda: spf.Trajectory.minimum_jerk([(0, 0)], []), "points = [(0, 0)] must be 2 to 33 points"),
    (lambda: spf.Trajectory.minimum_jerk([(0, 0), (1, 0)], [0]), "durations = [0] must be greater than 0"),
    (lambda: spf.Trajectory.minimum_jerk([(0, 0), (1, 0)], [1, 2]), "durations = [1, 2] must be 1 numbers"),
    (lambda: spf.Drive().twist_body([1, 2]), "input = [1, 2] must be 3 numbers"),
    (lambda: spf.OccupancyMap((0, 0), (1, 1), resolution=-1), "resolution = -1 must be greater than 0"),
    (lambda: spf.OccupancyMap((0, 0), (1e8, 1e8)), "2^26"),
    (lambda: spf.OccupancyMap((0, 0), (1, 1)).add_polygon([(0, 0), (1, 1)]), "corners"),
    (lambda: spf.Tracker().add_pose(0.0, (1, 2)), "pose = (1, 2) must be 3 numbers"),
    (lambda: spf.ModelPredictiveController().solve(EMPTY, 0.0, (0, 0, 0)), "has no pieces"),
    (lambda: spf.Planner("space_tme"), "space_tme"),
    (lambda: spf.Planner().plan(spf.OccupancyMap((0, 0), (1, 1)), (0, 0), (1, math.nan)), "goal = (1, nan) must"),
    (lambda: spf.ObstacleTrack((0, 0), radius=-1), "radius = -1 must be greater than 0"),
])
def test_bad_arguments_are_refused_by_name(call, words):
    with pytest.raises(ValueError) as refused:
        call()
    assert words in str(refused.value)


def test_a_trajectory_has_a_largest_number_of_pieces():
    trajectory = spf.Trajectory()
    for _ in range(32):
        trajectory.append(np.zeros((6, 2)), 1.0)
    with pytest.raises(ValueError, match="at most 32 pieces"):
        trajectory.append(np.zeros((6, 2)), 1.0)
