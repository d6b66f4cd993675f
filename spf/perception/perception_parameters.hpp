// Parameters of the detection and tracking of moving objects in range scans (docs/perception.md).
#pragma once

#include "spf/math/parameters.hpp"

namespace spf {

struct PerceptionParameters {
  bool map_scans = true;      ///< static returns enter the map; false: the map is complete
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
    visit("map_scans", self.map_scans, "static returns enter the map");
    visit("range_sigma", self.range_sigma, "m", Range{1e-4, 1.0}, "noise of one beam of the range sensor");
    visit("pose_sigma", self.pose_sigma, "m", Range{0.0, 1.0}, "error of the sensor's pose, per axis");
    visit("breakpoint_angle", self.breakpoint_angle, "rad", Range{0.02, 1.0},
          "flattest incidence at which returns still hang together (Borges and Aldon 2004: lambda)");
    visit("split_depth", self.split_depth, kMetresBySize, Range{0.005, 10.0},
          "depth of a dent that separates two objects");
    visit("prior_radius", self.prior_radius, kMetresBySize, Range{0.01, 10.0}, "radius expected at first");
    visit("prior_radius_sigma", self.prior_radius_sigma, kMetresBySize, Range{0.001, 10.0},
          "spread of the radius expected at first");
    visit("largest_radius", self.largest_radius, kMetresBySize, Range{0.02, 100.0},
          "larger objects are tracked in pieces");
    visit("piece_length", self.piece_length, kMetresBySize, Range{0.02, 100.0},
          "longest piece of a face that is tracked as one disc");
    visit("leg_width", self.leg_width, kMetresBySize, Range{0.0, 1.0}, "widest leg of a person (0 = none)");
    visit("leg_gap", self.leg_gap, kMetresBySize, Range{0.0, 2.0}, "largest distance of two legs");
    visit("shape_sigma", self.shape_sigma, kMetresBySize, Range{0.0, 1.0},
          "deviation of real objects from a disc");
    visit("initial_speed", self.initial_speed, kSpeedByRobot, Range{0.01, 50.0},
          "spread of the velocity of a new track");
    visit("sudden_speed", self.sudden_speed, kSpeedByRobot, Range{0.0, 50.0},
          "spread of a sudden change of velocity");
    visit("velocity_diffusion", self.velocity_diffusion, ScaledUnit{"m^2/s^3", Scale::velocity_diffusion},
          Range{1e-8, 100.0}, "growth of the variance of velocity");
    visit("gate", self.gate, "1", Range{1.0, 100.0}, "largest squared Mahalanobis distance of a match");
    visit("unassigned_cost", self.unassigned_cost, "1", Range{1.0, 1000.0},
          "cost of leaving a track unassigned");
    visit("dynamic_distance", self.dynamic_distance, kMetresBySize, Range{0.01, 10.0},
          "smallest displacement of a dynamic track");
    visit("probation", self.probation, "s", Range{0.0, 60.0},
          "time that something compact has to show that it moves, before it goes into a sensed map");
    visit("coast_time", self.coast_time, "s", Range{0.0, 60.0}, "longest time that a track is out of sight");
    visit("confirming_hits", self.confirming_hits, "1", Range{1, 100}, "sweeps that confirm a track");
    visit("misses", self.misses, "1", Range{1, 100}, "sweeps without it that end a track");
  }
};

}  // namespace spf
