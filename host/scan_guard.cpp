#include "host/scan_guard.hpp"

#include <algorithm>
#include <cmath>

#include "host/scan_check.hpp"
#include "host/swept_arc.hpp"
#include "host/swept_outline.hpp"
#include "spf/math/angles.hpp"
#include "spf/math/plane.hpp"

namespace spf::host {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kCreep = 0.01;         // [1] of max_speed: slower is no motion
constexpr double kSameThing = 1.0 / 3;  // [1] of the radius: returns of the same thing are no farther apart
constexpr double kNoise = 1.0 / 6;      // [1] of the radius: smaller differences of ranges may be noise
constexpr double kOwn = 1.0 / 3;        // [1] of the inscribed radius: parts of the robot lie so deep in it
constexpr int kNeighbours = 3;          // to either side that smooth a range
constexpr double kApart = 0.08;         // [s] between two scans that are compared
constexpr double kVeerTime = 0.1;       // [s] over which the direction of the commands is smoothed
constexpr double kSameStop = 1.0;       // [s]
constexpr std::size_t kMostAlone = 64;  // single returns that are looked into

/// The reading of a beam that returned, else infinity. The beams of a full turn have neighbours at its ends.
class Readings {
 public:
  explicit Readings(const RangeScan& scan)
      : scan_{scan},
        count_{scan.ranges.size()},
        closed_{std::abs(scan.angle_increment) * (static_cast<double>(count_) + 0.5) >= 2.0 * kPi} {}

  [[nodiscard]] double at(std::size_t beam) const {
    const double range = scan_.ranges[beam];
    return range > 0.0 && range <= scan_.max_range ? range : kInfinity;
  }
  /// What at least two of three neighbours agree on.
  [[nodiscard]] double agreed(std::size_t beam) const {
    const double before = beside(beam, -1);
    const double here = at(beam);
    const double after = beside(beam, 1);
    return std::max(std::min(before, here), std::min(std::max(before, here), after));
  }
  /// The mean of the neighbours that see the same surface, whose noise is less than that of one.
  [[nodiscard]] double smoothed(std::size_t beam, double agreed, double noise) const {
    double sum = 0.0;
    int number = 0;
    for (int offset = -kNeighbours; offset <= kNeighbours; ++offset) {
      const double range = beside(beam, offset);
      if (!(std::abs(range - agreed) <= noise)) continue;
      sum += range;
      ++number;
    }
    return number > 0 ? sum / number : agreed;
  }

 private:
  [[nodiscard]] double beside(std::size_t beam, int offset) const {
    const auto count = static_cast<std::ptrdiff_t>(count_);
    std::ptrdiff_t other = static_cast<std::ptrdiff_t>(beam) + offset;
    if (other < 0 || other >= count) {
      if (!closed_ || count <= kNeighbours) return kInfinity;
      other += other < 0 ? count : -count;
    }
    return at(static_cast<std::size_t>(other));
  }

  const RangeScan& scan_;
  std::size_t count_;
  bool closed_;
};

/// Of a frame in another one.
class Placement {
 public:
  explicit Placement(const Pose2& pose)
      : origin_{pose.position_world}, x_{std::cos(pose.heading), std::sin(pose.heading)} {}
  [[nodiscard]] Eigen::Vector2d direction(const Eigen::Vector2d& inside) const {
    return {x_.x() * inside.x() - x_.y() * inside.y(), x_.y() * inside.x() + x_.x() * inside.y()};
  }
  [[nodiscard]] Eigen::Vector2d point(const Eigen::Vector2d& inside) const {
    return origin_ + direction(inside);
  }

 private:
  Eigen::Vector2d origin_;
  Eigen::Vector2d x_;
};

}  // namespace

const char* to_string(GuardAction action) {
  switch (action) {
    case GuardAction::none:
      return "clear";
    case GuardAction::slows:
      return "slows";
    case GuardAction::stops:
      return "stops";
  }
  return "?";
}

ScanGuard::ScanGuard(const GuardParameters& parameters, const AgentParameters& agent, double clock_error)
    : parameters_{validated(parameters)},
      robot_{with_radius_of_footprint(validated(agent).robot)},
      footprint_{robot_},
      control_period_{agent.tracker.control_period},
      reaction_time_{control_period_ + agent.robot.motor_lag},
      stale_time_{agent.team.stale_time},
      clock_error_{clock_error} {
  constexpr double kSpare = 1.2;  // commands may be a little beyond the planned speed
  const double fastest = kSpare * robot_.max_speed;
  const double stopping_time = stale_time_ + reaction_time_ + fastest / robot_.max_acceleration;
  const double stopping_distance =
      fastest * reaction_time_ + 0.5 * fastest * fastest / robot_.max_acceleration;
  reach_ = robot_.radius + 2.0 * parameters_.margin + stopping_distance +
           parameters_.fastest_approach * stopping_time;
}

double ScanGuard::scan_age(double now) const {
  return now - sweep(0).time;
}

void ScanGuard::forget() {
  motion_.reset();
  for (Sweep& sweep : sweeps_) sweep.time = kNever;
  judged_time_ = kNever;
  last_stop_time_ = kNever;
  verdict_ = {};
}

// ---- scans ------------------------------------------------------------------------------------------------

bool ScanGuard::add_scan(double time, const RangeScan& scan, const Pose2& sensor_in_body, double now) {
  const bool timely = time <= now + clock_error_ && time > sweep(0).time && now - time <= stale_time_;
  if (!timely || !sensible(scan) || !sensible(sensor_in_body)) {
    ++counts_.scans_refused;
    return false;
  }
  const Pose2 body = motion_.at(std::min(time, now));
  Sweep& sweep = next_sweep();
  sweep.time = time;
  collect(scan, sensor_in_body, body, sweep);
  confirm(sweep, this->sweep(1));
  return true;
}

/// Those that are compared lie far enough apart in time to tell motion from noise.
ScanGuard::Sweep& ScanGuard::next_sweep() {
  if (sweep(0).time - sweep(1).time >= kApart) newest_ = (newest_ + 1) % kSweeps;
  return sweeps_[newest_];
}

void ScanGuard::collect(const RangeScan& scan, const Pose2& sensor_in_body, const Pose2& body,
                        Sweep& into) const {
  into.seen.clear();
  into.alone.clear();
  const Readings readings{scan};
  const Placement sensor{sensor_in_body};
  const Placement robot{body};
  const double farthest = reach_ + sensor_in_body.position_world.norm();
  const auto keep = [&](std::size_t beam, double range, std::vector<Eigen::Vector2d>& kept) {
    if (range > farthest) return;
    const double angle = scan.angle_min + scan.angle_increment * static_cast<double>(beam);
    const Eigen::Vector2d position = sensor.point(range * Eigen::Vector2d{std::cos(angle), std::sin(angle)});
    const bool own = footprint_.is_disc()
                         ? position.norm() < parameters_.own_radius
                         : footprint_.distance_to(position) < -kOwn * footprint_.inscribed_radius();
    if (!own && position.norm() <= reach_) kept.push_back(robot.point(position));
  };
  for (std::size_t beam = 0; beam < scan.ranges.size(); ++beam) {
    const double agreed = readings.agreed(beam);
    if (agreed <= farthest) keep(beam, readings.smoothed(beam, agreed, kNoise * robot_.radius), into.seen);
    const double reading = readings.at(beam);
    if (reading < agreed - kSameThing * robot_.radius && into.alone.size() < kMostAlone)
      keep(beam, reading, into.alone);
  }
}

/// A thing so thin that one beam meets it is there when it was there before.
void ScanGuard::confirm(Sweep& sweep, const Sweep& before) const {
  if (!(sweep.time - before.time <= stale_time_)) return;
  const double near = kSameThing * robot_.radius;
  for (const Eigen::Vector2d& point : sweep.alone) {
    const auto is_near = [&](const Eigen::Vector2d& other) {
      return (other - point).squaredNorm() <= near * near;
    };
    if (std::any_of(before.alone.begin(), before.alone.end(), is_near) ||
        std::any_of(before.seen.begin(), before.seen.end(), is_near))
      sweep.seen.push_back(point);
  }
}

// ---- commands ---------------------------------------------------------------------------------------------

/// Along which the command leads: it turns with the body, and as the commands have veered lately, no harder
/// than the robot can.
ScanGuard::Course ScanGuard::course_of(double now, const Eigen::Vector3d& twist_body) {
  const double speed = twist_body.head<2>().norm();
  const double direction = std::atan2(twist_body.y(), twist_body.x());
  const double elapsed = now - judged_time_;
  const bool goes_on = elapsed > 0.0 && elapsed < stale_time_;
  if (goes_on) {
    const double rate = angle_difference(direction, last_direction_) / elapsed;
    veering_ += elapsed / (elapsed + kVeerTime) * (rate - veering_);
  } else if (!(elapsed == 0.0)) {
    veering_ = 0.0;
  }
  last_direction_ = direction;
  judged_time_ = now;
  const double hardest = robot_.max_acceleration / speed;
  const double turning = std::clamp(twist_body.z() + veering_, -hardest, hardest);
  const Eigen::Vector2d ahead = setting_out(twist_body.head<2>() / speed);
  return {Placement{motion_.here()}.direction(ahead), turning / speed};
}

/// A robot under way sets out as it moves, which is a little behind what it is told.
Eigen::Vector2d ScanGuard::setting_out(const Eigen::Vector2d& commanded) const {
  constexpr double kAboutTheSame = 0.95;  // [1] cosine
  const Eigen::Vector2d moves = motion_.twist_body().head<2>();
  const double speed = moves.norm();
  const bool follows = speed > kCreep * robot_.max_speed && moves.dot(commanded) >= kAboutTheSame * speed;
  return follows ? Eigen::Vector2d{moves / speed} : commanded;
}

double ScanGuard::free_distance(const Sweep& sweep, const Course& course) const {
  const Pose2 here = motion_.here();
  const SweptArc disc{course.direction, course.curvature, robot_.radius};
  double distance = kInfinity;
  if (footprint_.is_disc()) {
    for (const Eigen::Vector2d& point : sweep.seen)
      distance = std::min(distance, disc.distance_to(point - here.position_world));
    return distance;
  }
  const SweptOutline outline{footprint_, here.heading, course.direction, course.curvature};
  for (const Eigen::Vector2d& point : sweep.seen) {
    const Eigen::Vector2d offset = point - here.position_world;
    // What the disc around the outline meets no sooner, the outline does not, but for what is within it.
    const bool within = offset.squaredNorm() <= robot_.radius * robot_.radius;
    if (within || disc.distance_to(offset) < distance)
      distance = std::min(distance, outline.distance_to(offset));
  }
  return distance;
}

/// On the spot, so fast [rad/s], until it has stopped turning.
bool ScanGuard::may_turn(double yaw_rate) const {
  if (footprint_.is_disc() || yaw_rate == 0.0) return true;
  const Pose2 here = motion_.here();
  const SweptOutline outline{footprint_, here.heading, Eigen::Vector2d::UnitX(), 0.0};
  const double rate = std::abs(yaw_rate);
  const double needed = rate * reaction_time_ + 0.5 * rate * rate / robot_.max_yaw_acceleration +
                        parameters_.margin / robot_.radius;
  const auto free = [&](const Eigen::Vector2d& point) {
    return outline.turn_to(point - here.position_world, yaw_rate > 0.0) >= needed;
  };
  return std::all_of(sweep(0).seen.begin(), sweep(0).seen.end(), free);
}

/// The free distance, and how fast what ends it came nearer over the last scans; what appeared at once is not
/// known to move. Differences that may be noise count for the nearer, so that it does not creep on by luck,
/// and a robot that `stood` waits for two scans without what it stood before.
GuardVerdict ScanGuard::look_along(const Course& course, bool stood) const {
  GuardVerdict seen;
  const double newest = seen.free_distance = free_distance(sweep(0), course);
  if (std::isinf(newest) && !stood) return seen;
  const double noise = kNoise * robot_.radius;
  double slowest = kInfinity;
  double change = 0.0;
  for (std::size_t ago = 1; ago < kSweeps; ++ago) {
    const double elapsed = sweep(0).time - sweep(ago).time;
    if (!(elapsed <= 2.0 * stale_time_)) break;
    const double before = free_distance(sweep(ago), course);
    change = before - newest;
    slowest = std::min(slowest, change / elapsed);
    if (std::abs(change) < noise || (stood && ago == 1))
      seen.free_distance = std::min(seen.free_distance, before);
  }
  const bool comes = change > noise && slowest > 0.0 && slowest <= parameters_.fastest_approach;
  if (comes) seen.closing_speed = slowest;
  return seen;
}

/// What it takes from a speed [m/s] to standstill, on an arc whose curvature takes its share of the
/// acceleration: dv/dt = -sqrt(a^2 - (k v^2)^2).
double ScanGuard::stopping_distance(double speed, double curvature, double closing) const {
  const double most = robot_.max_acceleration;
  const double share = std::min(1.0, curvature * speed * speed / most);  // of the curve
  constexpr double kStraight = 1e-4;
  const double braking = share < kStraight ? 0.5 * speed * speed / most : 0.5 * std::asin(share) / curvature;
  const double longer = 1.0 + 0.32 * share * share;  // braking takes 1.31 times as long when share is 1
  return speed * reaction_time_ + braking + closing * (reaction_time_ + longer * speed / most);
}

/// The largest speed up to a given one from which it can stop within the room [m], while what comes nearer
/// does.
double ScanGuard::admissible_speed(double room, double speed, double curvature, double closing) const {
  if (stopping_distance(speed, curvature, closing) <= room) return speed;
  constexpr int kHalvings = 20;
  double low = 0.0;
  double high = speed;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (stopping_distance(middle, curvature, closing) <= room ? low : high) = middle;
  }
  return low;
}

/// The command turns off from where the robot is moving faster than it can, and what it moves towards leaves
/// no time for that.
bool ScanGuard::must_brake_first(const Eigen::Vector2d& command) const {
  const Eigen::Vector2d moves = motion_.twist_body().head<2>();
  const double speed = moves.norm();
  if (!(speed > kCreep * robot_.max_speed)) return false;
  constexpr double kAtOnce = 1.5;  // [1] of the reaction time: turned off by so much it as good as goes there
  const double aside = std::abs(cross(moves, command)) / speed;
  if (aside <= kAtOnce * reaction_time_ * robot_.max_acceleration) return false;
  const Course straight{Placement{motion_.here()}.direction(moves / speed), 0.0};
  return free_distance(sweep(0), straight) < parameters_.margin + stopping_distance(speed, 0.0, 0.0);
}

const GuardVerdict& ScanGuard::judge(double now, const Eigen::Vector3d& twist_body) {
  const bool stood = verdict_.action == GuardAction::stops;
  verdict_ = {};
  const double speed = twist_body.head<2>().norm();
  if (!sees(now)) return verdict_;
  const bool turns = may_turn(twist_body.z());
  if (!(speed > kCreep * robot_.max_speed)) {
    verdict_.may_turn = turns;
    verdict_.action = turns ? GuardAction::none : GuardAction::stops;
    if (!turns) count(now);
    return verdict_;
  }
  const Course course = course_of(now, twist_body);
  verdict_ = look_along(course, stood);
  verdict_.may_turn = turns;
  if (std::isfinite(verdict_.free_distance)) {
    // Having stopped, it waits for a distance worth going.
    const double margin = parameters_.margin + (stood ? kNoise * robot_.radius : 0.0);
    const double room =
        verdict_.free_distance - margin - verdict_.closing_speed * std::max(0.0, scan_age(now));
    const double curvature = SweptArc{course.direction, course.curvature, robot_.radius}.curvature();
    verdict_.scale = admissible_speed(room, speed, curvature, verdict_.closing_speed) / speed;
  }
  if (verdict_.scale >= 1.0 && !must_brake_first(twist_body.head<2>())) return verdict_;
  const bool stops = verdict_.scale * speed <= kCreep * robot_.max_speed ||
                     must_brake_first(verdict_.scale * twist_body.head<2>());
  verdict_.action = stops ? GuardAction::stops : GuardAction::slows;
  if (stops) verdict_.scale = 0.0;
  count(now);
  return verdict_;
}

void ScanGuard::count(double now) {
  counts_.held_time += control_period_;
  if (verdict_.action != GuardAction::stops) return;
  if (now - last_stop_time_ > kSameStop) ++counts_.stops;
  last_stop_time_ = now;
}

/// The body turns as fast as keeps it on its arc while it brakes; when it stands, as it is told.
Eigen::Vector3d ScanGuard::allowed(const Eigen::Vector3d& twist_body) const {
  if (verdict_.action == GuardAction::none) return twist_body;
  if (!(twist_body.head<2>().norm() > kCreep * robot_.max_speed))
    return {twist_body.x(), twist_body.y(), 0.0};
  const double moves = motion_.twist_body().head<2>().norm();
  const bool stands = verdict_.action == GuardAction::stops && moves <= kCreep * robot_.max_speed;
  const double share = std::min(1.0, moves / twist_body.head<2>().norm());
  const double turning = stands ? (verdict_.may_turn ? 1.0 : 0.0) : std::max(verdict_.scale, share);
  return {verdict_.scale * twist_body.x(), verdict_.scale * twist_body.y(), turning * twist_body.z()};
}

}  // namespace spf::host
