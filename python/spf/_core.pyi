"""The types of the compiled half; made by script/python_stubs.py."""
import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

class InputError(ValueError): ...

class ParameterRow:
    """What there is to know of one key of a scenario file."""
    @property
    def key(self) -> str:
        """Path of the key, as "sensing.range"."""
    @property
    def value(self) -> str:
        """Its value, as files write it."""
    @property
    def unit(self) -> str:
        """"m"; "1" of pure numbers, empty of choices and text."""
    @property
    def range(self) -> str:
        """Its limits, or the names to choose from."""
    @property
    def what(self) -> str:
        """What it means."""
    @property
    def follows(self) -> str:
        """The property of the robot that the default follows, or empty."""
def all_parameters() -> list[ParameterRow]:
    """Every key that a scenario file may have, with the defaults of family t2 and the default method."""
class RobotParameters:
    """Size, limits and drive of a robot."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def drive(self) -> str:
        """omni wheels (the paper's), mecanum wheels, a differential drive, or a car; omni, mecanum, differential, car"""
    @drive.setter
    def drive(self, value: str) -> None: ...
    @property
    def radius(self) -> float:
        """radius of the robot's disc; with corners it is that of the disc around them, whatever is set [m], [0.01, 5]"""
    @radius.setter
    def radius(self, value: float) -> None: ...
    @property
    def length(self) -> float:
        """of a rectangular robot, along x, with its centre in the middle; 0: it is a disc, or has a footprint [m], [0, 10]"""
    @length.setter
    def length(self, value: float) -> None: ...
    @property
    def width(self) -> float:
        """of a rectangular robot, along y [m], [0, 10]"""
    @width.setter
    def width(self, value: float) -> None: ...
    @property
    def footprint(self) -> list:
        """corners of the robot's outline, a convex polygon around its centre, in the body frame; points [m], list of [-5, 5]"""
    @footprint.setter
    def footprint(self, value: list) -> None: ...
    @property
    def max_speed(self) -> float:
        """largest planned speed of the centre [m/s], [0.01, 20]"""
    @max_speed.setter
    def max_speed(self, value: float) -> None: ...
    @property
    def max_acceleration(self) -> float:
        """largest planned acceleration [m/s^2], [0.01, 50]"""
    @max_acceleration.setter
    def max_acceleration(self, value: float) -> None: ...
    @property
    def max_jerk(self) -> float:
        """largest planned jerk (a soft limit) [m/s^3], [0.1, 1000]"""
    @max_jerk.setter
    def max_jerk(self, value: float) -> None: ...
    @property
    def max_yaw_rate(self) -> float:
        """largest planned yaw rate [rad/s], [0.001, 50]"""
    @max_yaw_rate.setter
    def max_yaw_rate(self, value: float) -> None: ...
    @property
    def max_yaw_acceleration(self) -> float:
        """largest planned yaw acceleration [rad/s^2], [0.01, 500]"""
    @max_yaw_acceleration.setter
    def max_yaw_acceleration(self, value: float) -> None: ...
    @property
    def wheels(self) -> int:
        """omni wheels, evenly around the body (3 in the paper) [1], [3, 6]"""
    @wheels.setter
    def wheels(self, value: int) -> None: ...
    @property
    def first_wheel_angle(self) -> float:
        """angle of wheel 1's axle in the body frame (0 in the paper) [rad], [-6.3, 6.3]"""
    @first_wheel_angle.setter
    def first_wheel_angle(self, value: float) -> None: ...
    @property
    def wheel_arm(self) -> float:
        """distance from the centre to a wheel, L of eq. 14; half the track of a differential drive; mecanum: half of length plus width between the wheels [m], [0.001, 5]"""
    @wheel_arm.setter
    def wheel_arm(self, value: float) -> None: ...
    @property
    def wheel_base(self) -> float:
        """car: distance of its axles [m], [0.01, 20]"""
    @wheel_base.setter
    def wheel_base(self, value: float) -> None: ...
    @property
    def min_turning_radius(self) -> float:
        """car: of the middle of its rear axle [m], [0.01, 50]"""
    @min_turning_radius.setter
    def min_turning_radius(self, value: float) -> None: ...
    @property
    def may_reverse(self) -> bool:
        """car: it may drive backwards; true, false"""
    @may_reverse.setter
    def may_reverse(self, value: bool) -> None: ...
    @property
    def max_steering_rate(self) -> float:
        """car: of its steering angle [rad/s], [0.01, 50]"""
    @max_steering_rate.setter
    def max_steering_rate(self, value: float) -> None: ...
    @property
    def max_wheel_speed(self) -> float:
        """largest rim speed of a wheel [m/s], [0.01, 50]"""
    @max_wheel_speed.setter
    def max_wheel_speed(self, value: float) -> None: ...
    @property
    def wheel_radius(self) -> float:
        """wheel radius, R of eq. 15 [m], [0.001, 1]"""
    @wheel_radius.setter
    def wheel_radius(self, value: float) -> None: ...
    @property
    def max_wheel_torque(self) -> float:
        """largest torque of one wheel [N m], [1e-04, 1000]"""
    @max_wheel_torque.setter
    def max_wheel_torque(self, value: float) -> None: ...
    @property
    def mass(self) -> float:
        """mass, M of eq. 15 [kg], [0.01, 10000]"""
    @mass.setter
    def mass(self, value: float) -> None: ...
    @property
    def inertia(self) -> float:
        """moment of inertia about the vertical, I of eq. 15 [kg m^2], [1e-06, 10000]"""
    @inertia.setter
    def inertia(self, value: float) -> None: ...
    @property
    def friction(self) -> float:
        """of the ground under the wheels [1], [0.01, 1000]"""
    @friction.setter
    def friction(self, value: float) -> None: ...
    @property
    def motor_lag(self) -> float:
        """first-order time constant of the wheel speed loop [s], [0, 2]"""
    @motor_lag.setter
    def motor_lag(self, value: float) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> RobotParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> RobotParameters: ...
class FieldParameters:
    """How a moving obstacle is spread into a field (eq. 1-4)."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def attention(self) -> float:
        """weight of the present position, lambda of eq. 2 [1], [0, 1]"""
    @attention.setter
    def attention(self, value: float) -> None: ...
    @property
    def shift_interval(self) -> float:
        """look-ahead of the centre, dt of eq. 2 [s], [0, 10]"""
    @shift_interval.setter
    def shift_interval(self, value: float) -> None: ...
    @property
    def stretch_time(self) -> float:
        """travel folded into the long axis, t below eq. 3 [s], [0, 10]"""
    @stretch_time.setter
    def stretch_time(self, value: float) -> None: ...
    @property
    def threshold_scale(self) -> float:
        """danger threshold, times the smallest ellipse that holds the obstacle now and after stretch_time [1], [0.5, 5]"""
    @threshold_scale.setter
    def threshold_scale(self, value: float) -> None: ...
    @property
    def directional(self) -> bool:
        """false makes the field round (ablation without the field); true, false"""
    @directional.setter
    def directional(self, value: bool) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> FieldParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> FieldParameters: ...
class CostWeights:
    """Weights of the paper's cost (eq. 9)."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def smoothness(self) -> float:
        """weight of the squared jerk relative to the robot's own [1/s], [0, 1e+09]"""
    @smoothness.setter
    def smoothness(self, value: float) -> None: ...
    @property
    def time(self) -> float:
        """weight of the travel time [1/s], [0, 1e+09]"""
    @time.setter
    def time(self, value: float) -> None: ...
    @property
    def limits(self) -> float:
        """weight of exceeded velocity, acceleration and jerk limits [1/s], [0, 1e+09]"""
    @limits.setter
    def limits(self, value: float) -> None: ...
    @property
    def peers(self) -> float:
        """weight of peers (and of obstacles that are predicted as discs), at contact [1/s], [0, 1e+09]"""
    @peers.setter
    def peers(self, value: float) -> None: ...
    @property
    def static_hard(self) -> float:
        """weight of static obstacles within hard_clearance, at contact [1/s], [0, 1e+09]"""
    @static_hard.setter
    def static_hard(self, value: float) -> None: ...
    @property
    def static_soft(self) -> float:
        """weight of static obstacles within soft_clearance, at contact [1/s], [0, 1e+09]"""
    @static_soft.setter
    def static_soft(self, value: float) -> None: ...
    @property
    def spacing(self) -> float:
        """weight of long and uneven gaps between nodes [1], [0, 1e+09]"""
    @spacing.setter
    def spacing(self, value: float) -> None: ...
    @property
    def dynamic(self) -> float:
        """weight of uncertain moving obstacles, omega_dyn of eq. 9 [1], [0, 1e+09]"""
    @dynamic.setter
    def dynamic(self, value: float) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> CostWeights: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> CostWeights: ...
class PlannerParameters:
    """The paper's planner, and margins of all."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def dynamic_model(self) -> str:
        """what is assumed about moving obstacles; none, frozen, constant_velocity, probability_field"""
    @dynamic_model.setter
    def dynamic_model(self, value: str) -> None: ...
    @property
    def horizon(self) -> float:
        """distance to the local target (ES2: 7.5) [m], [0.05, 100]"""
    @horizon.setter
    def horizon(self, value: float) -> None: ...
    @property
    def static_margin(self) -> float:
        """beyond the radius, for search and checks of static obstacles [m], [0, 100]"""
    @static_margin.setter
    def static_margin(self, value: float) -> None: ...
    @property
    def hard_clearance(self) -> float:
        """wanted beyond static_margin (ES2: 0.1) [m], [0.001, 100]"""
    @hard_clearance.setter
    def hard_clearance(self, value: float) -> None: ...
    @property
    def soft_clearance(self) -> float:
        """comfortable beyond static_margin (ES2: 0.5) [m], [0.001, 100]"""
    @soft_clearance.setter
    def soft_clearance(self, value: float) -> None: ...
    @property
    def peer_margin(self) -> float:
        """beyond contact with peers, for checks [m], [0, 100]"""
    @peer_margin.setter
    def peer_margin(self, value: float) -> None: ...
    @property
    def peer_clearance(self) -> float:
        """wanted beyond contact with them (and with obstacles that are predicted as discs) [m], [0.001, 100]"""
    @peer_clearance.setter
    def peer_clearance(self, value: float) -> None: ...
    @property
    def safety_distance(self) -> float:
        """d_saf of eq. 10 [m], [0.001, 100]"""
    @safety_distance.setter
    def safety_distance(self, value: float) -> None: ...
    @property
    def least_lateral_share(self) -> float:
        """sine of the least angle between an escape direction and the path through the field; 0 = eq. 11 as printed [1], [0, 1]"""
    @least_lateral_share.setter
    def least_lateral_share(self, value: float) -> None: ...
    @property
    def max_evaluations(self) -> int:
        """cost evaluations of one plan: its deadline [1], [5, 1e+06]"""
    @max_evaluations.setter
    def max_evaluations(self, value: int) -> None: ...
    @property
    def weights(self) -> CostWeights:
        """a group: CostWeights; of a dict it takes the fields that it names"""
    @weights.setter
    def weights(self, value: CostWeights) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> PlannerParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> PlannerParameters: ...
class CostToGoParameters:
    """The cost-to-go around static shapes."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def clearance(self) -> float:
        """distance to static surfaces that the global path keeps beyond the robot's radius; space_time takes narrower passages, at a price [m], [0, 20]"""
    @clearance.setter
    def clearance(self, value: float) -> None: ...
    @property
    def resolution(self) -> float:
        """spacing of the nodes of the global path's search [m], [0.005, 5]"""
    @resolution.setter
    def resolution(self, value: float) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> CostToGoParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> CostToGoParameters: ...
class SpaceTimeParameters:
    """The space-time planner."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def horizon(self) -> float:
        """time looked ahead by the roll-outs, 30 steps of them at most [s], [0.5, 6]"""
    @horizon.setter
    def horizon(self, value: float) -> None: ...
    @property
    def headings(self) -> int:
        """directions of the sidesteps [1], [4, 64]"""
    @headings.setter
    def headings(self, value: int) -> None: ...
    @property
    def collision_cost(self) -> float:
        """travel time worth one certain contact [s], [0, 1e+06]"""
    @collision_cost.setter
    def collision_cost(self, value: float) -> None: ...
    @property
    def discount_time(self) -> float:
        """a risk this far ahead counts 1/e, since there is time to plan again [s], [0.05, 20]"""
    @discount_time.setter
    def discount_time(self, value: float) -> None: ...
    @property
    def cost_threshold(self) -> float:
        """the direct motion is taken at once when its risk costs less [s], [0, 100]"""
    @cost_threshold.setter
    def cost_threshold(self, value: float) -> None: ...
    @property
    def margin(self) -> float:
        """added to the radii towards moving obstacles [m], [0, 2]"""
    @margin.setter
    def margin(self, value: float) -> None: ...
    @property
    def static_margin(self) -> float:
        """added to the robot's radius towards the static map [m], [0, 2]"""
    @static_margin.setter
    def static_margin(self, value: float) -> None: ...
    @property
    def peer_margin(self) -> float:
        """added to the radii towards peers [m], [0, 2]"""
    @peer_margin.setter
    def peer_margin(self, value: float) -> None: ...
    @property
    def predict_bounces(self) -> bool:
        """predicted obstacles turn at static surfaces of the robot's map; true, false"""
    @predict_bounces.setter
    def predict_bounces(self, value: bool) -> None: ...
    @property
    def smoothing(self) -> bool:
        """the chosen motion is smoothed by the optimiser (MINCO under L-BFGS); true, false"""
    @smoothing.setter
    def smoothing(self, value: bool) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> SpaceTimeParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> SpaceTimeParameters: ...
class OrcaParameters:
    """Optimal reciprocal collision avoidance."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def margin(self) -> float:
        """distance beyond contact, towards everything [m], [0, 5]"""
    @margin.setter
    def margin(self, value: float) -> None: ...
    @property
    def time_horizon(self) -> float:
        """a velocity must be free of contact with what moves for this long, tau of the publication [s], [0.05, 60]"""
    @time_horizon.setter
    def time_horizon(self, value: float) -> None: ...
    @property
    def time_horizon_static(self) -> float:
        """likewise for static surfaces [s], [0.05, 60]"""
    @time_horizon_static.setter
    def time_horizon_static(self, value: float) -> None: ...
    @property
    def neighbour_distance(self) -> float:
        """gap beyond which others do not count [m], [0, 1000]"""
    @neighbour_distance.setter
    def neighbour_distance(self, value: float) -> None: ...
    @property
    def max_neighbours(self) -> int:
        """nearest others that count [1], [0, 1000]"""
    @max_neighbours.setter
    def max_neighbours(self, value: int) -> None: ...
    @property
    def obstacle_share(self) -> float:
        """part of avoiding a moving obstacle that falls to the robot; 1/2 takes it for one that avoids too [1], [0, 1]"""
    @obstacle_share.setter
    def obstacle_share(self, value: float) -> None: ...
    @property
    def limit_acceleration(self) -> bool:
        """approach the chosen velocity at max_acceleration instead of taking it up at once; true, false"""
    @limit_acceleration.setter
    def limit_acceleration(self, value: bool) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> OrcaParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> OrcaParameters: ...
class ObserverParameters:
    """The pose observer (eq. 17)."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def kind(self) -> str:
        """none | eso (eq. 17) | kalman (same model, gains from the noise levels; our default); none, eso, kalman"""
    @kind.setter
    def kind(self, value: str) -> None: ...
    @property
    def bandwidth(self) -> float:
        """eso: w of x and y; l1 = 2 w, l2 = w^2 (paper: 0.5) [rad/s], [0.001, 100]"""
    @bandwidth.setter
    def bandwidth(self, value: float) -> None: ...
    @property
    def heading_bandwidth(self) -> float:
        """eso: w of the heading (paper: 0.5) [rad/s], [0.001, 100]"""
    @heading_bandwidth.setter
    def heading_bandwidth(self, value: float) -> None: ...
    @property
    def pose_sigma(self) -> float:
        """standard deviation of a measured x or y; 0 = exact [m], [0, 100]"""
    @pose_sigma.setter
    def pose_sigma(self, value: float) -> None: ...
    @property
    def heading_sigma(self) -> float:
        """standard deviation of a measured heading; 0 = exact [rad], [0, 3]"""
    @heading_sigma.setter
    def heading_sigma(self, value: float) -> None: ...
    @property
    def velocity_noise(self) -> float:
        """white noise of the velocity (wheel slip); our choice [m/sqrt(s)], [0, 10]"""
    @velocity_noise.setter
    def velocity_noise(self, value: float) -> None: ...
    @property
    def drift_noise(self) -> float:
        """random walk of the disturbance velocity; our choice [m/s/sqrt(s)], [0, 10]"""
    @drift_noise.setter
    def drift_noise(self, value: float) -> None: ...
    @property
    def max_disturbance(self) -> float:
        """bound of the estimated disturbance velocity (and yaw rate in rad/s) [m/s], [0, 100]"""
    @max_disturbance.setter
    def max_disturbance(self, value: float) -> None: ...
    @property
    def settling_time(self) -> float:
        """time constant with which the estimate follows a measured pose that has jumped: a sensor jumps (at the seam of two cameras, say), a robot does not; 0 = at once [s], [0, 60]"""
    @settling_time.setter
    def settling_time(self, value: float) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> ObserverParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> ObserverParameters: ...
class ReferenceParameters:
    """The MPC's reference (eq. 18)."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def self_sampling(self) -> bool:
        """read the reference from the trajectory at every tick (eq. 18); false: hold the plan's discrete points; true, false"""
    @self_sampling.setter
    def self_sampling(self, value: bool) -> None: ...
    @property
    def plan_point_interval(self) -> float:
        """without self-sampling: spacing of the plan's points; our choice [s], [0.01, 10]"""
    @plan_point_interval.setter
    def plan_point_interval(self, value: float) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> ReferenceParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> ReferenceParameters: ...
class MpcParameters:
    """The model predictive controller (eq. 19)."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def horizon(self) -> int:
        """horizon H in steps (paper: 5) [1], [1, 20]"""
    @horizon.setter
    def horizon(self, value: int) -> None: ...
    @property
    def dt(self) -> float:
        """time step of the prediction (paper: 0.1) [s], [0.001, 1]"""
    @dt.setter
    def dt(self, value: float) -> None: ...
    @property
    def position_weight(self) -> float:
        """lambda_p of eq. 19 for x and y; our choice [1/m^2], [1e-06, 1e+06]"""
    @position_weight.setter
    def position_weight(self, value: float) -> None: ...
    @property
    def heading_weight(self) -> float:
        """lambda_p of eq. 19 for the heading; our choice [1/rad^2], [1e-06, 1e+06]"""
    @heading_weight.setter
    def heading_weight(self, value: float) -> None: ...
    @property
    def effort_weight(self) -> float:
        """lambda_u of eq. 19, on wheel speeds minus the reference's; our choice [s^2/m^2], [1e-06, 1e+06]"""
    @effort_weight.setter
    def effort_weight(self, value: float) -> None: ...
    @property
    def rate_weight(self) -> float:
        """weight of the change of wheel speeds between steps; our addition [s^2/m^2], [0, 1e+06]"""
    @rate_weight.setter
    def rate_weight(self, value: float) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> MpcParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> MpcParameters: ...
class TrackerParameters:
    """Observer, reference and MPC."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def control_period(self) -> float:
        """time between control ticks; our choice [s], [0.001, 1]"""
    @control_period.setter
    def control_period(self, value: float) -> None: ...
    @property
    def compensate_lag(self) -> bool:
        """model the first-order lag of the motors in observer and MPC; our addition; true, false"""
    @compensate_lag.setter
    def compensate_lag(self, value: bool) -> None: ...
    @property
    def observer(self) -> ObserverParameters:
        """a group: ObserverParameters; of a dict it takes the fields that it names"""
    @observer.setter
    def observer(self, value: ObserverParameters) -> None: ...
    @property
    def reference(self) -> ReferenceParameters:
        """a group: ReferenceParameters; of a dict it takes the fields that it names"""
    @reference.setter
    def reference(self, value: ReferenceParameters) -> None: ...
    @property
    def mpc(self) -> MpcParameters:
        """a group: MpcParameters; of a dict it takes the fields that it names"""
    @mpc.setter
    def mpc(self, value: MpcParameters) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> TrackerParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> TrackerParameters: ...
class TeamParameters:
    """When a robot plans, and what it tells its peers."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def plan_period(self) -> float:
        """time between planning checks [s], [0.01, 2]"""
    @plan_period.setter
    def plan_period(self, value: float) -> None: ...
    @property
    def message_period(self) -> float:
        """the committed plan is broadcast again at least this often [s], [0.01, 10]"""
    @message_period.setter
    def message_period(self, value: float) -> None: ...
    @property
    def message_lifetime(self) -> float:
        """time after which peers no longer rely on a broadcast [s], [0.1, 60]"""
    @message_lifetime.setter
    def message_lifetime(self, value: float) -> None: ...
    @property
    def stale_time(self) -> float:
        """time without pose or observation until the robot brakes [s], [0.02, 10]"""
    @stale_time.setter
    def stale_time(self, value: float) -> None: ...
    @property
    def goal_tolerance(self) -> float:
        """distance within which the robot counts itself arrived [m], [0.001, 1]"""
    @goal_tolerance.setter
    def goal_tolerance(self, value: float) -> None: ...
    @property
    def reanchor_distance(self) -> float:
        """distance from the plan beyond which it starts anew at the robot [m], [0.02, 10]"""
    @reanchor_distance.setter
    def reanchor_distance(self, value: float) -> None: ...
    @property
    def priority(self) -> int:
        """the smaller goes first; among equals the robot with the smaller number [1], [0, 1e+06]"""
    @priority.setter
    def priority(self, value: int) -> None: ...
    @property
    def replan_period(self) -> float:
        """a plan of the paper's planner is renewed at least this often [s], [0.05, 10]"""
    @replan_period.setter
    def replan_period(self, value: float) -> None: ...
    @property
    def emergency_time(self) -> float:
        """a predicted contact sooner than this makes the robot brake when it finds no plan [s], [0, 10]"""
    @emergency_time.setter
    def emergency_time(self, value: float) -> None: ...
    @property
    def retreat(self) -> bool:
        """step aside when no plan is found and something would run into the stopped robot; true, false"""
    @retreat.setter
    def retreat(self, value: bool) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> TeamParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> TeamParameters: ...
class SightParameters:
    """What a robot cannot see."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def range(self) -> float:
        """distance up to which whatever moves is seen; what scans show bounds it further [m], [0.1, 1000]"""
    @range.setter
    def range(self, value: float) -> None: ...
    @property
    def unseen_speed(self) -> float:
        """speed of what may come from beyond: the robot can give way before it is there (0 = nothing comes) [m/s], [0, 20]"""
    @unseen_speed.setter
    def unseen_speed(self, value: float) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> SightParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> SightParameters: ...
class PerceptionParameters:
    """Moving obstacles in range scans."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def enabled(self) -> bool:
        """moving objects are found in the robot's own scans; true, false"""
    @enabled.setter
    def enabled(self, value: bool) -> None: ...
    @property
    def range_sigma(self) -> float:
        """noise of one beam of the range sensor [m], [1e-04, 1]"""
    @range_sigma.setter
    def range_sigma(self, value: float) -> None: ...
    @property
    def pose_sigma(self) -> float:
        """error of the sensor's pose, per axis [m], [0, 1]"""
    @pose_sigma.setter
    def pose_sigma(self, value: float) -> None: ...
    @property
    def leg_width(self) -> float:
        """widest leg of a person (0 = none) [m], [0, 1]"""
    @leg_width.setter
    def leg_width(self, value: float) -> None: ...
    @property
    def probation(self) -> float:
        """time that something compact has to show that it moves, before it goes into a sensed map [s], [0, 60]"""
    @probation.setter
    def probation(self, value: float) -> None: ...
    @property
    def coast_time(self) -> float:
        """longest time that a track is out of sight [s], [0, 60]"""
    @coast_time.setter
    def coast_time(self, value: float) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> PerceptionParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> PerceptionParameters: ...
class DiffusionParameters:
    """How fast tracks become uncertain."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def prior_velocity_diffusion(self) -> float:
        """growth of an obstacle's velocity variance before anything is learnt (1 Sigma, walk) [m^2/s^3], [1e-08, 100]"""
    @prior_velocity_diffusion.setter
    def prior_velocity_diffusion(self, value: float) -> None: ...
    @property
    def prior_position_diffusion(self) -> float:
        """growth of an obstacle's position variance before anything is learnt (1 Sigma, white) [m^2/s], [1e-09, 10]"""
    @prior_position_diffusion.setter
    def prior_position_diffusion(self, value: float) -> None: ...
    @property
    def lowest_factor(self) -> float:
        """lower bound of a learnt diffusion, in priors [1], [1e-06, 1]"""
    @lowest_factor.setter
    def lowest_factor(self, value: float) -> None: ...
    @property
    def highest_factor(self) -> float:
        """upper bound of a learnt diffusion, in priors [1], [1, 1e+06]"""
    @highest_factor.setter
    def highest_factor(self, value: float) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> DiffusionParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> DiffusionParameters: ...
class ObstacleTrackerParameters:
    """Tracks of moving obstacles."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def timeout(self) -> float:
        """a track that is unseen for longer is dropped [s], [0.05, 60]"""
    @timeout.setter
    def timeout(self, value: float) -> None: ...
    @property
    def diffusion(self) -> DiffusionParameters:
        """a group: DiffusionParameters; of a dict it takes the fields that it names"""
    @diffusion.setter
    def diffusion(self, value: DiffusionParameters) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> ObstacleTrackerParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> ObstacleTrackerParameters: ...
class PeerTableParameters:
    """Belief about teammates."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def silence(self) -> float:
        """without a message for this long a peer expires [s], [0.05, 60]"""
    @silence.setter
    def silence(self, value: float) -> None: ...
    @property
    def growth_rate(self) -> float:
        """growth of the radius of an expired peer [m/s], [0, 20]"""
    @growth_rate.setter
    def growth_rate(self, value: float) -> None: ...
    @property
    def forget_time(self) -> float:
        """an expired peer is forgotten after this [s], [0, 3600]"""
    @forget_time.setter
    def forget_time(self, value: float) -> None: ...
    @property
    def clock_tolerance(self) -> float:
        """largest difference of the robots' clocks [s], [0, 60]"""
    @clock_tolerance.setter
    def clock_tolerance(self, value: float) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> PeerTableParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> PeerTableParameters: ...
class AgentParameters:
    """Everything that can be set about one robot."""
    def __init__(self, **values: Any) -> None:
        """The defaults, but for the fields that are named."""
    @property
    def heading_mode(self) -> str:
        """where the body's x axis points while the robot moves; look, keep, goal, motion"""
    @heading_mode.setter
    def heading_mode(self, value: str) -> None: ...
    @property
    def robot(self) -> RobotParameters:
        """a group: RobotParameters; of a dict it takes the fields that it names"""
    @robot.setter
    def robot(self, value: RobotParameters) -> None: ...
    @property
    def team(self) -> TeamParameters:
        """a group: TeamParameters; of a dict it takes the fields that it names"""
    @team.setter
    def team(self, value: TeamParameters) -> None: ...
    @property
    def field(self) -> FieldParameters:
        """a group: FieldParameters; of a dict it takes the fields that it names"""
    @field.setter
    def field(self, value: FieldParameters) -> None: ...
    @property
    def planner(self) -> PlannerParameters:
        """a group: PlannerParameters; of a dict it takes the fields that it names"""
    @planner.setter
    def planner(self, value: PlannerParameters) -> None: ...
    @property
    def guide(self) -> CostToGoParameters:
        """a group: CostToGoParameters; of a dict it takes the fields that it names"""
    @guide.setter
    def guide(self, value: CostToGoParameters) -> None: ...
    @property
    def space_time(self) -> SpaceTimeParameters:
        """a group: SpaceTimeParameters; of a dict it takes the fields that it names"""
    @space_time.setter
    def space_time(self, value: SpaceTimeParameters) -> None: ...
    @property
    def orca(self) -> OrcaParameters:
        """a group: OrcaParameters; of a dict it takes the fields that it names"""
    @orca.setter
    def orca(self, value: OrcaParameters) -> None: ...
    @property
    def tracker(self) -> TrackerParameters:
        """a group: TrackerParameters; of a dict it takes the fields that it names"""
    @tracker.setter
    def tracker(self, value: TrackerParameters) -> None: ...
    @property
    def sight(self) -> SightParameters:
        """a group: SightParameters; of a dict it takes the fields that it names"""
    @sight.setter
    def sight(self, value: SightParameters) -> None: ...
    @property
    def perception(self) -> PerceptionParameters:
        """a group: PerceptionParameters; of a dict it takes the fields that it names"""
    @perception.setter
    def perception(self, value: PerceptionParameters) -> None: ...
    @property
    def obstacles(self) -> ObstacleTrackerParameters:
        """a group: ObstacleTrackerParameters; of a dict it takes the fields that it names"""
    @obstacles.setter
    def obstacles(self, value: ObstacleTrackerParameters) -> None: ...
    @property
    def peers(self) -> PeerTableParameters:
        """a group: PeerTableParameters; of a dict it takes the fields that it names"""
    @peers.setter
    def peers(self, value: PeerTableParameters) -> None: ...
    def __setattr__(self, field: str, value: Any) -> None: ...
    def to_dict(self) -> dict[str, Any]:
        """Every field with its value, groups as dicts."""
    def rows(self) -> list[ParameterRow]:
        """Every field with value, unit, limits and meaning."""
    def __eq__(self, other: object) -> bool: ...
    def __copy__(self) -> AgentParameters: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> AgentParameters: ...
def defaults_for(robot: RobotParameters) -> AgentParameters:
    """The defaults for a robot: what follows its size, speed or acceleration is scaled."""
class Drive:
    """What the wheels of a robot can do. Immutable."""
    def __init__(self, robot: RobotParameters = ...) -> None: ...
    @property
    def inputs(self) -> int:
        """How many numbers command it."""
    @property
    def holonomic(self) -> bool:
        """It may move along and turn at once, every way."""
    @property
    def lower(self) -> NDArray[np.float64]:
        """Least inputs."""
    @property
    def upper(self) -> NDArray[np.float64]:
        """Largest inputs."""
    def twist_body(self, input: ArrayLike) -> NDArray[np.float64]:
        """The motion of the body (3,) [m/s, m/s, rad/s] that inputs cause: rim speeds [m/s] of the wheels, of
        a car the rim speed and the steering angle [rad]."""
    def input_for(self, twist_body: ArrayLike, steering_angle: float = 0.0) -> NDArray[np.float64]:
        """Inputs for a motion of the body, perhaps beyond the limits; what it cannot do is left out."""
    def saturated(self, input: ArrayLike) -> NDArray[np.float64]:
        """Inputs within the limits, scaled so that the path is kept."""
class Trajectory:
    """A planned motion: quintic pieces over absolute time, at rest before and after."""
    def __init__(self, start_time: float = 0.0) -> None:
        """One without pieces, which begins at a time [s]."""
    @staticmethod
    def standing(position: ArrayLike, start_time: float = 0.0, duration: float = 1.0) -> Trajectory:
        """Rests at a position."""
    @staticmethod
    def minimum_jerk(points: ArrayLike, durations: ArrayLike, start_time: float = 0.0, velocity: ArrayLike = ..., end_velocity: ArrayLike = ...) -> Trajectory:
        """Of all curves through points (n + 1, 2) [m] with these durations (n,) [s] between them the one
        with the least integral of the squared jerk (eq. 5-6)."""
    def append(self, coefficients: ArrayLike, duration: float, *, heading_from: ArrayLike | None = None, heading_to: ArrayLike | None = None) -> None:
        """Adds a piece: coefficients (6, 2) of p(t) = sum_k c_k t^k [m] in its own time, duration [s] > 0.
        Of a robot that cannot move sideways with (heading [rad], yaw rate [rad/s]) at either end."""
    def position(self, time: ArrayLike) -> NDArray[np.float64]:
        """(..., 2) [m] at absolute times [s]."""
    def velocity(self, time: ArrayLike) -> NDArray[np.float64]:
        """(..., 2) [m/s]"""
    def acceleration(self, time: ArrayLike) -> NDArray[np.float64]:
        """(..., 2) [m/s^2]"""
    def heading(self, time: ArrayLike) -> NDArray[np.float64]:
        """(..., 2): heading [rad] and yaw rate [rad/s]."""
    @property
    def coefficients(self) -> NDArray[np.float64]:
        """(pieces, 6, 2)"""
    @property
    def durations(self) -> NDArray[np.float64]:
        """(pieces,) [s]"""
    @property
    def start_time(self) -> float:
        """[s]"""
    @property
    def duration(self) -> float:
        """[s]"""
    @property
    def end_time(self) -> float:
        """[s]"""
    @property
    def steered(self) -> bool:
        """Its pieces have a heading of their own."""
    def max_speed(self) -> float:
        """Largest speed [m/s], by the roots of polynomials."""
    def max_acceleration(self) -> float:
        """Largest acceleration [m/s^2], likewise."""
    def length(self) -> float:
        """Length of the path [m]."""
    def __len__(self) -> int: ...
def constant_acceleration(position: ArrayLike, velocity: ArrayLike, end_velocity: ArrayLike, duration: float) -> NDArray[np.float64]:
    """Coefficients (6, 2) of a piece that goes from one velocity [m/s] to another in a duration [s]."""
class ProbabilityField:
    """The safety probability field of one moving obstacle (eq. 1-4): an elliptic
    Gaussian ahead of it, for the centre of a disc-shaped robot. Immutable."""
    def __init__(self, position: ArrayLike, velocity: ArrayLike, radius: float, robot_radius: float = 0.3, parameters: FieldParameters = ...) -> None:
        """Of an obstacle at a position [m] with a velocity [m/s] and a radius [m]."""
    def density(self, points: ArrayLike) -> float | NDArray[np.float64]:
        """Density U of eq. 1 [1/m^2] at points (..., 2)."""
    def density_gradient(self, points: ArrayLike) -> NDArray[np.float64]:
        """dU/dp of eq. 4 [1/m^3], (..., 2)."""
    def mahalanobis(self, points: ArrayLike) -> float | NDArray[np.float64]:
        """Distance from the centre, 1 on the ellipse with the half axes [1]."""
    def risk(self, points: ArrayLike) -> float | NDArray[np.float64]:
        """Density over its peak, in [0, 1]."""
    def clearance(self, points: ArrayLike, threshold: float) -> float | NDArray[np.float64]:
        """Signed distance [m] from the ellipse `threshold`: negative inside, never too much outside."""
    def escape_direction(self, point: ArrayLike, preferred_side: ArrayLike = ...) -> NDArray[np.float64]:
        """Unit vector along which the density falls fastest (eq. 11)."""
    def guide_point(self, point: ArrayLike, direction: ArrayLike, mahalanobis: float) -> NDArray[np.float64]:
        """Where a ray from a point inside the ellipse leaves it [m]."""
    def ellipse(self, mahalanobis: float) -> dict[str, Any]:
        """A contour as a dict: center (2,) [m], half_axes (2,) [m] along and across, heading [rad]."""
    @property
    def threshold(self) -> float:
        """The default limit of danger [1]."""
    @property
    def center(self) -> NDArray[np.float64]:
        """(2,) [m] eq. 2"""
    @property
    def axis(self) -> NDArray[np.float64]:
        """(2,) unit vector along the velocity"""
    @property
    def half_axes(self) -> NDArray[np.float64]:
        """(2,) [m] a and b of eq. 3"""
class OccupancyMap:
    """What stands: known shapes on a grid, with the distance to the nearest surface."""
    def __init__(self, low: ArrayLike, high: ArrayLike, resolution: float = 0.1, max_distance: float = 2.0) -> None:
        """Free ground from a lower left to an upper right corner [m]. Distances are exact up to
        max_distance [m] and read that beyond."""
    def add_box(self, low: ArrayLike, high: ArrayLike) -> None:
        """A filled box, by two corners [m]."""
    def add_disc(self, center: ArrayLike, radius: float) -> None:
        """A filled disc [m]."""
    def add_border(self, low: ArrayLike, high: ArrayLike) -> None:
        """Outside of these lines counts as inside a wall [m]."""
    def add_polygon(self, corners: ArrayLike) -> None:
        """A filled polygon, (n, 2) [m]."""
    def distance(self, points: ArrayLike) -> float | NDArray[np.float64]:
        """Distance [m] to the nearest surface at points (..., 2), negative inside."""
    def distance_gradient(self, points: ArrayLike) -> NDArray[np.float64]:
        """(..., 2) away from the surface; zero beyond max_distance."""
    def node_distances(self) -> NDArray[np.float32]:
        """(height, width) [m] at the nodes, row by row from the origin."""
    @property
    def origin(self) -> NDArray[np.float64]:
        """(2,) position of node (0, 0) [m]."""
    @property
    def resolution(self) -> float:
        """[m]"""
    @property
    def max_distance(self) -> float:
        """[m]"""
    @property
    def occupied(self) -> NDArray[np.float64]:
        """(n, 2) [m] where sensed cells were hit."""
    def __copy__(self) -> OccupancyMap: ...
class CostToGo:
    """Length of the shortest path around what stands to a goal, from any position."""
    def __init__(self, map: OccupancyMap, goal: ArrayLike, robot: ArrayLike, robot_radius: float = 0.3, parameters: CostToGoParameters = ...) -> None:
        """On a map to a goal [m], far enough for a robot at `robot` [m]."""
    def cost_to_go(self, points: ArrayLike) -> float | NDArray[np.float64]:
        """[m] at points (..., 2)."""
    def direction(self, points: ArrayLike) -> NDArray[np.float64]:
        """(..., 2) unit vectors towards the goal along the path; zero at the goal."""
    def descend(self, point: ArrayLike, distance: float) -> NDArray[np.float64]:
        """The position [m] so far along the path, at most the goal."""
    def shortest_path(self, point: ArrayLike) -> NDArray[np.float64]:
        """(k, 2) corners of the path [m], both ends too."""
    def reachable(self, point: ArrayLike) -> bool:
        """Whether a path leads from there to the goal."""
    @property
    def outcome(self) -> str:
        """reachable, goal moved (to goal_used), unreachable, or no free goal."""
    @property
    def goal_used(self) -> NDArray[np.float64]:
        """The goal [m], or the nearest position that keeps the clearance."""
    @property
    def clearance(self) -> float:
        """Between the robot's centre on a path and what stands [m]."""
class ModelPredictiveController:
    """The extended-state model predictive controller (eq. 18, 19) of a robot."""
    def __init__(self, parameters: MpcParameters = ..., robot: RobotParameters = ...) -> None: ...
    def solve(self, trajectory: Trajectory, time: float, pose: ArrayLike, disturbance: ArrayLike = ..., previous: ArrayLike | None = None) -> dict[str, Any]:
        """Inputs that lead from a pose (3,) along a trajectory from a time [s] on, as a dict: status,
        wheel_speeds (H, inputs), pose (H + 1, 3) as predicted, reference_pose and reference_twist
        (H + 1, 3), cost, optimality_residual, iterations. `disturbance` (3,) [m/s, m/s, rad/s] in world,
        `previous` the inputs before (None: standstill)."""
    def forget(self) -> None:
        """Drops what makes the next solution quicker, not other."""
    @property
    def parameters(self) -> MpcParameters:
        """A copy of its parameters."""
class Tracker:
    """Observer (eq. 17) and controller (eq. 18, 19) of a robot."""
    def __init__(self, parameters: TrackerParameters = ..., robot: RobotParameters = ...) -> None: ...
    def add_pose(self, time: float, pose: ArrayLike) -> None:
        """Takes in a measured pose (3,): x, y [m], heading [rad]."""
    def step(self, time: float, trajectory: Trajectory) -> dict[str, Any]:
        """One control tick, as a dict: status, wheel_speeds (inputs,), twist (3,) that they command,
        reference_pose and reference_twist (3,). They count as applied until the next."""
    @property
    def estimate(self) -> dict[str, Any] | None:
        """Where the robot is, as a dict: pose, disturbance, position_variance,
        heading_variance; None before the first pose."""
    def reset(self) -> None:
        """Forgets the estimate and the last command."""
class ObstacleTrack:
    """Belief about one moving obstacle."""
    def __init__(self, position: ArrayLike, velocity: ArrayLike = ..., radius: float = 0.3, id: int = 0, time: float = 0.0, sigma: float = 0.0) -> None:
        """A disc at a position [m] at a time [s], with a velocity [m/s], a radius [m], and the standard
        deviation of its position per axis [m]."""
    @property
    def id(self) -> int:
        """Its number."""
    @property
    def time(self) -> float:
        """[s] of its state."""
    @property
    def position(self) -> NDArray[np.float64]:
        """(2,) [m]"""
    @property
    def velocity(self) -> NDArray[np.float64]:
        """(2,) [m/s]"""
    @property
    def radius(self) -> float:
        """[m]"""
    def sigma(self, ahead: float = 0.0) -> float:
        """Standard deviation per axis [m] so many seconds after `time`."""
class Peer:
    """Belief about one teammate, from its broadcasts."""
    @property
    def robot_id(self) -> int:
        """Its number."""
    @property
    def priority(self) -> int:
        """The smaller goes first; among equals the smaller number."""
    @property
    def state(self) -> str:
        """moving, braking, stopped or arrived."""
    @property
    def radius(self) -> float:
        """[m]"""
    @property
    def position_sigma(self) -> float:
        """[m] per axis."""
    @property
    def expired(self) -> bool:
        """Silent for too long: a disc where it was last."""
    @property
    def trajectory(self) -> Trajectory:
        """What it has announced."""
    def position(self, time: float) -> NDArray[np.float64]:
        """(2,) [m] at an absolute time [s]."""
    def velocity(self, time: float) -> NDArray[np.float64]:
        """(2,) [m/s] at an absolute time [s]."""
class PlanRequest:
    """What a method plans from, valid during the call of plan() alone. Frame: world, SI."""
    def distance(self, points: ArrayLike) -> float | NDArray[np.float64]:
        """Distance [m] to what stands at points (..., 2)."""
    def distance_gradient(self, points: ArrayLike) -> NDArray[np.float64]:
        """(..., 2) away from what stands."""
    def cost_to_go(self, points: ArrayLike) -> float | NDArray[np.float64]:
        """Length [m] of the shortest path to the goal from points (..., 2)."""
    def direction(self, points: ArrayLike) -> NDArray[np.float64]:
        """(..., 2) unit vectors along that path; zero at the goal."""
    def descend(self, point: ArrayLike, distance: float) -> NDArray[np.float64]:
        """The position [m] so far along that path, at most the goal."""
    def copy_map(self) -> OccupancyMap:
        """The static map, to keep."""
    @property
    def time(self) -> float:
        """[s] when the new trajectory starts."""
    @property
    def position(self) -> NDArray[np.float64]:
        """(2,) [m] at that time."""
    @property
    def velocity(self) -> NDArray[np.float64]:
        """(2,) [m/s] likewise."""
    @property
    def acceleration(self) -> NDArray[np.float64]:
        """(2,) [m/s^2] likewise."""
    @property
    def heading(self) -> float:
        """[rad] likewise."""
    @property
    def yaw_rate(self) -> float:
        """[rad/s] likewise."""
    @property
    def goal(self) -> NDArray[np.float64]:
        """(2,) [m]"""
    @property
    def goal_heading(self) -> float | None:
        """[rad]; None: any."""
    @property
    def position_sigma(self) -> float:
        """[m] standard deviation of the robot's own position, per axis."""
    @property
    def robot_id(self) -> int:
        """Its number."""
    @property
    def tracks(self) -> list[ObstacleTrack]:
        """The moving obstacles, as a list of ObstacleTrack to keep."""
    @property
    def peers(self) -> list[Peer]:
        """The teammates, as a list of Peer to keep."""
    @property
    def committed(self) -> Trajectory | None:
        """The current plan; None after a reset."""
    @property
    def braking(self) -> bool:
        """Whether that is a braking one."""
class Candidate:
    """One trajectory that was considered."""
    @property
    def kind(self) -> str:
        """How it came about."""
    @property
    def cost(self) -> float:
        """In the method's own unit."""
    @property
    def risk(self) -> float:
        """Probability of contact with what moves within 3 s."""
    @property
    def chosen(self) -> bool:
        """It is the result's."""
    @property
    def trajectory(self) -> Trajectory:
        """Its motion."""
class PlanResult:
    """What came of a request."""
    @property
    def outcome(self) -> str:
        """success, goal reached, no path, unsafe, deadline, or invalid request."""
    @property
    def succeeded(self) -> bool:
        """The trajectory has passed the clearance check."""
    @property
    def action(self) -> str:
        """follow, keep or brake."""
    @property
    def trajectory(self) -> Trajectory:
        """Usable, whatever the outcome."""
    @property
    def risk(self) -> float:
        """Probability of contact with what moves within 3 s."""
    @property
    def blocking_track(self) -> int:
        """Number of the obstacle that shapes the plan most, -1: none."""
    @property
    def blocking_peer(self) -> int:
        """Likewise of the peer."""
    @property
    def candidates(self) -> list[Candidate]:
        """Those considered, when asked for."""
    @property
    def stats(self) -> dict[str, Any]:
        """What it cost, as a dict of counts."""
class MethodTable:
    """The built-in methods, and those that you add."""
    def __init__(self) -> None: ...
    def add(self, name: str, what: str, make: Callable[[AgentParameters], Any], change: Callable[[AgentParameters], object] | None = None) -> None:
        """Adds a method: make(parameters) gives an object for each robot, whose plan(request) returns a
        Trajectory that starts at request.time, position and velocity and ends at rest, or None to stop.
        A plan that fails the clearance check is not driven. The object may say passes_narrow_gaps and
        approaches_cut_off_goal (docs/add_a_method.md). change(parameters) may set some of them."""
    @property
    def all(self) -> dict[str, str]:
        """Name and meaning of each, as a dict."""
    def __contains__(self, arg0: str) -> bool: ...
class Planner:
    """A method on its own, without robot and simulator."""
    def __init__(self, method: str = 'space_time', parameters: AgentParameters | None = None, methods: MethodTable = ...) -> None:
        """A method by its name, for a robot with these parameters (None: the defaults)."""
    def plan(self, map: OccupancyMap, position: ArrayLike, goal: ArrayLike, *, velocity: ArrayLike = ..., time: float = 0.0, heading: float = 0.0, tracks: list[ObstacleTrack] = ..., keep_candidates: bool = False) -> PlanResult:
        """Plans from a position [m] and a velocity [m/s] at a time [s] to a goal [m], among what stands on
        the map and what moves (`tracks`). The plan before is taken as the one under way."""
    def reset(self) -> None:
        """Forgets the plan before."""
    @property
    def parameters(self) -> AgentParameters:
        """A copy of its parameters."""
class Scenario:
    """A scenario file with its defaults: what determines every trial. Immutable."""
    @staticmethod
    def load(path: str | os.PathLike[str], settings: dict[str, Any] = ..., methods: MethodTable = ...) -> Scenario:
        """Reads a file and writes `settings` over it, as {"noise.level": 1}. `methods` are those that it
        may name. Raises InputError with every problem: file, line, key, value and limit."""
    @staticmethod
    def from_text(text: str, settings: dict[str, Any] = ..., methods: MethodTable = ...) -> Scenario:
        """The same of the text of a file; paths in it start in the working directory."""
    @staticmethod
    def from_dict(values: dict[str, Any], methods: MethodTable = ...) -> Scenario:
        """The same of keys and values, nested like the file; numpy arrays count as lists. What to_dict()
        gives, read back."""
    def changed(self, settings: dict[str, Any]) -> Scenario:
        """The scenario with these settings, too. Defaults that depend on them follow."""
    def __getitem__(self, key: str) -> Any:
        """The value at a path of keys, as scenario["robot.max_speed"]."""
    def to_dict(self) -> dict[str, Any]:
        """Every key with its value, nested like the file."""
    def to_yaml(self, explains: bool = False) -> str:
        """The text of a file with every key; with `explains` each has a comment."""
    def parameters(self) -> list[ParameterRow]:
        """Every key with value, unit, limits and meaning."""
    @property
    def name(self) -> str:
        """The file, as messages name it."""
    @property
    def family(self) -> str:
        """Family of scenes."""
    @property
    def method(self) -> str:
        """How robots plan and track."""
    @property
    def seed(self) -> int:
        """Seed of everything random."""
    @property
    def warnings(self) -> list[str]:
        """Settings that contradict each other and can be studied all the same, as sentences."""
    @property
    def agent(self) -> AgentParameters:
        """A copy of the parameters of every robot."""
    @property
    def trial_count(self) -> int | None:
        """How many trials there are; None: as many as are asked for."""
    def run(self, trial: int = 0, *, record: bool = False, jobs: int = 1, timed: bool = False) -> Trial:
        """Runs a trial to its end, without Python's lock. The result depends on scenario and number alone, to
        the bit, and not on `jobs`: threads for its robots, 0 for one a processor. With `record` it keeps a
        recording; with `timed` it measures computing times."""
class Recording:
    """A trial in F frames of 0.1 s, with N robots. Frame: world, SI."""
    @property
    def time(self) -> NDArray[np.float64]:
        """(F,) [s]"""
    @property
    def pose(self) -> NDArray[np.float64]:
        """(F, N, 3) true x, y [m], heading [rad]"""
    @property
    def velocity(self) -> NDArray[np.float64]:
        """(F, N, 2) true [m/s]"""
    @property
    def estimate(self) -> NDArray[np.float64]:
        """(F, N, 3) where the robots believe to be"""
    @property
    def wheel_speeds(self) -> NDArray[np.float64]:
        """(F, N, W) true rim speeds [m/s]; of a car rim speed and steering angle [rad]"""
    @property
    def wheel_commands(self) -> NDArray[np.float64]:
        """(F, N, W) the same, as commanded"""
    @property
    def obstacles(self) -> dict[str, Any]:
        """What moves, M in all, as a dict: id (M,), person (M,), radius (M,) [m], position
        (F, M, 2) [m] and velocity (F, M, 2) [m/s], NaN where it is absent."""
    @property
    def plans(self) -> list[dict[str, Any]]:
        """Every planning call as a dict: time [s], robot, stop (why the planner was not asked, or None),
        outcome, risk, points (k, 3) of time [s], x, y [m]."""
    @property
    def events(self) -> list[dict[str, Any]]:
        """What happened, as dicts: time [s], robot, kind, text, other, position [m]."""
class Trial:
    """A finished trial."""
    @staticmethod
    def from_json(line: str) -> Trial:
        """The trial of a line of trials.jsonl. Raises InputError with key, value and limit."""
    def to_json(self) -> str:
        """Its line of trials.jsonl."""
    def to_dict(self) -> dict[str, Any]:
        """The same as a dict."""
    def same_result(self, other: Trial) -> bool:
        """Whether both tell the same of a trial, timings apart."""
    @property
    def number(self) -> int:
        """Number of the trial."""
    @property
    def method(self) -> str:
        """Method, or its variant's name."""
    @property
    def outcome(self) -> str:
        """success, collision or overtime."""
    @property
    def succeeded(self) -> bool:
        """Every robot is at its goal, and touched nothing."""
    @property
    def failure(self) -> str:
        """Why it failed, in words; empty after a success."""
    @property
    def sim_time(self) -> float:
        """Simulated time [s]."""
    @property
    def dynamic_distance(self) -> float:
        """Least distance of a centre to that of a moving obstacle [m]; NaN without any."""
    @property
    def dynamic_clearance(self) -> float:
        """The same minus radii [m]."""
    @property
    def digest(self) -> str:
        """Hash over the bits of all positions: equal for equal motion."""
    @property
    def contact(self) -> dict[str, Any] | None:
        """The first contact as a dict, or None."""
    @property
    def robots(self) -> NDArray[np.void]:
        """Structured array, a row for each robot: arrived, path_length [m], travel_time [s], their ratios to the
        obstacle-free optimum, plans, failed_plans, optimiser_calls, inner_iterations, guard_stops,
        guard_held [s]."""
    def picture(self, time: float | None = None, *, plans: bool = True, trails: bool = True, dark: bool = False) -> str:
        """The recorded scene at a time [s] (None: the end) as the text of an SVG file."""
    def replay(self) -> str:
        """The page that replays the recorded trial in a browser, as the text of an HTML file."""
    @property
    def recording(self) -> Recording:
        """What a replay shows; None unless it was run with record=True."""
class Results:
    """Trials of a campaign, by cell and number, and their tables."""
    def __init__(self, trials: list[Trial]) -> None:
        """Of trials from anywhere, in that order."""
    @staticmethod
    def read(path: str | os.PathLike[str]) -> Results:
        """Those of a file trials.jsonl of the program."""
    @property
    def trials(self) -> list[Trial]:
        """The trials as a list of Trial."""
    @property
    def rows(self) -> list[dict[str, Any]]:
        """A dict for each cell: success rate with its interval, means, medians (docs/protocol.md)."""
    @property
    def pairs(self) -> list[dict[str, Any]]:
        """A dict for every two methods on the same trials."""
    def to_json_lines(self) -> str:
        """Rows and pairs as `spf experiment --json -` prints them."""
    def __len__(self) -> int: ...
class Campaign:
    """Methods on scenes, with noise and tracking, and how often."""
    @staticmethod
    def load(path: str | os.PathLike[str], settings: dict[str, Any] = ..., scene_settings: dict[str, Any] = ..., methods: MethodTable = ...) -> Campaign:
        """Reads a campaign file (docs/campaigns.md). `settings` are written over its own keys,
        `scene_settings` over every scenario's. Raises InputError with every problem."""
    @staticmethod
    def preset(name: str, settings: dict[str, Any] = ..., scene_settings: dict[str, Any] = ..., methods: MethodTable = ...) -> Campaign:
        """A campaign that is built in: table2, table3, runtime, scenes, wheels."""
    @staticmethod
    def of(scenario: Scenario, trials: int, first: int = 0) -> Campaign:
        """Trials `first` to `first + trials - 1` of one scenario."""
    def run(self, *, jobs: int = 0, shard: tuple[int, int] = ..., timed: bool = False, progress: Callable[[int, int, Trial], object] | None = None) -> Results:
        """Runs it without Python's lock on `jobs` threads (0: one a processor), all of it or part `shard`
        = (i, n). Timings apart, the results do not depend on either. progress(done, all, trial) is
        called after every trial; what it raises ends the run, and so does Ctrl-C."""
    @property
    def name(self) -> str:
        """Its short name."""
    @property
    def trials(self) -> int:
        """Trials of each cell."""
    @property
    def cells(self) -> list[str]:
        """What the rows of its table are about, one sentence each."""
class Observation:
    """What a robot has seen around it at one instant."""
    def __init__(self, time: float, detections: Sequence[ArrayLike]) -> None:
        """Rows x, y [m], velocity x, y [m/s], radius [m] of what moves, at a time [s]."""
    @property
    def time(self) -> float:
        """[s]"""
    @property
    def detections(self) -> NDArray[np.float64]:
        """(n, 5): x, y [m], velocity x, y [m/s] (NaN: unknown), radius [m]."""
    @property
    def ranges(self) -> NDArray[np.float64] | None:
        """(beams,) [m] of a sweep of the range sensor, infinite without a return; or None."""
class Message:
    """A robot's broadcast to its peers."""
    @property
    def robot_id(self) -> int:
        """Whose it is."""
    @property
    def sent_time(self) -> float:
        """[s]"""
    @property
    def trajectory(self) -> Trajectory:
        """What it is going to do."""
class Robot:
    """One robot as a whole: localiser, planner and controller with their guards; see World.robot()."""
    def add_pose(self, time: float, pose: ArrayLike, now: float) -> None:
        """A pose (3,) measured at a time [s], taken in `now` [s]."""
    def add_observation(self, observation: Observation, now: float) -> None:
        """What it sees, taken in `now` [s]."""
    def add_message(self, message: Message, now: float) -> None:
        """What it hears, taken in `now` [s]."""
    def step(self, now: float) -> dict[str, Any]:
        """Plans and controls where due, as a dict: wheel_speeds (inputs,) to hold until the next, planned,
        broadcast (a Message for the peers, or None)."""
    def set_goal(self, goal: ArrayLike, heading: float | None = None) -> None:
        """Another goal (2,) [m] from now on, with a heading [rad] or any."""
    def cancel(self) -> None:
        """No goal any more: it brakes and stands."""
    def set_switches(self, paused: bool, emergency_stop: bool = False) -> None:
        """What makes it stand until it is taken back."""
    @property
    def status(self) -> dict[str, Any]:
        """How it stands, as a dict: reason, blocking_id (-1: none)."""
    @property
    def trajectory(self) -> Trajectory | None:
        """The plan that it follows; None while it starts afresh, as after a jump of its clock."""
class World:
    """The truth of a trial, step by step in the manner of Gymnasium, all robots at once. A step
    leads from one measured pose to the next. N robots, frame: world, SI."""
    def __init__(self, scenario: Scenario, trial: int = 0) -> None:
        """Of a scenario with tracking: full; `trial` is the first that reset() begins."""
    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[dict[str, Any], dict[str, Any]]:
        """Begins a trial and returns (observation, info): {"trial": k} in `options`, or the one after the
        last. `seed` replaces the scenario's. The observation is a dict: time [s]; pose (N, 3) as measured,
        x, y [m], heading [rad]; goal (N, 2) [m], NaN: none; obstacles (N, M, 5) as each robot has seen them last, x, y
        [m], their velocity [m/s], radius [m], NaN where there are fewer; observed (N,), whether they are new.
        The info is the truth: trial; pose (N, 3), velocity (N, 2) [m/s], arrived (N,), contacts."""
    def step(self, action: ArrayLike) -> tuple[dict[str, Any], NDArray[np.float64], bool, bool, dict[str, Any]]:
        """Holds inputs (N, inputs) until the next pose: rim speeds [m/s] of the wheels, of a car rim speed
        and steering angle [rad]. Returns (observation, reward, terminated, truncated, info): the reward
        (N,) is by how much [m] each robot came nearer to its goal (0 when it is told another); terminated by a contact or when all
        have arrived, truncated when time is up."""
    def robot(self, number: int) -> Robot:
        """A new Robot as the scenario has it, at its start: what drives in trials."""
    def observation(self, robot: int) -> Observation:
        """What a robot has seen last, to be handed to Robot.add_observation()."""
    def messages(self, robot: int) -> list[Message]:
        """What it has heard with this step, a list of Message."""
    def broadcast(self, robot: int, message: Message) -> None:
        """Sends a message of a robot, which others hear as the scenario's radio allows."""
    def result(self) -> dict[str, Any]:
        """The result so far as a dict: outcome, sim_time [s], digest, least clearances [m]."""
    @property
    def robots(self) -> int:
        """N, how many there are."""
    @property
    def time(self) -> float:
        """[s]"""
    @property
    def finished(self) -> bool:
        """The trial has ended."""
    @property
    def active(self) -> list[bool]:
        """By robot: it is neither wrecked, nor broken down, nor gone."""
    @property
    def orders(self) -> list:
        """What robots are told with this step, or befalls them, as dicts: robot, do (a word of scenario
        files), and goal (2,) [m] and heading [rad] (None: any) or priority where it has them."""
class Fleet:
    """All robots of a World, as the program drives them."""
    def __init__(self, world: World) -> None:
        """New robots at their starts, and again after each reset()."""
    def act(self) -> NDArray[np.float64]:
        """Once before each step: every robot senses, hears, plans and speaks. Returns the action (N, inputs)
        for step(), in which you may replace what some robots do."""
