// How the planning half gets a stuck robot going again: it stands, waits and plans anew from where it is;
// from the second failure in a row on it first backs off, away from what it pushed against, as far as it is
// free there. Frame: world; times are the host's [s].
#pragma once

#include <Eigen/Core>

#include <optional>

#include "host/localiser.hpp"
#include "host/progress_monitor.hpp"
#include "spf/team/robot_agent.hpp"

namespace spf::host {

class Recovery {
 public:
  explicit Recovery(const AgentParameters& agent);
  /// Other limits and tolerances from now on; what is under way goes on.
  void reconfigure(const AgentParameters& agent);

  /// Once in every step; `goes`: it has a goal, and nothing is missing.
  void look(double now, const Localiser& localiser, const RobotAgent& agent, bool goes);
  /// It is to stand.
  [[nodiscard]] bool stuck(double now) const { return pushes_in_vain_ || progress_.stuck(now); }
  /// Where it is to go before it goes on to its goal [m].
  [[nodiscard]] const std::optional<Eigen::Vector2d>& aside() const { return aside_; }
  /// There is another goal, or none: nothing is aside any more, and progress counts from here.
  void begin_anew() {
    aside_.reset();
    progress_.reset();
  }
  void reset();

 private:
  void begin_to_back_off(double now, const Localiser& localiser);

  double distance_ = 0.0;      // [m] to back off
  double longest_time_ = 0.0;  // [s] for that
  double near_ = 0.0;          // [m] of the position aside: there
  ProgressMonitor progress_;
  bool pushes_in_vain_ = false;
  bool backed_off_in_vain_ = false;  // the last time that it pushed in vain
  std::optional<Eigen::Vector2d> aside_;
  double aside_until_ = kNever;  // [s]
};

}  // namespace spf::host
