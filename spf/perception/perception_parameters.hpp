// Parameters of the detection and tracking of moving objects in range scans (docs/perception.md).
#pragma once

#include "spf/math/parameters.hpp"

namespace spf {

struct PerceptionParameters {
  bool enabled = false;       ///< moving objects are found in the robot's own scans
  bool map_scans = true;      ///< static returns enter the map; false: the map is complete
  bool moving_alone = false;  ///< an outside detector tells of all others: only what has moved is reported
  double range_sigma = 0.02;  ///< [m] noise of one beam
  double pose_sigma = 0.01;   ///< [m] error of the sensor's pose, per axis

  double breakpoint_angle = 0.1745;  ///< [rad] flattest incidence at which returns are linked
  double split_depth = 0.12;         ///< [m] a dent this deep separates two objects
  double prior_radius = 0.3;         ///< [m] of a new object
  double prior_radius_sigma = 0.15;  ///< [m]
  double largest_radius = 0.8;       ///< [m] larger objects are tracked in pieces
  double piece_length = 0.6;         ///< [m] longest piece of a face
  double leg_width = 0.25;           ///< [m] widest leg of a person
  double leg_gap = 0.6;              ///< [m] largest distance of two legs
  double shape_sigma = 0.01;         ///< [m] deviation of real objects from a disc

  double initial_speed = 1.0;       ///< [m/s] spread of a new track's velocity, per axis
  double sudden_speed = 1.0;        ///< [m/s] spread of a sudden change of velocity, per axis
  double velocity_diffusion = 0.2;  ///< [(m/s)^2/s] growth of the velocity variance
  double gate = 13.8;               ///< [1] squared Mahalanobis distance: chi-square, 2 degrees, 0.999
  double unassigned_cost = 16.0;    ///< [1] of leaving a track unassigned
  double dynamic_distance = 0.15;   ///< [m] smallest displacement of a dynamic track
  double probation = 1.0;           ///< [s] a compact object is kept out of the map as long
  double coast_time = 2.0;          ///< [s] longest time out of sight
  int confirming_hits = 3;          ///< [1] sweeps of at least three returns that confirm a track
  int misses = 3;                   ///< [1] sweeps without it that end a track

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit("enabled", self.enabled, "moving objects are found in the robot's own scans");
    visit("range_sigma", self.range_sigma, "m", Range{1e-4, 1.0}, "noise of one beam of the range sensor");
    visit("pose_sigma", self.pose_sigma, "m", Range{0.0, 1.0}, "error of the sensor's pose, per axis");
    visit("leg_width", self.leg_width, kMetresBySize, Range{0.0, 1.0}, "widest leg of a person (0 = none)");
    visit("probation", self.probation, "s", Range{0.0, 60.0},
          "time that something compact has to show that it moves, before it goes into a sensed map");
    visit("coast_time", self.coast_time, "s", Range{0.0, 60.0}, "longest time that a track is out of sight");
  }

  /// No settings, but they follow the robot.
  template <class Self, class Visitor>
  static void visit_constants(Self& self, Visitor&& visit) {
    visit(self.split_depth, Scale::size, Range{0.005, 10.0});
    visit(self.prior_radius, Scale::size, Range{0.01, 10.0});
    visit(self.prior_radius_sigma, Scale::size, Range{0.001, 10.0});
    visit(self.largest_radius, Scale::size, Range{0.02, 100.0});
    visit(self.piece_length, Scale::size, Range{0.02, 100.0});
    visit(self.leg_gap, Scale::size, Range{0.0, 2.0});
    visit(self.shape_sigma, Scale::size, Range{0.0, 1.0});
    visit(self.initial_speed, Scale::speed, Range{0.01, 50.0});
    visit(self.sudden_speed, Scale::speed, Range{0.0, 50.0});
    visit(self.velocity_diffusion, Scale::velocity_diffusion, Range{1e-8, 100.0});
    visit(self.dynamic_distance, Scale::size, Range{0.01, 10.0});
  }
};

}  // namespace spf
