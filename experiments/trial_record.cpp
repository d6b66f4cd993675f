#include "experiments/trial_record.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace spf {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// Visitor that writes one object.
class RecordWriter {
 public:
  void number(const char* key, double value, Range /*range*/) { json_[key] = number_or_null(value); }
  void maybe_number(const char* key, double value, Range /*range*/) { json_[key] = number_or_null(value); }
  template <class Whole, class... Limits>
  void whole(const char* key, Whole value, Limits... /*limits*/) {
    json_[key] = value;
  }
  void robot(const char* key, int value, int /*least*/) { json_[key] = value; }
  void robot_count(const char* key, int value) { json_[key] = value; }
  void seed(const char* key, std::uint64_t value) { json_[key] = value; }
  void flag(const char* key, bool value) { json_[key] = value; }
  template <class... Limits>
  void text(const char* key, const std::string& value, Limits... /*limits*/) {
    json_[key] = value;
  }
  void digits(const char* key, const std::string& value, std::size_t /*least*/) { json_[key] = value; }
  template <class E>
  void choice(const char* key, E value) {
    json_[key] = enum_name(value);
  }
  template <class E>
  void name(const char* key, const std::string& value) {
    json_[key] = value;
  }
  void histogram(const char* key, const DurationHistogram& value) {
    Json buckets = Json::array();
    for (const auto& [bucket, count] : value.buckets()) buckets.push_back({bucket, count});
    json_[key] = {{"min", number_or_null(value.minimum())},
                  {"max", number_or_null(value.maximum())},
                  {"buckets", buckets}};
  }
  template <class Struct, class... Limits>
  void list(const char* key, const std::vector<Struct>& values, Limits... /*limits*/) {
    Json all = Json::array();
    for (const Struct& value : values) all.push_back(written(value));
    json_[key] = std::move(all);
  }
  template <class Struct>
  void object(const char* key, const std::optional<Struct>& value) {
    json_[key] = written(*value);
  }
  template <class Struct>
  void object_or_null(const char* key, const std::optional<Struct>& value) {
    json_[key] = value ? written(*value) : Json(nullptr);
  }
  template <class Struct>
  void part(const std::optional<Struct>& value) {
    Struct::visit_fields(*value, *this);
  }
  [[nodiscard]] bool present(const char* /*key*/, bool condition) const { return condition; }

  template <class Struct>
  [[nodiscard]] static Json written(const Struct& value) {
    RecordWriter writer;
    Struct::visit_fields(value, writer);
    return std::move(writer.json_);
  }

 private:
  Json json_ = Json::object();
};

}  // namespace

std::string to_json_line(const TrialRecord& record) {
  return RecordWriter::written(record).dump(-1, ' ', false, Json::error_handler_t::replace);
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
