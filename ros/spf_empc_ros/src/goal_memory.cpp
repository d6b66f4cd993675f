#include "spf_empc_ros/goal_memory.hpp"

#include <ros/console.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace spf_empc_ros {
namespace {

using Value = XmlRpc::XmlRpcValue;

constexpr const char* kGoal = "kept_goal";
constexpr const char* kHeard = "heard_goal";
const ros::WallDuration kSignsOfLife{1.0};
constexpr double kLatestStamp = 4294967295.0;  // [s] that ros::Time can hold
constexpr std::size_t kMostPublishers = 32;    // of goals that are remembered

// XmlRpcValue's operators are not const.
std::optional<double> number_of(Value& goal, const char* key) {
  if (!goal.hasMember(key) || goal[key].getType() != Value::TypeDouble) return std::nullopt;
  return static_cast<double>(goal[key]);
}

std::string text_of(Value& goal, const char* key) {
  if (!goal.hasMember(key) || goal[key].getType() != Value::TypeString) return {};
  return static_cast<std::string>(goal[key]);
}

using Publishers = std::map<std::string, std::string>;  // the last message of each

/// A line for each publisher, whose name has no spaces.
std::string lines_of(const Publishers& publishers) {
  std::string lines;
  for (const auto& [name, message] : publishers) lines += name + ' ' + message + '\n';
  return lines;
}

Publishers publishers_of(const std::string& lines) {
  Publishers publishers;
  std::istringstream text{lines};
  std::string name, message;
  while (text >> name && std::getline(text >> std::ws, message)) publishers[name] = message;
  return publishers;
}

}  // namespace

GoalMemory::GoalMemory(const ros::NodeHandle& own, ParameterStore& store, const std::string& frame,
                       double longest_absence)
    : store_{store}, frame_{frame}, longest_absence_{longest_absence} {
  own.getParam(kGoal, left_);
  std::string heard;
  own.getParam(kHeard, heard);
  before_ = publishers_of(heard);
}

std::optional<RememberedGoal> GoalMemory::left() const {
  if (left_.getType() != Value::TypeStruct) return std::nullopt;
  Value left = left_;
  const auto x = number_of(left, "x");
  const auto y = number_of(left, "y");
  const auto heading = number_of(left, "heading");
  const auto alive = number_of(left, "alive");
  if (!x || !y || !heading || !alive || text_of(left, "frame") != frame_) return std::nullopt;
  const double absence = ros::WallTime::now().toSec() - *alive;
  if (!(std::abs(absence) <= longest_absence_)) {
    ROS_WARN("not taking up the goal (%.2f, %.2f) again: this robot was away for %.0f s", *x, *y, absence);
    return std::nullopt;
  }
  RememberedGoal remembered{{{*x, *y}, *heading}, {}};
  remembered.id.id = text_of(left, "id");
  const double stamp = number_of(left, "stamp").value_or(0.0);
  if (stamp >= 0.0 && stamp < kLatestStamp) remembered.id.stamp = ros::Time{stamp};
  return remembered;
}

void GoalMemory::keep(const RememberedGoal& remembered) {
  kept_.clear();
  kept_["x"] = remembered.goal.position_world.x();
  kept_["y"] = remembered.goal.position_world.y();
  kept_["heading"] = remembered.goal.heading.value_or(0.0);
  kept_["frame"] = frame_;
  kept_["id"] = remembered.id.id;
  kept_["stamp"] = remembered.id.stamp.toSec();
  next_sign_of_life_ = {};
  refresh();
}

void GoalMemory::refresh() {
  const ros::WallTime now = ros::WallTime::now();
  if (!kept_.valid() || now < next_sign_of_life_) return;
  next_sign_of_life_ = now + kSignsOfLife;
  kept_["alive"] = now.toSec();
  store_.set(kGoal, kept_);
}

void GoalMemory::forget() {
  kept_.clear();
  store_.erase(kGoal);
}

bool GoalMemory::heard_before(const geometry_msgs::PoseStamped& goal, const std::string& publisher) {
  std::ostringstream text;
  text << std::setprecision(17) << goal.header.stamp << ' ' << goal.pose.position.x << ' '
       << goal.pose.position.y << ' ' << goal.pose.orientation.z << ' ' << goal.pose.orientation.w;
  const std::string message = text.str();
  const auto found = before_.find(publisher);
  const bool before = found != before_.end() && found->second == message;
  if (found != before_.end()) before_.erase(found);  // from now on messages of this publisher are new ones
  heard_[publisher] = message;
  if (heard_.size() > kMostPublishers) heard_.erase(heard_.begin());
  store_.set(kHeard, lines_of(heard_));
  return before;
}

}  // namespace spf_empc_ros
