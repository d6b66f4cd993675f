#include "spf/perception/scan_detector.hpp"

#include <algorithm>
#include <cmath>

#include "spf/math/index.hpp"
#include "spf/math/plane.hpp"

namespace spf {
namespace {

constexpr int kMostFitted = 48;      // returns used in one fit; more add nothing
constexpr int kMostCorners = 32;     // of one segment; beyond it is cut by length
constexpr double kWalkSigma = 0.05;  // [m] offset of the legs' midpoint from the body's centre

/// Largest distance of a return from the first one [m].
double extent_of(const std::vector<ScanReturn>& returns, const Segment& segment) {
  const Eigen::Vector2d& first = returns[as_index(segment.first)].position_world;
  double squared = 0.0;
  for (int k = 1; k < segment.count; ++k)
    squared = std::max(squared, (returns[as_index(segment.first + k)].position_world - first).squaredNorm());
  return std::sqrt(squared);
}

/// The part [first, last] of a segment; keeps the edges at the segment's ends.
Segment part_between(const Segment& segment, int first, int last) {
  Segment part{first, last - first + 1, SegmentEdge::joined, SegmentEdge::joined};
  if (first == segment.first) part.first_edge = segment.first_edge;
  if (last == segment.first + segment.count - 1) part.last_edge = segment.last_edge;
  return part;
}

/// Rms distance of the returns from their best line (total least squares) [m].
double line_rms(const std::vector<ScanReturn>& returns, const Segment& segment) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int k = 0; k < segment.count; ++k) mean += returns[as_index(segment.first + k)].position_world;
  mean /= segment.count;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (int k = 0; k < segment.count; ++k) {
    const Eigen::Vector2d offset = returns[as_index(segment.first + k)].position_world - mean;
    xx += offset.x() * offset.x();
    xy += offset.x() * offset.y();
    yy += offset.y() * offset.y();
  }
  const double smaller = 0.5 * (xx + yy - std::hypot(xx - yy, 2.0 * xy));
  return std::sqrt(std::max(smaller, 0.0) / segment.count);
}

/// The tangent ray half a step beside a free end of a segment.
TangentRay tangent_beside(const SensorSweep& sweep, const ScanReturn& end, double step, double shape_sigma) {
  TangentRay tangent;
  tangent.ray = sweep.ray(end.beam + 0.5 * step);
  tangent.side = step * sweep.scan->angle_increment < 0.0 ? 1.0 : -1.0;
  const double spacing = end.range * std::abs(sweep.scan->angle_increment);
  tangent.sigma = std::sqrt(spacing * spacing / 12.0 + shape_sigma * shape_sigma) + 1e-4;
  return tangent;
}

}  // namespace

void ScanDetector::run(const SensorSweep& sweep, const Segmentation& segmentation) {
  detections_.clear();
  for (const Segment& segment : segmentation.segments()) {
    if (detections_.size() >= kMostDetections) break;
    detect(sweep, segmentation, segment);
  }
  join_legs(segmentation);
}

/// Returns the fit's rms error [m].
double ScanDetector::fit(const SensorSweep& sweep, const Segmentation& segmentation, double radius,
                         double radius_sigma, ScanDetection& detection) const {
  std::array<ScanReturn, kMostFitted> chosen;
  DiscFitProblem problem;
  detection.returns = 0;
  for (int part = 0; part < detection.part_count; ++part)
    detection.returns += detection.parts[as_index(part)].count;
  const int stride = (detection.returns + kMostFitted - 1) / kMostFitted;
  int number = 0;
  for (int part = 0; part < detection.part_count; ++part) {
    const Segment& segment = detection.parts[as_index(part)];
    for (int k = 0; k < segment.count; ++k, ++number)
      if (number % stride == 0)
        chosen[as_index(problem.count++)] = segmentation.returns()[as_index(segment.first + k)];
  }
  const ScanReturn& middle = chosen[as_index(problem.count / 2)];
  problem.returns = chosen.data();
  problem.sensor_world = sweep.ray(middle.beam).origin_world;
  problem.range_sigma = parameters_.range_sigma;
  problem.prior_radius = radius;
  problem.prior_radius_sigma = radius_sigma;
  const Segment& front = detection.parts[0];
  const Segment& back = detection.parts[as_index(detection.part_count - 1)];
  const ScanReturn& first = segmentation.returns()[as_index(front.first)];
  const ScanReturn& last = segmentation.returns()[as_index(back.first + back.count - 1)];
  if (front.first_edge == SegmentEdge::free)
    problem.tangents[0] = tangent_beside(sweep, first, -1.0, parameters_.shape_sigma);
  if (back.last_edge == SegmentEdge::free)
    problem.tangents[1] = tangent_beside(sweep, last, 1.0, parameters_.shape_sigma);

  const DiscFit disc = fit_disc(problem);
  const double own_error =
      parameters_.shape_sigma * parameters_.shape_sigma + parameters_.pose_sigma * parameters_.pose_sigma;
  detection.kind = ScanDetection::Kind::disc;
  detection.time = sweep.time_of(middle.beam);
  detection.position_world = disc.centre_world;
  detection.covariance = disc.covariance.topLeftCorner<2, 2>() + own_error * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d away = disc.centre_world - problem.sensor_world;
  detection.behind = away / std::max(away.norm(), 1e-9);
  detection.depth = detection.radius = disc.radius;
  detection.radius_variance = disc.covariance(2, 2) + parameters_.shape_sigma * parameters_.shape_sigma;
  return disc.rms;
}

void ScanDetector::refit(const SensorSweep& sweep, const Segmentation& segmentation, double radius,
                         double radius_sigma, ScanDetection& detection) const {
  static_cast<void>(fit(sweep, segmentation, radius, radius_sigma, detection));
}

void ScanDetector::detect(const SensorSweep& sweep, const Segmentation& segmentation,
                          const Segment& segment) {
  const std::vector<ScanReturn>& returns = segmentation.returns();
  const double extent = extent_of(returns, segment);
  if (extent <= 2.0 * parameters_.largest_radius) {
    ScanDetection detection;
    detection.parts[0] = segment;
    const double rms =
        fit(sweep, segmentation, parameters_.prior_radius, parameters_.prior_radius_sigma, detection);
    // A part of a flat face fits a disc too, but one that slides along the face as more of it becomes
    // visible.
    const bool outlined = segment.first_edge == SegmentEdge::free && segment.last_edge == SegmentEdge::free;
    if (!outlined && line_rms(returns, segment) <= std::max(1.25 * parameters_.range_sigma, 1.1 * rms)) {
      detect_pieces(sweep, returns, segment);
      return;
    }
    const bool round = rms <= 2.0 * parameters_.range_sigma && detection.radius <= parameters_.largest_radius;
    if (round || extent <= 2.0 * parameters_.prior_radius) {
      detection.covariance += rms * rms * Eigen::Matrix2d::Identity() / (round ? detection.returns : 1);
      detections_.push_back(detection);
      return;
    }
  }
  detect_faces(sweep, returns, segment);
}

/// Corners by iterative end point fit (Ramer 1972): split at the return farthest from the chord.
void ScanDetector::detect_faces(const SensorSweep& sweep, const std::vector<ScanReturn>& returns,
                                const Segment& segment) {
  const double tolerance = std::max(3.0 * parameters_.range_sigma, 0.25 * parameters_.prior_radius);
  const int end = segment.first + segment.count - 1;
  corners_.assign({segment.first, end});
  std::size_t k = 0;
  while (k + 1 < corners_.size()) {
    const int from = corners_[k];
    const int to = corners_[k + 1];
    const Eigen::Vector2d start = returns[as_index(from)].position_world;
    const Eigen::Vector2d chord = returns[as_index(to)].position_world - start;
    const double length = chord.norm();
    double farthest = tolerance;
    int corner = -1;
    for (int i = from + 1; i < to; ++i) {
      const Eigen::Vector2d offset = returns[as_index(i)].position_world - start;
      const double distance = length > tolerance ? std::abs(cross(chord, offset)) / length : offset.norm();
      if (distance <= farthest) continue;
      farthest = distance;
      corner = i;
    }
    if (corner >= 0 && corners_.size() < kMostCorners) {
      corners_.insert(corners_.begin() + static_cast<std::ptrdiff_t>(k) + 1, corner);
    } else {
      ++k;
    }
  }
  for (std::size_t corner = 0; corner + 1 < corners_.size(); ++corner)
    detect_pieces(sweep, returns,
                  part_between(segment, corners_[corner] + (corner > 0 ? 1 : 0), corners_[corner + 1]));
}

/// Cuts one face into pieces of equal length.
void ScanDetector::detect_pieces(const SensorSweep& sweep, const std::vector<ScanReturn>& returns,
                                 const Segment& face) {
  const int first = face.first;
  const int last = face.first + face.count - 1;
  const double length =
      (returns[as_index(last)].position_world - returns[as_index(first)].position_world).norm();
  const double pieces = std::max(std::ceil(length / parameters_.piece_length), 1.0);
  const double longest = length / pieces + 1e-9;
  int begin = first;
  for (int k = first; k <= last; ++k) {
    const bool beyond =
        (returns[as_index(k)].position_world - returns[as_index(begin)].position_world).norm() > longest &&
        k > begin;
    if (!beyond) continue;
    add_piece(sweep, returns, part_between(face, begin, k - 1));
    begin = k;
  }
  add_piece(sweep, returns, part_between(face, begin, last));
}

/// The centre of a piece lies at a fixed depth behind its face, so that it does not move as more of the face
/// becomes visible; its disc covers the piece and protrudes by a third of the piece's length at most.
void ScanDetector::add_piece(const SensorSweep& sweep, const std::vector<ScanReturn>& returns,
                             const Segment& piece) {
  if (detections_.size() >= kMostDetections || piece.count <= 0) return;
  const int last = piece.first + piece.count - 1;
  const Eigen::Vector2d from = returns[as_index(piece.first)].position_world;
  const Eigen::Vector2d to = returns[as_index(last)].position_world;
  const int middle_beam = returns[as_index((piece.first + last) / 2)].beam;
  const Eigen::Vector2d middle = 0.5 * (from + to);
  const Eigen::Vector2d away = middle - sweep.ray(middle_beam).origin_world;
  const double half = 0.5 * (to - from).norm();
  Eigen::Vector2d along = half > parameters_.range_sigma ? Eigen::Vector2d{to - from} : left_of(away);
  along = along.norm() > 1e-9 ? Eigen::Vector2d{along.normalized()} : Eigen::Vector2d::UnitX();
  ScanDetection detection;
  detection.behind = left_of(along).dot(away) < 0.0 ? Eigen::Vector2d{-left_of(along)} : left_of(along);
  detection.kind = ScanDetection::Kind::face;
  detection.time = sweep.time_of(middle_beam);
  detection.depth = 0.25 * parameters_.piece_length;
  detection.position_world = middle + detection.depth * detection.behind;
  detection.radius = std::hypot(half, detection.depth);
  detection.radius_variance = 0.25 * detection.depth * detection.depth;
  const double own_error =
      parameters_.shape_sigma * parameters_.shape_sigma + parameters_.pose_sigma * parameters_.pose_sigma;
  const double across = parameters_.range_sigma * parameters_.range_sigma / piece.count + own_error;
  // Aperture problem: its ends are those of the cut or of the visible part, so it may be any part of the
  // face.
  const double aperture = 0.25 * parameters_.piece_length * parameters_.piece_length;
  detection.covariance =
      aperture * along * along.transpose() + across * detection.behind * detection.behind.transpose();
  detection.returns = piece.count;
  detection.parts[0] = piece;
  detections_.push_back(detection);
}

/// Two small detections side by side are a person's legs if neither has another candidate.
void ScanDetector::join_legs(const Segmentation& segmentation) {
  find_partners(segmentation);
  const int count = static_cast<int>(detections_.size());
  int kept = 0;
  for (int k = 0; k < count; ++k) {
    const int partner = partner_[as_index(k)];
    const bool pair = partner >= 0 && partner_[as_index(partner)] == k;
    if (pair && partner < k) continue;  // joined already
    if (kept != k) detections_[as_index(kept)] = detections_[as_index(k)];
    if (pair) join(detections_[as_index(partner)], detections_[as_index(kept)]);
    ++kept;
  }
  detections_.resize(as_index(kept));
}

/// Into partner_: for each leg the only other one within reach; -1 = none, -2 = several.
void ScanDetector::find_partners(const Segmentation& segmentation) {
  constexpr std::size_t kNeighbours = 4;  // in the order of beams
  const auto leg = [&](const ScanDetection& detection) {
    return detection.kind == ScanDetection::Kind::disc && 2.0 * detection.radius <= parameters_.leg_width &&
           extent_of(segmentation.returns(), detection.parts[0]) <= parameters_.leg_width;
  };
  const auto note = [this](std::size_t one, std::size_t other) {
    const bool only = partner_[one] == -1 || partner_[one] == static_cast<int>(other);
    partner_[one] = only ? static_cast<int>(other) : -2;
  };
  const std::size_t count = detections_.size();
  partner_.assign(count, -1);
  for (std::size_t k = 0; k < count; ++k) {
    if (!leg(detections_[k])) continue;
    for (std::size_t step = 1; step <= kNeighbours && step < count; ++step) {
      const std::size_t other = (k + step) % count;  // the last is a neighbour of the first
      if (!leg(detections_[other])) continue;
      if ((detections_[other].position_world - detections_[k].position_world).norm() > parameters_.leg_gap)
        continue;
      note(k, other);
      note(other, k);
    }
  }
}

/// Makes a person of one leg and the other.
void ScanDetector::join(const ScanDetection& other, ScanDetection& person) const {
  const double gap = (other.position_world - person.position_world).norm();
  person.kind = ScanDetection::Kind::legs;
  person.depth = 0.5 * (person.depth + other.depth);
  person.position_world = 0.5 * (person.position_world + other.position_world);
  person.covariance =
      0.25 * (person.covariance + other.covariance) + kWalkSigma * kWalkSigma * Eigen::Matrix2d::Identity();
  person.radius =
      std::max(0.5 * gap + std::max(person.radius, other.radius), 2.0 / 3.0 * parameters_.prior_radius);
  person.radius_variance = 0.25 * (person.radius_variance + other.radius_variance) + kWalkSigma * kWalkSigma;
  person.returns += other.returns;
  person.parts[1] = other.parts[0];
  person.part_count = 2;
}

}  // namespace spf
