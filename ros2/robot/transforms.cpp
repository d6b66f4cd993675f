#include "ros2/robot/transforms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace spf_ros2 {
namespace {

using ros2::Nanoseconds;
using spf::wire::plain_frame;

constexpr std::size_t kMostSamples = 10'000;  // of one frame: a thousand a second
constexpr std::size_t kLongestChain = 100;

}  // namespace

SpacePose operator*(const SpacePose& outer, const SpacePose& inner) {
  return {outer.position + outer.orientation * inner.position, outer.orientation * inner.orientation};
}

SpacePose inverse(const SpacePose& pose) {
  const Eigen::Quaterniond turned = pose.orientation.conjugate();
  return {-(turned * pose.position), turned};
}

bool Transforms::add(const ros2::geometry_msgs::TransformStamped& transform, bool is_static) {
  const auto& to = transform.transform;
  const SpacePose pose{{to.translation.x, to.translation.y, to.translation.z},
                       {to.rotation.w, to.rotation.x, to.rotation.y, to.rotation.z}};
  const double norm = pose.orientation.norm();
  const std::string parent = plain_frame(transform.header.frame_id);
  const std::string child = plain_frame(transform.child_frame_id);
  if (!pose.position.allFinite() || !(norm > 0.9 && norm < 1.1) || parent.empty() || child.empty() ||
      parent == child)
    return false;
  if (frames_.size() >= kMostFrames && frames_.count(child) == 0) return false;
  Frame& frame = frames_[child];
  const Nanoseconds time = ros2::nanoseconds_of(transform.header.stamp);
  const bool jumped = !frame.samples.empty() && time < frame.samples.back().time - kMemory;
  if (frame.parent != parent || frame.is_static || is_static || jumped) frame.samples.clear();
  frame.parent = parent;
  frame.is_static = is_static;
  const auto later =
      std::upper_bound(frame.samples.begin(), frame.samples.end(), time,
                       [](Nanoseconds asked, const Sample& sample) { return asked < sample.time; });
  frame.samples.insert(later, {time, {pose.position, pose.orientation.normalized()}});
  while (frame.samples.size() > kMostSamples ||
         frame.samples.front().time < frame.samples.back().time - kMemory)
    frame.samples.pop_front();
  return true;
}

/// The way from a frame to the root of its tree.
struct Transforms::Chain {
  std::vector<std::pair<std::string, const Frame*>> links;
  std::string root;
};

Transforms::Chain Transforms::chain_of(const std::string& frame) const {
  Chain chain;
  chain.root = frame;
  for (auto found = frames_.find(frame); found != frames_.end() && chain.links.size() < kLongestChain;
       found = frames_.find(chain.root)) {
    chain.links.emplace_back(found->first, &found->second);
    chain.root = found->second.parent;
  }
  return chain;
}

spf::wire::Converted<Transforms::Found> Transforms::find(const std::string& frame, const std::string& in,
                                                         std::optional<Nanoseconds> time) const {
  using Result = spf::wire::Converted<Found>;
  Chain from = chain_of(plain_frame(frame));
  Chain to = chain_of(plain_frame(in));
  if (from.root != to.root)
    return Result::refused("no transform leads from '" + plain_frame(frame) + "' to '" + plain_frame(in) +
                           "'");
  while (!from.links.empty() && !to.links.empty() && from.links.back().first == to.links.back().first) {
    from.links.pop_back();
    to.links.pop_back();
  }
  // The newest time that all on the way know, and whether they know the one that was asked for.
  Nanoseconds newest = std::numeric_limits<Nanoseconds>::max();
  bool known = time.has_value();
  for (const Chain* chain : {&from, &to})
    for (const auto& [name, link] : chain->links) {
      if (link->is_static) continue;
      newest = std::min(newest, link->samples.back().time);
      known = known && link->samples.front().time <= *time && *time <= link->samples.back().time;
    }
  Found found;
  found.never_changes = newest == std::numeric_limits<Nanoseconds>::max();
  found.time = known ? *time : found.never_changes ? 0 : newest;
  const auto pose_at = [&](const Frame& link) {
    const auto& samples = link.samples;
    const auto after =
        std::lower_bound(samples.begin(), samples.end(), found.time,
                         [](const Sample& sample, Nanoseconds asked) { return sample.time < asked; });
    if (link.is_static || after == samples.begin()) return samples.front().pose;
    if (after == samples.end()) return samples.back().pose;
    const Sample& before = *std::prev(after);
    const double share =
        static_cast<double>(found.time - before.time) / static_cast<double>(after->time - before.time);
    return SpacePose{before.pose.position + share * (after->pose.position - before.pose.position),
                     before.pose.orientation.slerp(share, after->pose.orientation)};
  };
  SpacePose up, down;
  for (const auto& [name, link] : from.links) up = pose_at(*link) * up;
  for (const auto& [name, link] : to.links) down = pose_at(*link) * down;
  found.pose = inverse(down) * up;
  return {found, {}};
}

}  // namespace spf_ros2
