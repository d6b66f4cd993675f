// Parameters of earlier releases that nobody can set any more. A file or --set that still names one is
// refused with what counts instead, so that nobody believes to have set it.
#pragma once

#include <array>
#include <string_view>

#include "config/input_problem.hpp"
#include "config/yaml_tree.hpp"

namespace spf {

struct RemovedKey {
  std::string_view path;     ///< from the root of the document
  std::string_view instead;  ///< what counts now; values are those that the parameter had when it was removed
};

/// All removed keys, for scenario files and robot files alike.
inline constexpr std::array kRemovedKeys{
    RemovedKey{"layout.side_per_root", "it is a constant, 5 m"},
    RemovedKey{"layout.robots_per_pillar", "it is a constant, 4"},
    RemovedKey{"robot.wheel_count", "a drive has three wheels"},
    RemovedKey{"pose_noise.seam_duration", "it is a constant, 0.5 s"},
    RemovedKey{"trial.arrival_speed", "it is a constant, 0.2 m/s"},
    RemovedKey{"agent.team.guide_period", "it is a constant, 0.5 s"},
    RemovedKey{"agent.team.guide_idle_period", "it is a constant, 2 s"},
    RemovedKey{"agent.team.keep_candidates", "what is recorded keeps them"},
    RemovedKey{"agent.planner.keep_candidates", "what is recorded keeps them"},
    RemovedKey{"agent.team.retry_first", "it is a constant, 0.2 s"},
    RemovedKey{"agent.team.retry_longest", "it is a constant, 1.6 s"},
    RemovedKey{"agent.field.side_change_window", "it is a constant, 4 s"},
    RemovedKey{"agent.field.widening_per_change", "it is a constant, 0.1"},
    RemovedKey{"agent.field.max_widening", "it is a constant, 0.5"},
    RemovedKey{"agent.planner.piece_length", "it is a constant, 1.5 m for the standard robot"},
    RemovedKey{"agent.planner.max_pieces", "it is a constant, 8"},
    RemovedKey{"agent.planner.nodes_per_piece", "it is a constant, 5"},
    RemovedKey{"agent.planner.checked_fraction", "it is a constant, 0.667"},
    RemovedKey{"agent.planner.max_side_combinations", "it is a constant, 8"},
    RemovedKey{"agent.planner.side_bonus", "it is a constant, 0.15"},
    RemovedKey{"agent.planner.unsafe_retries", "it is a constant, 2"},
    RemovedKey{"agent.planner.max_rebounds", "it is a constant, 20"},
    RemovedKey{"agent.planner.run_evaluations", "it is a constant, 60"},
    RemovedKey{"agent.planner.speed_tolerance", "it is a constant, 0.05"},
    RemovedKey{"agent.planner.acceleration_tolerance", "it is a constant, 0.1"},
    RemovedKey{"agent.planner.slow_factor", "it is a constant, 1.8"},
    RemovedKey{"agent.planner.goal_tolerance", "it is a constant, 0.01 m for the standard robot"},
    RemovedKey{"agent.planner.optimizer.memory", "it is a constant, 16"},
    RemovedKey{"agent.planner.optimizer.gradient_tolerance", "it is a constant, 0.00001"},
    RemovedKey{"agent.planner.optimizer.past", "it is a constant, 3"},
    RemovedKey{"agent.planner.optimizer.delta", "it is a constant, 0.01"},
    RemovedKey{"agent.planner.optimizer.max_iterations", "it is a constant, 200"},
    RemovedKey{"agent.planner.optimizer.max_evaluations", "it is a constant, 2000"},
    RemovedKey{"agent.planner.optimizer.max_line_search", "it is a constant, 64"},
    RemovedKey{"agent.planner.optimizer.sufficient_decrease", "it is a constant, 0.0001"},
    RemovedKey{"agent.planner.optimizer.curvature", "it is a constant, 0.9"},
    RemovedKey{"agent.planner.optimizer.cautious_factor", "it is a constant, 0.000001"},
    RemovedKey{"agent.guide.window_margin", "it is a constant, 10 m for the standard robot"},
    RemovedKey{"agent.guide.blocked_factor", "it is a constant, 3"},
    RemovedKey{"agent.space_time.step", "it is a constant, 0.1 s for the standard robot"},
    RemovedKey{"agent.space_time.slow_fraction", "it is a constant, 0.5"},
    RemovedKey{"agent.space_time.short_sidestep", "it is a constant, 0.7 s for the standard robot"},
    RemovedKey{"agent.space_time.long_sidestep", "it is a constant, 1.6 s for the standard robot"},
    RemovedKey{"agent.space_time.keep_bonus", "it is a constant, 0.05 s for the standard robot"},
    RemovedKey{"agent.space_time.stand_bonus", "it is a constant, 0.3 s for the standard robot"},
    RemovedKey{"agent.space_time.early_progress", "it is a constant, 0.3"},
    RemovedKey{"agent.space_time.static_sigma", "it is a constant, 0.02 m for the standard robot"},
    RemovedKey{"agent.space_time.sigma_floor", "it is a constant, 0.03 m for the standard robot"},
    RemovedKey{"agent.space_time.peer_sigma", "it is a constant, 0.02 m for the standard robot"},
    RemovedKey{"agent.space_time.peer_sigma_growth", "it is a constant, 0.08 m/s for the standard robot"},
    RemovedKey{"agent.space_time.standing_peer_growth", "it is a constant, 0.25"},
    RemovedKey{"agent.space_time.peer_risk_fading", "it is a constant, 0.4 s for the standard robot"},
    RemovedKey{"agent.space_time.lower_priority_weight", "it is a constant, 0.3"},
    RemovedKey{"agent.space_time.renewal", "it is a constant, 1 s for the standard robot"},
    RemovedKey{"agent.space_time.smoothing_evaluations", "it is a constant, 40"},
    RemovedKey{"agent.space_time.smoothing_tolerance", "it is a constant, 0.05 s for the standard robot"},
    RemovedKey{"agent.orca.static_samples", "it is a constant, 12"},
    RemovedKey{"agent.orca.period", "agent.team.plan_period counts"},
    RemovedKey{"agent.orca.goal_tolerance", "it is a constant, 0.005 m for the standard robot"},
    RemovedKey{"agent.orca.right_hand_bias", "it is a constant, 0.01 rad"},
    RemovedKey{"agent.tracker.observer.heading_velocity_noise", "it is a constant, 0.02 rad/sqrt(s)"},
    RemovedKey{"agent.tracker.observer.heading_drift_noise", "it is a constant, 0.02 rad/s/sqrt(s)"},
    RemovedKey{"agent.tracker.observer.gate", "it is a constant, 6"},
    RemovedKey{"agent.tracker.observer.gate_floor", "it is a constant, 0.02 m for the standard robot"},
    RemovedKey{"agent.tracker.observer.heading_gate_floor", "it is a constant, 0.1 rad"},
    RemovedKey{"agent.tracker.observer.readmit_count", "it is a constant, 5"},
    RemovedKey{"agent.tracker.observer.largest_jump", "it is a constant, 1 m for the standard robot"},
    RemovedKey{"agent.tracker.reference.nearest_start", "it is always false"},
    RemovedKey{"agent.tracker.reference.max_slip", "it is a constant, 0.5 s"},
    RemovedKey{"agent.tracker.mpc.slack_weight", "it is a constant, 100000 1/m^2"},
    RemovedKey{"agent.tracker.mpc.x_lower", "it is a constant, -1e6 m"},
    RemovedKey{"agent.tracker.mpc.x_upper", "it is a constant, 1e6 m"},
    RemovedKey{"agent.tracker.mpc.y_lower", "it is a constant, -1e6 m"},
    RemovedKey{"agent.tracker.mpc.y_upper", "it is a constant, 1e6 m"},
    RemovedKey{"agent.tracker.mpc.iterations", "it is a constant, 2"},
    RemovedKey{"agent.tracker.mpc.tolerance", "it is a constant, 0.000001 m/s"},
    RemovedKey{"agent.tracker.mpc.active_set_steps", "it is a constant, 100"},
    RemovedKey{"agent.tracker.mpc.warm_start", "it is always true"},
    RemovedKey{"agent.obstacles.initial_speed", "it is a constant, 1 m/s for the standard robot"},
    RemovedKey{"agent.obstacles.least_sigma", "it is a constant, 0.0001 m for the standard robot"},
    RemovedKey{"agent.obstacles.surprise", "it is a constant, 3"},
    RemovedKey{"agent.obstacles.speed_memory", "it had no effect"},
    RemovedKey{"agent.obstacles.learn_diffusion", "it is always true"},
    RemovedKey{"agent.obstacles.diffusion.prior_duration", "it is a constant, 4 s"},
    RemovedKey{"agent.obstacles.diffusion.memory", "it is a constant, 20 s"},
    RemovedKey{"agent.peers.largest_growth", "it is a constant, 1 m for the standard robot"},
    RemovedKey{"agent.peers.oldest_message", "it is a constant, 10 s"},
    RemovedKey{"agent.peers.largest_radius", "it is a constant, 10 m"},
    RemovedKey{"agent.occupancy.hit_probability", "it is a constant, 0.65"},
    RemovedKey{"agent.occupancy.miss_probability", "it is a constant, 0.35"},
    RemovedKey{"agent.occupancy.lowest_probability", "it is a constant, 0.12"},
    RemovedKey{"agent.occupancy.highest_probability", "it is a constant, 0.9"},
    RemovedKey{"agent.occupancy.occupied_probability", "it is a constant, 0.8"},
};

/// Refuses every removed key of the document, and takes it out.
void refuse_removed_keys(YamlNode& root, InputProblems& problems);

}  // namespace spf
