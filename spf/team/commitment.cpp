#include "spf/team/commitment.hpp"

#include <algorithm>
#include <cmath>

#include "spf/planning/braking.hpp"
#include "spf/planning/clearance.hpp"
#include "spf/planning/steering.hpp"

namespace spf {
namespace {

constexpr double kStandingShare = 0.1;  // [1] of the distance at which a plan starts anew
constexpr double kRest = 0.01;          // [1] of max_speed and max_yaw_rate: the plan stands
constexpr double kSettled = 0.5;        // [s] at rest, after which a robot is no nearer to its plan later on

}  // namespace

Commitment::Commitment(const AgentParameters& parameters, const Pose2& start, double time)
    : heading_mode_{parameters.heading_mode},
      robot_{parameters.robot},
      drive_{parameters.robot},
      reanchor_distance_{parameters.team.reanchor_distance},
      held_heading_{start.heading},
      outlook_{start.heading},
      rests_since_{time},
      trajectory_{Trajectory::standing(start.position_world, time, 1.0, HeadingProfile{start.heading})} {}

void Commitment::reconfigure(const AgentParameters& parameters) {
  heading_mode_ = parameters.heading_mode;
  robot_ = parameters.robot;
}

void Commitment::begin_plan(const StateEstimate& estimate, PlanRequest& request,
                            const std::optional<Hold>& hold) {
  request.head = trajectory_.state(request.time);
  request.heading = trajectory_.heading_state(request.time);
  request.committed = &trajectory_;
  request.braking = braking_;
  watch_rest(request);
  if (!estimate.valid) return;
  const Pose2& pose = estimate.pose_world;
  const Eigen::Vector2d error = pose.position_world - request.head.position_world;
  const double noise = 4.0 * std::sqrt(estimate.position_variance);
  // One that is only slowed down goes on along its plan while it is near it.
  const bool stands = hold && hold->stands;
  const bool settled = request.time - rests_since_ > kSettled;
  const double far = settled ? standing_error(estimate) : std::max(reanchor_distance_, noise);
  if (error.norm() > (stands ? noise : far)) {
    const Eigen::Vector3d twist = hold ? hold->twist_world : Eigen::Vector3d{Eigen::Vector3d::Zero()};
    request.head = {pose.position_world, twist.head<2>(), Eigen::Vector2d::Zero()};
    request.heading = {pose.heading, twist.z()};
    request.committed = nullptr;
    tracking_variance_ = 0.0;
    return;
  }
  constexpr double kSmoothing = 0.1;  // of about one second at ten plans a second
  tracking_variance_ += kSmoothing * (0.5 * error.squaredNorm() - tracking_variance_);
}

/// Who cannot move sideways stands for good beside a plan that ended there.
void Commitment::watch_rest(const PlanRequest& request) {
  const bool rests = request.head.velocity_world.norm() < kRest * robot_.max_speed &&
                     std::abs(request.heading.yaw_rate) < kRest * robot_.max_yaw_rate;
  if (!rests || drive_.holonomic() || request.time < rests_since_) rests_since_ = request.time;
}

double Commitment::standing_error(const StateEstimate& estimate) const {
  return std::max(kStandingShare * reanchor_distance_, 4.0 * std::sqrt(estimate.position_variance));
}

void Commitment::follow(const PlanRequest& request, const PlanResult& result) {
  if (result.action == PlanAction::keep) {
    if (request.committed == nullptr) brake(request.time);  // there is none to keep
    return;
  }
  braking_ = result.action == PlanAction::brake;
  trajectory_ = result.trajectory;
  if (trajectory_.steered()) return;
  if (!drive_.holonomic()) {
    trajectory_ = steered_along(trajectory_, request.head, request.heading, robot_);
    return;
  }
  if (ends_soon(request)) held_heading_ = *request.goal_heading;
  trajectory_.set_heading(heading_for(request));
}

/// From where it begins to brake for the goal, or a little before, the robot turns to the goal's heading.
bool Commitment::ends_soon(const PlanRequest& request) const {
  if (!request.goal_heading) return false;
  const double stopping = request.head.velocity_world.squaredNorm() / (2.0 * robot_.max_acceleration);
  return (request.goal_world - request.head.position_world).norm() <= stopping + robot_.radius;
}

bool Commitment::brake(double time) {
  if (braking_) return false;  // the braking trajectory under way ends standing
  const FlatState head = trajectory_.state(time);
  trajectory_ = braking_trajectory(head, trajectory_.heading_state(time), time, robot_);
  braking_ = true;
  return true;
}

bool Commitment::stand_where(const StateEstimate& estimate, double time) {
  const Pose2& pose = estimate.pose_world;
  if (!estimate.valid ||
      (pose.position_world - trajectory_.position(time)).norm() <= standing_error(estimate))
    return false;
  trajectory_ = Trajectory::standing(pose.position_world, time, 1.0, HeadingProfile{pose.heading});
  tracking_variance_ = 0.0;
  return true;
}

std::optional<double> Commitment::course(const PlanRequest& request) const {
  const Eigen::Vector2d ahead = trajectory_.state(request.time + 0.5).velocity_world;
  if (ahead.norm() <= 0.1 * robot_.max_speed) return std::nullopt;
  return std::atan2(ahead.y(), ahead.x());
}

/// The blind side is at one side of the robot's wake, then at the other; where it goes stays in view.
double Commitment::look_around(const PlanRequest& request) {
  constexpr double kOverlap = 0.2;   // [rad] of the two views
  constexpr double kInView = 0.25;   // [rad] at least, from the view's edge to the course
  constexpr double kReached = 0.15;  // [rad]
  const Sight& sight = request.world.sight;
  outlook_ = course(request).value_or(outlook_);
  const double swing =
      std::clamp(kPi - sight.view_half + kOverlap, 0.0, std::max(0.0, sight.view_half - kInView));
  const auto target = [&] { return wrap_angle(outlook_ - sight.view_centre + look_side_ * swing); };
  if (std::abs(angle_difference(target(), request.heading.heading)) < kReached) look_side_ = -look_side_;
  if (const std::optional<double> lost = out_of_view(request)) {
    const double left = std::abs(angle_difference(*lost, outlook_ + swing));
    const double right = std::abs(angle_difference(*lost, outlook_ - swing));
    look_side_ = left < right ? 1.0 : -1.0;
  }
  return target();
}

/// [rad] to the nearest track that its scanner does not see now.
std::optional<double> Commitment::out_of_view(const PlanRequest& request) const {
  constexpr double kNear = 5.0;  // [m]
  if (request.world.tracks == nullptr) return std::nullopt;
  const Sight& sight = request.world.sight;
  double nearest = kNear;
  std::optional<double> found;
  for (const ObstacleTrack& track : *request.world.tracks) {
    const Eigen::Vector2d is =
        track.state.position_world + (request.time - track.time) * track.state.velocity_world;
    const Eigen::Vector2d offset = is - request.head.position_world;
    const double direction = std::atan2(offset.y(), offset.x());
    const double off = angle_difference(direction, request.heading.heading + sight.view_centre);
    if (std::abs(off) <= sight.view_half || offset.norm() >= nearest) continue;
    nearest = offset.norm();
    found = direction;
  }
  return found;
}

HeadingProfile Commitment::heading_for(const PlanRequest& request) {
  double target = held_heading_;
  switch (heading_mode_) {
    case HeadingMode::look: {
      const bool blind = request.world.sight.view_half < kPi;
      const bool turned = request.goal_heading && ends_soon(request);
      if (blind && !turned) target = look_around(request);
      break;
    }
    case HeadingMode::keep:
      break;
    case HeadingMode::goal:
      target = request.goal_heading.value_or(held_heading_);
      break;
    case HeadingMode::motion: {
      if (ends_soon(request)) {
        target = *request.goal_heading;
        break;
      }
      target = course(request).value_or(request.heading.heading);
      break;
    }
  }
  const bool held =
      std::abs(angle_difference(target, request.heading.heading)) < 1e-9 && request.heading.yaw_rate == 0.0;
  if (held) return HeadingProfile{target};
  return fitted_heading(trajectory_, request.heading, target, robot_, drive_);
}

}  // namespace spf
