// What makes two configurations the same, wherever their files lie.
#include <cstdint>
#include <cstring>

#include "config/parameter_text.hpp"
#include "spf/math/random_stream.hpp"
#include "study/scenario_file.hpp"

namespace spf {
namespace {

/// A number that differs when the numbers do that are added one after the other.
class Content {
 public:
  void add(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    value_ = mix(value_, bits);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0;
};

std::uint64_t content_of(const sim::CrowdRecording& recording) {
  Content content;
  for (const sim::CrowdSample& sample : recording.samples()) {
    content.add(sample.time);
    content.add(sample.id);
    content.add(sample.position_world.x());
    content.add(sample.position_world.y());
  }
  return content.value();
}

std::uint64_t content_of(const sim::StaticMap& map) {
  Content content;
  const host::CellMap cells = map.cells();
  content.add(cells.resolution);
  for (const Eigen::Vector2d& corner : map.corners()) {
    content.add(corner.x());
    content.add(corner.y());
  }
  for (const std::int8_t value : *cells.values) content.add(value);
  return content.value();
}

}  // namespace

std::string identity_text(const RunConfiguration& config) {
  if (!config.recording && !config.map) return to_yaml_text(config);
  RunConfiguration placeless = config;
  if (config.map) placeless.scene.map = to_text(content_of(*config.map));
  if (config.recording) placeless.crowd = to_text(content_of(*config.recording));
  return to_yaml_text(placeless);
}

}  // namespace spf
