#include "spf/team/right_of_way.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "spf/math/plane.hpp"
#include "spf/math/segment.hpp"

namespace spf {
namespace {

constexpr double kClaimTime = 4.0;  // [s] before it gets there a robot claims a passage
constexpr double kPassing = 1.0;    // [1] of the radius: wanted beyond two robots to pass each other
constexpr double kSpacing = 0.5;    // [1] of the radius, between looks
constexpr double kWaitAt = 6.0;     // [1] of the radius: from where it waits to the entry, for what comes out
constexpr double kBatch =
    6.0;  // [s] who claims so much later than the first from the other side waits for it
constexpr double kNoShow = 8.0;      // [s] who stands so long though it may go is not waited for
constexpr double kMeanwhile = 0.5;   // [s] left between one who gets through first and the next
constexpr double kStalemate = 25.0;  // [s] when both sides wait for so long the earlier goes
constexpr double kNextAt = 1.0;      // [1] likewise of the next in a queue
constexpr double kJoined = 8.0;      // [1] of the radius: narrow passages that near each other are one
constexpr double kLongest = 100.0;   // [1] of the radius: of a long passage no more is looked at at a time
constexpr std::array<double, 5> kTurns{0.0, -0.5, 0.5, -1.0, 1.0};  // [rad] from square across the path

}  // namespace

bool RightOfWay::earlier(const Turn& one, const Turn& other) {
  if (one.rank.priority == other.rank.priority && one.since != other.since) return one.since < other.since;
  return goes_first(one.rank, other.rank);
}

/// Whether a robot goes along with those of its direction before the first of the other one.
bool RightOfWay::in_batch(const Turn& turn, const Turn& other) {
  return turn.rank.priority <= other.rank.priority && turn.since < other.since + kBatch;
}

void RightOfWay::stop() {
  if (claim_ && claim_->inside)
    give_way_.reset();
  else
    clear();
}

void RightOfWay::clear() {
  claim_.reset();
  give_way_.reset();
  with_turn_ = Side::unknown;
}

double RightOfWay::claim_distance() const {
  return robot_.max_speed * (kClaimTime + 0.5 * robot_.max_speed / robot_.max_acceleration) +
         kWaitAt * robot_.radius;
}

/// How far the robot's centre can be moved in a direction before its body touches a surface [m].
double RightOfWay::side_room(const OccupancyMap& map, const Eigen::Vector2d& position,
                             const Eigen::Vector2d& direction, double enough) const {
  const double least_step = 0.1 * robot_.radius;
  double moved = 0.0;
  while (moved < enough) {
    const double room = map.distance(position + moved * direction) - robot_.radius;
    if (room <= 0.0) return moved;
    moved += std::max(room, least_step);
  }
  return enough;
}

/// Unit vector through a passage that two robots cannot pass side by side, in the direction of `along`.
std::optional<Eigen::Vector2d> RightOfWay::narrow_axis(const OccupancyMap& map,
                                                       const Eigen::Vector2d& position,
                                                       const Eigen::Vector2d& along) const {
  const double needed = 2.0 * peer_radius_ + kPassing * robot_.radius;
  if (map.distance(position) >= robot_.radius + 0.5 * needed) return std::nullopt;
  double least = needed;
  std::optional<Eigen::Vector2d> axis;
  for (const double turn : kTurns) {
    const Eigen::Vector2d forward{std::cos(turn) * along.x() - std::sin(turn) * along.y(),
                                  std::sin(turn) * along.x() + std::cos(turn) * along.y()};
    const Eigen::Vector2d left = left_of(forward);
    const double on_left = side_room(map, position, left, least);
    const double width = on_left + side_room(map, position, -left, least - on_left);
    if (width >= least) continue;
    least = width;
    axis = forward;
  }
  return axis;
}

std::optional<RightOfWay::Narrow> RightOfWay::next_narrow(const Eigen::Vector2d& here, const CostToGo& guide,
                                                          const OccupancyMap& map) {
  guide.shortest_path(here, path_);
  const double spacing = kSpacing * robot_.radius;
  std::optional<Narrow> narrow;
  double last = 0.0;   // [m] ahead, of the last narrow passage
  double ahead = 0.0;  // [m] to the leg
  for (std::size_t i = 1; i < path_.size(); ++i) {
    const Eigen::Vector2d leg = path_[i] - path_[i - 1];
    const double length = leg.norm();
    if (!(length > 0.0)) continue;
    const Eigen::Vector2d along = leg / length;
    for (double at = 0.0; at < length; at += spacing) {
      const double distance = ahead + at;
      if (!narrow && distance > claim_distance()) return std::nullopt;
      const bool far = narrow && distance > narrow->ahead + kLongest * robot_.radius;
      if (far || (narrow && distance > last + kJoined * robot_.radius)) return narrow;
      const Eigen::Vector2d position = path_[i - 1] + at * along;
      const std::optional<Eigen::Vector2d> axis = narrow_axis(map, position, along);
      if (!axis) continue;
      if (!narrow) narrow = Narrow{position - spacing * *axis, position, distance - spacing, distance};
      narrow->exit = position + spacing * *axis;
      narrow->through = distance + spacing;
      last = distance;
    }
    ahead += length;
  }
  return narrow;
}

/// The claim stays that of the first look as long as it is the same passage, and until the body is out of it.
void RightOfWay::renew_claim(double time, const Eigen::Vector2d& here, const std::optional<Narrow>& narrow) {
  if (claim_) {
    const Eigen::Vector2d axis = claim_->exit_world - claim_->entry_world;
    const double progress = (here - claim_->entry_world).dot(axis) / std::max(axis.squaredNorm(), 1e-12);
    const bool same = narrow && axis.dot(narrow->exit - narrow->entry) > 0.0 &&
                      distance_between_segments({claim_->entry_world, claim_->exit_world},
                                                {narrow->entry, narrow->exit}) < robot_.radius;
    const bool beside =
        distance_to_segment(here, {claim_->entry_world, claim_->exit_world}) < 2.0 * robot_.radius;
    if (same) {
      if (narrow->ahead > 0.0) claim_->entry_world = narrow->entry;
      claim_->exit_world = narrow->exit;
      claim_->inside = narrow->ahead <= 0.0;
    } else if (narrow || !claim_->inside || progress > 1.0 || !beside) {
      clear();
    }
  }
  if (!claim_ && narrow)
    claim_ = PassageClaim{narrow->entry, narrow->exit, time, narrow->ahead <= 0.0, false};
}

/// Who else wants to go through the passage that the robot claims. One that has stood for long though it may
/// go is left to the guide and to the planner's risks.
RightOfWay::Rivals RightOfWay::rivals(const WorldSnapshot& world, double time) const {
  Rivals rivals;
  rivals.with = {world.rank(), claim_->since};
  rivals.inside_with = claim_->inside;
  for (const Peer& peer : *world.peers) {
    if (!meets(peer, time) || (!peer.claim->waits && peer.stood > kNoShow)) continue;
    const PassageClaim& claim = *peer.claim;
    const Turn turn{peer.rank(), claim.since};
    if (goes_same_way(claim)) {
      rivals.inside_with = rivals.inside_with || claim.inside;
      if (earlier(turn, rivals.with)) rivals.with = turn;
      continue;
    }
    const double gap = (peer.position(time) - claim.entry_world).norm();
    if (!rivals.against || gap < rivals.against_gap) rivals.against_gap = gap;
    rivals.stalemate = rivals.stalemate || (claim.waits && peer.stood > kStalemate);
    if (!rivals.against || earlier(turn, *rivals.against)) rivals.against = turn;
    if (claim.inside && (!rivals.inside_against || earlier(turn, *rivals.inside_against)))
      rivals.inside_against = turn;
  }
  return rivals;
}

/// Counts those that go the same way, in the same turn, and are nearer to the entry.
void RightOfWay::look_in_front(const WorldSnapshot& world, double time, const Eigen::Vector2d& here,
                               Rivals& rivals) const {
  const double own_gap = (here - claim_->entry_world).norm();
  for (const Peer& peer : *world.peers) {
    if (!meets(peer, time) || peer.claim->inside || !goes_same_way(*peer.claim)) continue;
    if (!peer.claim->waits && peer.stood > kNoShow) continue;
    if (rivals.against && !in_batch({peer.rank(), peer.claim->since}, *rivals.against)) continue;
    const double gap = (peer.position(time) - claim_->entry_world).norm();
    if (gap > own_gap || (gap == own_gap && peer.robot_id > world.robot_id)) continue;
    ++rivals.nearer;
    rivals.in_front = peer.robot_id;
  }
}

/// Whether the robot's direction goes first where nobody is inside. One direction goes on as long as somebody
/// wants to go that way who came not long after the first from the other side.
bool RightOfWay::own_side_goes(const Rivals& rivals) const {
  if (rivals.stalemate || with_turn_ == Side::unknown) return earlier(rivals.with, *rivals.against);
  return with_turn_ == Side::own ? in_batch(rivals.with, *rivals.against)
                                 : !in_batch(*rivals.against, rivals.with);
}

/// Whether the robot is out of the passage before one from the other side, so far from it, can be there.
bool RightOfWay::through_before(double gap, const Narrow& narrow) const {
  const double start = robot_.max_speed / robot_.max_acceleration;
  return narrow.through / robot_.max_speed + start + kMeanwhile < gap / robot_.max_speed;
}

/// The peer whose turn it is, -1: it is the robot's own.
int RightOfWay::whom_to_let_pass(const WorldSnapshot& world, double time, const Eigen::Vector2d& here,
                                 const Narrow& narrow) {
  Rivals now = rivals(world, time);
  wait_at_ = kWaitAt;
  queues_ = false;
  const Turn mine{world.rank(), claim_->since};
  if (now.inside_with) with_turn_ = Side::own;
  if (now.inside_against) {
    if (claim_->inside && earlier(mine, *now.inside_against))
      return -1;  // of two inside the later one backs out
    if (!claim_->inside) with_turn_ = Side::other;
    return now.inside_against->rank.robot_id;
  }
  if (claim_->inside) return -1;
  const bool turn = !now.against || (own_side_goes(now) && in_batch(mine, *now.against));
  if (!turn && !through_before(now.against_gap, narrow)) return now.against->rank.robot_id;
  // One enters, the next is ready, the others leave them room.
  look_in_front(world, time, here, now);
  if (now.nearer == 1) wait_at_ = kNextAt;
  queues_ = true;
  return now.in_front;
}

/// Whether a peer claims the same passage, and is where it may.
bool RightOfWay::meets(const Peer& peer, double time) const {
  if (peer.claim == nullptr || peer.expired) return false;
  const PassageClaim& claim = *peer.claim;
  const double farthest = (kLongest + 2.0 * kWaitAt) * std::max(robot_.radius, peer.radius);
  if ((claim.exit_world - claim.entry_world).norm() > farthest) return false;
  if ((claim.entry_world - peer.position(time)).norm() > farthest) return false;
  return distance_between_segments({claim_->entry_world, claim_->exit_world},
                                   {claim.entry_world, claim.exit_world}) < robot_.radius + peer.radius;
}

bool RightOfWay::goes_same_way(const PassageClaim& other) const {
  return (claim_->exit_world - claim_->entry_world).dot(other.exit_world - other.entry_world) > 0.0;
}

void RightOfWay::update(double time, const Eigen::Vector2d& here, const CostToGo& guide,
                        const WorldSnapshot& world) {
  give_way_.reset();
  peer_radius_ = 0.0;
  const double near = 2.0 * claim_distance();
  if (world.peers != nullptr)
    for (const Peer& peer : *world.peers)
      if (!peer.expired && (peer.position(time) - here).norm() < near)
        peer_radius_ = std::max(peer_radius_, peer.radius);
  const bool leads_on = guide.ready() && guide.outcome() != CostToGoOutcome::unreachable &&
                        guide.cost_to_go(here) > robot_.radius;
  if (peer_radius_ <= 0.0 || !leads_on) {
    clear();
    return;
  }
  const std::optional<Narrow> narrow = next_narrow(here, guide, *world.map);
  renew_claim(time, here, narrow);
  if (!claim_ || !narrow) return;
  const int peer = whom_to_let_pass(world, time, here, *narrow);
  claim_->waits = gives_way_ && peer >= 0 && !queues_;
  if (peer < 0) return;
  // As far before the entry as it takes to let others out; from nearer it steps back.
  const double ahead = claim_->inside ? -(here - claim_->entry_world).norm() : narrow->ahead;
  const double stop = ahead - wait_at_ * robot_.radius;
  give_way_ = GiveWay{std::max(guide.cost_to_go(here) - stop, 0.0), peer};
}

}  // namespace spf
