// One tracked object: a constant-velocity Kalman filter, with the evidence that decides about its
// confirmation, motion and end. Frame: world.
#pragma once

#include <Eigen/Core>

#include <array>

#include "spf/perception/scan_detector.hpp"

namespace spf {

struct ScanTrack {
  enum class Sight {
    seen,      ///< has returns of the last sweep
    hidden,    ///< occluded or out of range: coasts
    missing,   ///< beams pass through where it should be
    absorbed,  ///< the map masks the returns there
    doubled,   ///< an older track follows the same object
  };

  /// As it was when it was first seen: has it moved since then?
  struct Birth {
    double time = 0.0;                                         ///< [s]
    Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m]
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();      ///< [m^2] of that
    double depth = 0.0;                                        ///< [m]
    /// [m] The first, a middle and the last return: points of a surface, which what is computed from several
    /// returns need not be. NaN: not known.
    std::array<Eigen::Vector2d, 3> returns_world{};
  };

  /// What speaks for it.
  struct Evidence {
    double sweeps = 0.0;       ///< [1] that saw it; less with few returns
    double free_sweeps = 0.0;  ///< [1] the same, of returns in space seen free before
    int misses = 0;            ///< in a row
    double last_seen = 0.0;    ///< [s]

    /// A detection of so many returns, `free_share` [1] of them in space seen free before.
    void add(double time, int returns, double free_share);
  };

  int id = 0;
  bool confirmed = false;
  bool dynamic = false;   ///< has moved since its birth, or is where space was free
  bool face = false;      ///< a piece of a large flat object
  bool reported = false;  ///< is handed on to the ObstacleTracker
  bool isolated = false;  ///< compact and not joined to other surfaces
  Sight sight = Sight::seen;

  double time = 0.0;                                         ///< [s] of the state
  Eigen::Vector4d state = Eigen::Vector4d::Zero();           ///< position [m], velocity [m/s]
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();      ///< of `state`
  double radius = 0.3;                                       ///< [m]
  double radius_variance = 0.0;                              ///< [m^2]
  double depth = 0.0;                                        ///< [m] of the position behind the surface
  Eigen::Vector2d behind = Eigen::Vector2d::UnitX();         ///< unit vector from the visible surface inwards
  Eigen::Vector2d measured_world = Eigen::Vector2d::Zero();  ///< [m] at `time`, of the last sweep that saw it
  double measured_sigma = 0.0;                               ///< [m] of that, per axis

  Birth birth;
  Evidence evidence;
  Eigen::Vector2d still_world = Eigen::Vector2d::Zero();  ///< [m] where it has stayed ...
  double still_since = 0.0;                               ///< ... [s] since then

  [[nodiscard]] Eigen::Vector2d position() const { return state.head<2>(); }
  [[nodiscard]] Eigen::Vector2d velocity() const { return state.tail<2>(); }
  [[nodiscard]] Eigen::Matrix2d position_covariance() const { return covariance.topLeftCorner<2, 2>(); }
};

/// A new track: velocity 0, with a spread of `initial_speed`.
[[nodiscard]] ScanTrack born_track(int id, const ScanDetection& detection,
                                   const PerceptionParameters& parameters);
/// Predicts to a later time. A track that never moved keeps its position while it is out of sight.
void predict(ScanTrack& track, double time, const PerceptionParameters& parameters);

/// Difference of a detection from the predicted position.
struct Innovation {
  Eigen::Vector2d difference = Eigen::Vector2d::Zero();      ///< [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< [m^2]
  [[nodiscard]] double squared_mahalanobis() const;
};
/// The track's position according to a detection. Between a face and a disc, surfaces are compared.
[[nodiscard]] Eigen::Vector2d measured_position(const ScanTrack& track, const ScanDetection& detection);
[[nodiscard]] Innovation innovation_of(const ScanTrack& track, const ScanDetection& detection);

/// Kalman update of a predicted track. An innovation outside its gate is taken for a sudden change of
/// velocity.
void correct(ScanTrack& track, const ScanDetection& detection, const PerceptionParameters& parameters);

}  // namespace spf
