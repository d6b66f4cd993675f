#include "mcap/recording.hpp"

#include <nlohmann/json.hpp>

namespace spf::mcap {

void Recording::add_json(const std::string& topic, const std::string& schema, double time,
                         const nlohmann::json& object) {
  auto known = channels_.find(topic);
  if (known == channels_.end()) {
    const Writer::Id id = writer_.add_schema({schema, "jsonschema", R"({"type": "object"})"});
    known = channels_.emplace(topic, writer_.add_channel(id, topic, "json")).first;
  }
  writer_.write(known->second, clock_.nanoseconds(time), object.dump());
}

}  // namespace spf::mcap
