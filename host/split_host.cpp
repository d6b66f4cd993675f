#include "host/split_host.hpp"

#include <algorithm>
#include <cmath>

#include "host/scan_check.hpp"

namespace spf::host {
namespace {

constexpr double kBelieved = 2.0;      // [1] of the drive's limits: more, no motor could run at
constexpr double kLongestDelay = 0.5;  // [s] from process to process, differences of their clocks included

}  // namespace

PlannerProcess::PlannerProcess(int robot_id, const AgentParameters& agent, const HostParameters& host,
                               std::uint32_t first_sequence)
    : drive_{validated(agent).robot},
      clock_{validated(host).clock_jump},
      localiser_{agent, host},
      planner_{robot_id, agent, host, first_sequence} {}

double PlannerProcess::tell_time(double now) {
  if (clock_.jumped(now)) {
    localiser_.meet_clock_jump(clock_.now());
    planner_.meet_clock_jump();
  }
  return clock_.now();
}

bool PlannerProcess::add_command(double time, const DriveInput& wheel_speeds, double now, GuardAction guard) {
  now = tell_time(now);
  const bool usable = std::abs(now - time) <= kLongestDelay && wheel_speeds.size() == drive_.inputs() &&
                      wheel_speeds.allFinite() &&
                      (wheel_speeds.array().abs() <= kBelieved * drive_.upper().array()).all();
  // A stamp ahead of this process's clock must not carry the estimate there.
  if (!usable) return false;
  localiser_.applied(std::min(time, now), wheel_speeds);
  localiser_.note_guard(guard);
  return true;
}

bool TrackerProcess::add_scan(double time, const RangeScan& scan, const Pose2& sensor_in_body, double now) {
  now = tell_time(now);
  return blind_share(scan) <= kHalfBlind && tracker_.add_scan(time, scan, sensor_in_body, now);
}

double TrackerProcess::tell_time(double now) {
  if (clock_.jumped(now)) {
    localiser_.meet_clock_jump(clock_.now());
    tracker_.meet_clock_jump();
  }
  return clock_.now();
}

}  // namespace spf::host
