// The planner's door: requests, results, and the built-in methods as objects.
#include "python/planner.hpp"

#include <optional>
#include <utility>

#include "python/map.hpp"
#include "spf/planning/contact_risk.hpp"
#include "spf/team/guide_policy.hpp"
#include "spf/team/method_table.hpp"

namespace spf::python {
namespace {

const char* name_of(PlanAction action) {
  switch (action) {
    case PlanAction::follow:
      return "follow";
    case PlanAction::keep:
      return "keep";
    case PlanAction::brake:
      return "brake";
  }
  return "?";
}

const char* name_of(Candidate::Kind kind) {
  switch (kind) {
    case Candidate::Kind::previous:
      return "previous";
    case Candidate::Kind::side_a:
      return "side a";
    case Candidate::Kind::side_b:
      return "side b";
    case Candidate::Kind::primitive:
      return "primitive";
    case Candidate::Kind::optimised:
      return "optimised";
    case Candidate::Kind::brake:
      return "brake";
  }
  return "?";
}

const char* name_of(PeerState state) {
  switch (state) {
    case PeerState::moving:
      return "moving";
    case PeerState::braking:
      return "braking";
    case PeerState::stopped:
      return "stopped";
    case PeerState::arrived:
      return "arrived";
  }
  return "?";
}

ObstacleTrack make_track(const py::object& position, const py::object& velocity, const py::object& radius,
                         int id, const py::object& time, const py::object& sigma) {
  ObstacleTrack track;
  track.id = id;
  track.time = finite_number(time, "time");
  track.state = {point_from(position, "position"), point_from(velocity, "velocity"),
                 positive_number(radius, "radius")};
  const double deviation = finite_number(sigma, "sigma");
  if (deviation < 0.0) refuse("sigma", sigma, "must be at least 0 m");
  track.position_variance = deviation * deviation;
  return track;
}

void bind_beliefs(py::module_& module) {
  py::class_<ObstacleTrack>(module, "ObstacleTrack", "Belief about one moving obstacle.")
      .def(py::init(&make_track), py::arg("position"), py::arg("velocity") = py::make_tuple(0.0, 0.0),
           py::arg("radius") = 0.3, py::arg("id") = 0, py::arg("time") = 0.0, py::arg("sigma") = 0.0,
           "A disc at a position [m] at a time [s], with a velocity [m/s], a radius [m], and the standard\n"
           "deviation of its position per axis [m].")
      .def_readonly("id", &ObstacleTrack::id, "Its number.")
      .def_readonly("time", &ObstacleTrack::time, "[s] of its state.")
      .def_property_readonly(
          "position", [](const ObstacleTrack& self) { return to_array(self.state.position_world); },
          "(2,) [m]")
      .def_property_readonly(
          "velocity", [](const ObstacleTrack& self) { return to_array(self.state.velocity_world); },
          "(2,) [m/s]")
      .def_property_readonly(
          "radius", [](const ObstacleTrack& self) { return self.state.radius; }, "[m]")
      .def(
          "sigma",
          [](const ObstacleTrack& self, const py::object& ahead) {
            return self.position_sigma(finite_number(ahead, "ahead"));
          },
          py::arg("ahead") = 0.0, "Standard deviation per axis [m] so many seconds after `time`.");
  py::class_<Peer>(module, "Peer", "Belief about one teammate, from its broadcasts.")
      .def_readonly("robot_id", &Peer::robot_id, "Its number.")
      .def_readonly("priority", &Peer::priority, "The smaller goes first; among equals the smaller number.")
      .def_property_readonly(
          "state", [](const Peer& self) { return name_of(self.state); },
          "moving, braking, stopped or arrived.")
      .def_readonly("radius", &Peer::radius, "[m]")
      .def_readonly("position_sigma", &Peer::position_sigma, "[m] per axis.")
      .def_readonly("expired", &Peer::expired, "Silent for too long: a disc where it was last.")
      .def_property_readonly(
          "trajectory", [](const Peer& self) { return Trajectory{*self.trajectory}; },
          "What it has announced.")
      .def(
          "position",
          [](const Peer& self, const py::object& time) {
            return to_array(self.position(finite_number(time, "time")));
          },
          py::arg("time"), "(2,) [m] at an absolute time [s].")
      .def(
          "velocity",
          [](const Peer& self, const py::object& time) {
            return to_array(self.velocity(finite_number(time, "time")));
          },
          py::arg("time"), "(2,) [m/s] at an absolute time [s].");
}

/// Copies that do not hang on the request.
std::vector<Peer> peers_of(const RequestView& view) {
  const std::vector<Peer>* peers = view.get().world.peers;
  if (peers == nullptr) return {};
  std::vector<Peer> copies = *peers;
  for (Peer& peer : copies) peer.claim = nullptr;  // its message owns that
  return copies;
}

void bind_request_of_ground(py::class_<RequestView>& type) {
  type.def(
          "distance",
          [](const RequestView& self, const py::object& points) {
            return number_of_points(points, "points", [&map = *self.get().world.map](const auto& point) {
              return map.distance(point);
            });
          },
          py::arg("points"), "Distance [m] to what stands at points (..., 2).")
      .def(
          "distance_gradient",
          [](const RequestView& self, const py::object& points) {
            return vector_of_points<2>(points, "points", [&map = *self.get().world.map](const auto& point) {
              return map.distance_gradient(point);
            });
          },
          py::arg("points"), "(..., 2) away from what stands.")
      .def(
          "cost_to_go",
          [](const RequestView& self, const py::object& points) {
            return number_of_points(points, "points", [&guide = *self.get().guide](const auto& point) {
              return guide.cost_to_go(point);
            });
          },
          py::arg("points"), "Length [m] of the shortest path to the goal from points (..., 2).")
      .def(
          "direction",
          [](const RequestView& self, const py::object& points) {
            return vector_of_points<2>(points, "points", [&guide = *self.get().guide](const auto& point) {
              return guide.direction(point);
            });
          },
          py::arg("points"), "(..., 2) unit vectors along that path; zero at the goal.")
      .def(
          "descend",
          [](const RequestView& self, const py::object& point, const py::object& distance) {
            const double along = finite_number(distance, "distance");
            if (along < 0.0) refuse("distance", distance, "must be at least 0 m");
            return to_array(self.get().guide->descend(point_from(point, "point"), along));
          },
          py::arg("point"), py::arg("distance"), "The position [m] so far along that path, at most the goal.")
      .def(
          "copy_map",
          [](const RequestView& self) { return std::make_shared<OccupancyMap>(*self.get().world.map); },
          "The static map, to keep.");
}

void bind_request(py::module_& module) {
  py::class_<RequestView> type(
      module, "PlanRequest",
      "What a method plans from, valid during the call of plan() alone. Frame: world, SI.");
  bind_request_of_ground(type);
  type.def_property_readonly(
          "time", [](const RequestView& self) { return self.get().time; },
          "[s] when the new trajectory starts.")
      .def_property_readonly(
          "position", [](const RequestView& self) { return to_array(self.get().head.position_world); },
          "(2,) [m] at that time.")
      .def_property_readonly(
          "velocity", [](const RequestView& self) { return to_array(self.get().head.velocity_world); },
          "(2,) [m/s] likewise.")
      .def_property_readonly(
          "acceleration",
          [](const RequestView& self) { return to_array(self.get().head.acceleration_world); },
          "(2,) [m/s^2] likewise.")
      .def_property_readonly(
          "heading", [](const RequestView& self) { return self.get().heading.heading; }, "[rad] likewise.")
      .def_property_readonly(
          "yaw_rate", [](const RequestView& self) { return self.get().heading.yaw_rate; },
          "[rad/s] likewise.")
      .def_property_readonly(
          "goal", [](const RequestView& self) { return to_array(self.get().goal_world); }, "(2,) [m]")
      .def_property_readonly(
          "goal_heading", [](const RequestView& self) { return self.get().goal_heading; },
          "[rad]; None: any.")
      .def_property_readonly(
          "position_sigma", [](const RequestView& self) { return self.get().position_sigma; },
          "[m] standard deviation of the robot's own position, per axis.")
      .def_property_readonly(
          "robot_id", [](const RequestView& self) { return self.get().world.robot_id; }, "Its number.")
      .def_property_readonly(
          "tracks",
          [](const RequestView& self) {
            const std::vector<ObstacleTrack>* tracks = self.get().world.tracks;
            return tracks == nullptr ? std::vector<ObstacleTrack>{} : *tracks;
          },
          "The moving obstacles, as a list of ObstacleTrack to keep.")
      .def_property_readonly("peers", &peers_of, "The teammates, as a list of Peer to keep.")
      .def_property_readonly(
          "committed",
          [](const RequestView& self) -> std::optional<Trajectory> {
            const Trajectory* committed = self.get().committed;
            return committed == nullptr ? std::nullopt : std::optional<Trajectory>{*committed};
          },
          "The current plan; None after a reset.")
      .def_property_readonly(
          "braking", [](const RequestView& self) { return self.get().braking; },
          "Whether that is a braking one.");
}

void bind_result(py::module_& module) {
  py::class_<Candidate>(module, "Candidate", "One trajectory that was considered.")
      .def_property_readonly(
          "kind", [](const Candidate& self) { return name_of(self.kind); }, "How it came about.")
      .def_readonly("cost", &Candidate::cost, "In the method's own unit.")
      .def_readonly("risk", &Candidate::risk, "Probability of contact with what moves within 3 s.")
      .def_readonly("chosen", &Candidate::chosen, "It is the result's.")
      .def_readonly("trajectory", &Candidate::trajectory, "Its motion.");
  py::class_<PlanResult>(module, "PlanResult", "What came of a request.")
      .def_property_readonly(
          "outcome", [](const PlanResult& self) { return to_string(self.outcome); },
          "success, goal reached, no path, unsafe, deadline, or invalid request.")
      .def_property_readonly(
          "succeeded", [](const PlanResult& self) { return succeeded(self.outcome); },
          "The trajectory has passed the clearance check.")
      .def_property_readonly(
          "action", [](const PlanResult& self) { return name_of(self.action); }, "follow, keep or brake.")
      .def_readonly("trajectory", &PlanResult::trajectory, "Usable, whatever the outcome.")
      .def_readonly("risk", &PlanResult::risk, "Probability of contact with what moves within 3 s.")
      .def_readonly("blocking_track", &PlanResult::blocking_track,
                    "Number of the obstacle that shapes the plan most, -1: none.")
      .def_readonly("blocking_peer", &PlanResult::blocking_peer, "Likewise of the peer.")
      .def_readonly("candidates", &PlanResult::candidates, "Those considered, when asked for.")
      .def_property_readonly(
          "stats",
          [](const PlanResult& self) {
            py::dict stats;
            stats["optimiser_calls"] = self.stats.optimiser_calls;
            stats["inner_iterations"] = self.stats.inner_iterations;
            stats["evaluations"] = self.stats.evaluations;
            stats["primitives"] = self.stats.primitives;
            return stats;
          },
          "What it cost, as a dict of counts.")
      .def("__repr__", [](const PlanResult& self) {
        return std::string{"<spf.PlanResult "} + to_string(self.outcome) + ", " + name_of(self.action) + ">";
      });
}

/// A method on its own: it believes what it is told, and keeps its plan from call to call.
class StandalonePlanner {
 public:
  StandalonePlanner(const std::string& method, const std::optional<AgentParameters>& agent,
                    const MethodTable& methods)
      : agent_{with_method(agent.value_or(defaults_for(RobotParameters{})), methods.at(method))},
        planner_{agent_.make_planner(agent_)} {}

  PlanResult plan(const OccupancyMap& map, const py::object& position, const py::object& goal,
                  const py::object& velocity, const py::object& time, const py::object& heading,
                  const std::vector<ObstacleTrack>& tracks, bool keep_candidates) {
    PlanRequest request;
    request.time = finite_number(time, "time");
    request.head.position_world = point_from(position, "position");
    request.head.velocity_world = point_from(velocity, "velocity");
    request.heading.heading = finite_number(heading, "heading");
    request.goal_world = point_from(goal, "goal");
    request.keep_candidates = keep_candidates;
    const std::vector<Peer> nobody;
    request.world.time = request.time;
    request.world.map = &map;
    request.world.tracks = &tracks;
    request.world.peers = &nobody;
    PlanResult result;
    CostToGo guide = make_guide(agent_, GuideNeeds::of(*planner_));
    guide.update(map, request.goal_world, request.head.position_world);
    request.guide = &guide;
    request.goal_cut_off = guide.outcome() == CostToGoOutcome::unreachable;
    if (committed_) request.committed = &*committed_;
    request.braking = braking_;
    planner_->plan(request, result);
    set_risk(request, agent_.robot.radius, result);
    if (result.action != PlanAction::keep) {
      committed_ = result.trajectory;
      braking_ = result.action == PlanAction::brake;
    }
    return result;
  }

  void reset() {
    planner_ = agent_.make_planner(agent_);
    committed_.reset();
    braking_ = false;
  }
  [[nodiscard]] AgentParameters parameters() const { return agent_; }

 private:
  AgentParameters agent_;
  std::unique_ptr<Planner> planner_;
  std::optional<Trajectory> committed_;
  bool braking_ = false;
};

}  // namespace

void bind_planner(py::module_& module) {
  bind_beliefs(module);
  bind_request(module);
  bind_result(module);
}

void bind_standalone_planner(py::module_& module) {
  py::class_<StandalonePlanner>(module, "Planner", "A method on its own, without robot and simulator.")
      .def(py::init<const std::string&, const std::optional<AgentParameters>&, const MethodTable&>(),
           py::arg("method") = kDefaultMethod, py::arg("parameters") = py::none(),
           py::arg("methods") = MethodTable{},
           "A method by its name, for a robot with these parameters (None: the defaults).")
      .def(
          "plan", &StandalonePlanner::plan, py::arg("map"), py::arg("position"), py::arg("goal"),
          py::kw_only(), py::arg("velocity") = py::make_tuple(0.0, 0.0), py::arg("time") = 0.0,
          py::arg("heading") = 0.0, py::arg("tracks") = std::vector<ObstacleTrack>{},
          py::arg("keep_candidates") = false,
          "Plans from a position [m] and a velocity [m/s] at a time [s] to a goal [m], among what stands on\n"
          "the map and what moves (`tracks`). The plan before is taken as the one under way.")
      .def("reset", &StandalonePlanner::reset, "Forgets the plan before.")
      .def_property_readonly("parameters", &StandalonePlanner::parameters, "A copy of its parameters.");
}

}  // namespace spf::python
