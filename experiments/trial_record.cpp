#include "experiments/trial_record.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "config/input_problem.hpp"

namespace spf {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
double number_at(const Json& json, const char* name) {
  const Json& value = json.at(name);
  return value.is_null() ? kNotKnown : value.get<double>();
}

Json to_json(const DurationHistogram& histogram) {
  Json buckets = Json::array();
  for (const auto& [bucket, count] : histogram.buckets()) buckets.push_back({bucket, count});
  return {{"min", number(histogram.minimum())}, {"max", number(histogram.maximum())}, {"buckets", buckets}};
}
DurationHistogram histogram_at(const Json& json, const char* name) {
  const Json& value = json.at(name);
  std::map<int, std::int64_t> buckets;
  for (const Json& bucket : value.at("buckets"))
    buckets[bucket.at(0).get<int>()] = bucket.at(1).get<std::int64_t>();
  return DurationHistogram::from_buckets(std::move(buckets), number_at(value, "min"),
                                         number_at(value, "max"));
}

Json to_json(const RobotRecord& robot) {
  return {{"arrived", robot.arrived},
          {"path_length", number(robot.path_length)},
          {"travel_time", number(robot.travel_time)},
          {"path_length_ratio", number(robot.path_length_ratio)},
          {"travel_time_ratio", number(robot.travel_time_ratio)},
          {"plans", robot.plans},
          {"failed_plans", robot.failed_plans},
          {"optimiser_calls", robot.optimiser_calls},
          {"inner_iterations", robot.inner_iterations}};
}
RobotRecord robot_from_json(const Json& json) {
  RobotRecord robot;
  robot.arrived = json.at("arrived").get<bool>();
  robot.path_length = number_at(json, "path_length");
  robot.travel_time = number_at(json, "travel_time");
  robot.path_length_ratio = number_at(json, "path_length_ratio");
  robot.travel_time_ratio = number_at(json, "travel_time_ratio");
  robot.plans = json.at("plans").get<std::int64_t>();
  robot.failed_plans = json.at("failed_plans").get<std::int64_t>();
  robot.optimiser_calls = json.at("optimiser_calls").get<std::int64_t>();
  robot.inner_iterations = json.at("inner_iterations").get<std::int64_t>();
  return robot;
}

Json to_json(const ContactRecord& contact) {
  return {{"time", number(contact.time)},
          {"robot", contact.robot},
          {"with", contact.with},
          {"other", contact.other},
          {"x", number(contact.position.x())},
          {"y", number(contact.position.y())},
          {"robot_speed", number(contact.robot_speed)},
          {"other_speed", number(contact.other_speed)}};
}
ContactRecord contact_from_json(const Json& json) {
  ContactRecord contact;
  contact.time = number_at(json, "time");
  contact.robot = json.at("robot").get<int>();
  contact.with = json.at("with").get<std::string>();
  contact.other = json.at("other").get<int>();
  contact.position = {number_at(json, "x"), number_at(json, "y")};
  contact.robot_speed = number_at(json, "robot_speed");
  contact.other_speed = number_at(json, "other_speed");
  return contact;
}

Json to_json(const CauseRecord& cause) {
  return {{"robot", cause.robot},
          {"last_plan", cause.last_plan},
          {"plan_age", number(cause.plan_age)},
          {"stand_reason", cause.stand_reason},
          {"culprit", cause.culprit}};
}
CauseRecord cause_from_json(const Json& json) {
  CauseRecord cause;
  cause.robot = json.at("robot").get<int>();
  cause.last_plan = json.at("last_plan").get<std::string>();
  cause.plan_age = number_at(json, "plan_age");
  cause.stand_reason = json.at("stand_reason").get<std::string>();
  cause.culprit = json.at("culprit").get<int>();
  return cause;
}

CrossingRecord crossing_from_json(const Json& json) {
  CrossingRecord crossing;
  crossing.crossings = json.at("crossings").get<int>();
  crossing.crossings_ok = json.at("crossings_ok").get<int>();
  crossing.contacts_moving = json.at("contacts_moving").get<int>();
  crossing.robot_minutes = number_at(json, "robot_minutes");
  return crossing;
}

sim::TrialOutcome outcome_at(const Json& json) {
  const std::string name = json.at("outcome").get<std::string>();
  for (const auto& [outcome, known] : EnumNames<sim::TrialOutcome>::values)
    if (name == known) return outcome;
  throw Json::other_error::create(501, "outcome '" + name + "' is not known", nullptr);
}

TrialRecord record_from_json(const Json& json) {
  TrialRecord record;
  record.key.family = json.at("family").get<std::string>();
  record.key.method = json.at("method").get<std::string>();
  record.key.noise = json.at("noise").get<std::string>();
  record.key.level = number_at(json, "level");
  record.key.tracking = json.at("tracking").get<std::string>();
  record.key.seed = json.at("seed").get<std::uint64_t>();
  record.key.trial = json.at("trial").get<int>();
  record.key.condition = json.value("condition", "");
  record.setup = json.value("setup", "");
  if (json.contains("new_plan_time")) record.new_plan_time = histogram_at(json, "new_plan_time");
  if (json.contains("optimiser_time")) record.optimiser_time = histogram_at(json, "optimiser_time");
  if (json.contains("wheel_share")) record.wheel_share = number_at(json, "wheel_share");
  if (json.contains("crossings")) record.crossing = crossing_from_json(json);
  if (json.contains("cause")) record.cause = cause_from_json(json.at("cause"));
  record.outcome = outcome_at(json);
  record.failure = json.at("failure").get<std::string>();
  if (!json.at("contact").is_null()) record.contact = contact_from_json(json.at("contact"));
  record.contacts = json.at("contacts").get<int>();
  record.hits_while_standing = json.at("hits_while_standing").get<int>();
  record.sim_time = number_at(json, "sim_time");
  record.digest = json.at("digest").get<std::string>();
  record.dynamic_distance = number_at(json, "dynamic_distance");
  record.dynamic_clearance = number_at(json, "dynamic_clearance");
  for (const Json& robot : json.at("robots")) record.robots.push_back(robot_from_json(robot));
  record.plan_time = histogram_at(json, "plan_time");
  record.control_time = histogram_at(json, "control_time");
  record.wall_time = number_at(json, "wall_time");
  return record;
}

}  // namespace

std::string to_json_line(const TrialRecord& record) {
  Json robots = Json::array();
  for (const RobotRecord& robot : record.robots) robots.push_back(to_json(robot));
  Json json{{"family", record.key.family},
            {"method", record.key.method},
            {"noise", record.key.noise},
            {"level", number(record.key.level)},
            {"tracking", record.key.tracking},
            {"seed", record.key.seed},
            {"trial", record.key.trial},
            {"outcome", enum_name(record.outcome)},
            {"failure", record.failure},
            {"contact", record.contact ? to_json(*record.contact) : Json(nullptr)},
            {"contacts", record.contacts},
            {"hits_while_standing", record.hits_while_standing},
            {"sim_time", number(record.sim_time)},
            {"dynamic_distance", number(record.dynamic_distance)},
            {"dynamic_clearance", number(record.dynamic_clearance)},
            {"robots", robots},
            {"digest", record.digest},
            {"plan_time", to_json(record.plan_time)},
            {"control_time", to_json(record.control_time)},
            {"wall_time", number(record.wall_time)}};
  if (record.crossing) {  // only of PED
    json["crossings"] = record.crossing->crossings;
    json["crossings_ok"] = record.crossing->crossings_ok;
    json["contacts_moving"] = record.crossing->contacts_moving;
    json["robot_minutes"] = number(record.crossing->robot_minutes);
  }
  // Only campaigns have these.
  if (!record.key.condition.empty()) json["condition"] = record.key.condition;
  if (!record.setup.empty()) json["setup"] = record.setup;
  if (std::isfinite(record.wheel_share)) json["wheel_share"] = record.wheel_share;
  if (record.new_plan_time.count() > 0) json["new_plan_time"] = to_json(record.new_plan_time);
  if (record.optimiser_time.count() > 0) json["optimiser_time"] = to_json(record.optimiser_time);
  if (record.cause) json["cause"] = to_json(*record.cause);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

TrialRecord trial_record_from_json(const std::string& text, const std::string& source, int line) {
  try {
    return record_from_json(Json::parse(text));
  } catch (const nlohmann::json::exception& error) {
    throw InputError{{source, line, 0}, std::string{"is no line of trial results: "} + error.what()};
  }
}

}  // namespace spf
