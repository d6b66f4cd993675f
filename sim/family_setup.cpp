// What each family of scenes is unless a file says otherwise (docs/protocol.md).
#include "sim/families.hpp"

namespace spf::sim {
namespace {

void make_hard(FamilySetup& setup) {
  setup.layout.robots = 12;
  setup.layout.squares = 12;
  setup.layout.squares_within = 9.0;
  setup.layout.discs = 10;
  setup.layout.disc_speed_high = 1.2;
  setup.layout.disc_radius_low = 0.3;
  setup.layout.disc_radius_high = 0.6;
  setup.simulation.noise.speed_limit = 1.2;
}

void make_platform(FamilySetup& setup) {
  setup.layout.robots = 8;
  setup.layout.squares = 8;
  setup.layout.squares_within = 0.8;
  setup.layout.square_side_low = 0.05;
  setup.layout.square_side_high = 0.10;
  setup.layout.discs = 1;
  setup.layout.discs_within = 0.8;
  setup.layout.disc_speed_low = 0.1;
  setup.layout.disc_speed_high = 0.25;
  setup.layout.disc_radius_low = setup.layout.disc_radius_high = 0.06;
  setup.robot.radius = 0.05;
  setup.robot.max_speed = 0.3;
  setup.robot.max_acceleration = 0.5;
  setup.robot.wheel_arm = 0.04;
  setup.robot.max_wheel_speed = 0.45;
  setup.robot.mass = 0.6;
  setup.robot.inertia = 0.0008;
  setup.robot.wheel_radius = 0.02;
  setup.robot.max_wheel_torque = 0.005;
  setup.simulation.noise = {NoiseModel::walk, 0.25, 0.01, 0.25};
  setup.simulation.sensing.map = MapKnowledge::sensed;
  setup.simulation.sensing.map_grain.resolution = 0.02;
  setup.simulation.sensing.map_grain.reach = 0.35;
  setup.simulation.pose_noise.seam_sigma = 0.02;
  setup.simulation.trial.arrival_distance = 0.03;
}

void make_pedestrian(FamilySetup& setup) {
  setup.layout.robots = 4;
  setup.layout.squares = setup.layout.discs = 0;
  setup.robot.radius = 0.25;
  setup.robot.max_speed = 1.5;
  setup.robot.max_acceleration = 1.5;
  setup.robot.max_wheel_speed = 2.2;
  setup.robot.max_wheel_torque = 0.6;
  setup.simulation.sensing.detections = DetectionQuality::noisy;
  setup.simulation.trial.after_contact = AfterContact::go_on;
  setup.simulation.trial.after_arrival = AfterArrival::leave;
  setup.simulation.trial.latest_arrival = 2.0;
}

void make_tight(FamilySetup& setup) {
  setup.layout.robots = 1;
  setup.layout.squares = setup.layout.discs = 0;
  if (setup.family == Family::doors) return;
  setup.robot.max_speed = 2.0;
  setup.robot.max_wheel_speed = 3.0;
  setup.simulation.sensing.map = MapKnowledge::sensed;
  setup.simulation.trial.time_limit = 100.0;
  setup.simulation.trial.arrival_distance = 0.5;
}

}  // namespace

FamilySetup family_setup(Family family) {
  FamilySetup setup;
  setup.family = family;
  switch (family) {
    case Family::t2:
      break;
    case Family::t2_hard:
      make_hard(setup);
      break;
    case Family::f7:
      setup.layout.robots = 12;
      setup.layout.discs = 1;
      setup.simulation.sensing.map = MapKnowledge::sensed;
      break;
    case Family::p8:
      make_platform(setup);
      break;
    case Family::swap:
      setup.layout.robots = 12;
      setup.layout.squares = setup.layout.discs = 0;
      break;
    case Family::field:
      setup.layout.robots = 50;
      setup.layout.squares = setup.layout.discs = 0;
      setup.simulation.radio.range =
          20.0;  // [m] twice a plan's length: the number of peers in range must not grow with the fleet
      break;
    case Family::ped:
      make_pedestrian(setup);
      break;
    case Family::clutter:
    case Family::doors:
      make_tight(setup);
      break;
    case Family::corridor:
      setup.layout.robots = 4;
      setup.layout.squares = setup.layout.discs = 0;
      break;
  }
  return setup;
}

}  // namespace spf::sim
