#include "experiments/trial_record.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace spf {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}
Json to_json(const DurationHistogram& histogram) {
  Json buckets = Json::array();
  for (const auto& [bucket, count] : histogram.buckets()) buckets.push_back({bucket, count});
  return {{"min", number(histogram.minimum())}, {"max", number(histogram.maximum())}, {"buckets", buckets}};
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
Json to_json(const CauseRecord& cause) {
  return {{"robot", cause.robot},
          {"last_plan", cause.last_plan},
          {"plan_age", number(cause.plan_age)},
          {"stand_reason", cause.stand_reason},
          {"culprit", cause.culprit}};
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

bool same_result(const TrialRecord& a, const TrialRecord& b) {
  const auto without_timings = [](TrialRecord record) {
    record.plan_time = record.control_time = record.new_plan_time = record.optimiser_time = {};
    record.wall_time = 0.0;
    return to_json_line(record);
  };
  return without_timings(a) == without_timings(b);
}

}  // namespace spf
