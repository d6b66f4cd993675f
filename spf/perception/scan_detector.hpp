// Segments of unmasked returns to detections: discs, pairs of legs, pieces of faces. Frame: world.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "spf/perception/disc_fit.hpp"
#include "spf/perception/perception_parameters.hpp"
#include "spf/perception/segmentation.hpp"

namespace spf {

/// Further detections of a sweep are dropped.
inline constexpr std::size_t kMostDetections = 1000;

/// Memory reserved at first for detections and tracks; it grows when there are more.
inline constexpr std::size_t kUsualThings = 64;

/// One object, or a piece of one, as seen in one sweep.
struct ScanDetection {
  enum class Kind {
    disc,  ///< a compact object
    legs,  ///< two legs of one person
    face,  ///< a piece of a large flat object: its position along the face is uncertain
  };
  static constexpr int kMostParts = 4;

  Kind kind = Kind::disc;
  double time = 0.0;                                         ///< [s] when its middle beam was taken
  Eigen::Vector2d position_world = Eigen::Vector2d::Zero();  ///< [m] centre
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< [m^2] of the centre
  Eigen::Vector2d behind = Eigen::Vector2d::UnitX();         ///< unit vector from the visible surface inwards
  double depth = 0.0;                                        ///< [m] of the centre behind the surface
  double radius = 0.0;                                       ///< [m]
  double radius_variance = 0.0;                              ///< [m^2]
  double free_share = 0.0;  ///< [1] share of its returns in space seen free before
  int returns = 0;          ///< of all parts
  int part_count = 1;
  std::array<Segment, kMostParts> parts;

  /// Compact, and not joined to a surface that goes on beside it.
  [[nodiscard]] bool isolated() const {
    return kind != Kind::face && parts[0].first_edge != SegmentEdge::joined &&
           parts[static_cast<std::size_t>(part_count - 1)].last_edge != SegmentEdge::joined;
  }
};

class ScanDetector {
 public:
  explicit ScanDetector(const PerceptionParameters& parameters) : parameters_{parameters} {
    detections_.reserve(kUsualThings);
    partner_.reserve(kUsualThings);
    corners_.reserve(kUsualThings);
  }

  void run(const SensorSweep& sweep, const Segmentation& segmentation);
  /// In the order of beams. The caller may change them until the next run.
  [[nodiscard]] std::vector<ScanDetection>& detections() { return detections_; }

  /// Fits a disc again, to all parts of a detection and with a better prior of its radius.
  void refit(const SensorSweep& sweep, const Segmentation& segmentation, double radius, double radius_sigma,
             ScanDetection& detection) const;

 private:
  [[nodiscard]] double fit(const SensorSweep& sweep, const Segmentation& segmentation, double radius,
                           double radius_sigma, ScanDetection& detection) const;
  void detect(const SensorSweep& sweep, const Segmentation& segmentation, const Segment& segment);
  void detect_faces(const SensorSweep& sweep, const std::vector<ScanReturn>& returns, const Segment& segment);
  void detect_pieces(const SensorSweep& sweep, const std::vector<ScanReturn>& returns, const Segment& face);
  void add_piece(const SensorSweep& sweep, const std::vector<ScanReturn>& returns, const Segment& piece);
  void join_legs(const Segmentation& segmentation);
  void find_partners(const Segmentation& segmentation);
  void join(const ScanDetection& other, ScanDetection& person) const;

  PerceptionParameters parameters_;
  std::vector<ScanDetection> detections_;
  std::vector<int> corners_;  // of the current segment
  std::vector<int> partner_;  // of each detection: the other leg, -1 = none, -2 = several
};

}  // namespace spf
