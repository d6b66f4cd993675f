#include "study/map_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "config/yaml_reader.hpp"
#include "study/file_bytes.hpp"
#include "study/grey_image.hpp"

namespace spf {
namespace map_server {

enum class Mode { trinary, scale, raw };

/// Written as a number by ROS 1, as a truth value by others.
struct Negate {
  bool on = false;
  friend constexpr bool operator==(Negate a, Negate b) { return a.on == b.on; }
};

}  // namespace map_server

template <>
struct EnumNames<map_server::Mode> {
  static constexpr std::array<std::pair<map_server::Mode, const char*>, 3> values{
      {{map_server::Mode::trinary, "trinary"},
       {map_server::Mode::scale, "scale"},
       {map_server::Mode::raw, "raw"}}};
};
template <>
struct EnumNames<map_server::Negate> {
  static constexpr std::array<std::pair<map_server::Negate, const char*>, 4> values{
      {{map_server::Negate{false}, "0"},
       {map_server::Negate{true}, "1"},
       {map_server::Negate{false}, "false"},
       {map_server::Negate{true}, "true"}}};
};

namespace {

constexpr std::uintmax_t kMostMapBytes = std::uintmax_t{256} << 20;
constexpr std::int8_t kFree = 0;
constexpr std::int8_t kOccupied = 100;
constexpr std::int8_t kUnknown = -1;

/// The keys of a map server's file, with its defaults.
struct MapFile {
  std::string image;
  double resolution = 0.05;
  std::vector<double> origin{0.0, 0.0, 0.0};  // x, y [m], heading [rad]
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
  map_server::Negate negate;
  map_server::Mode mode = map_server::Mode::trinary;

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor&& visit) {
    visit.required("image");
    visit.required("resolution");
    visit.required("origin");
    visit("image", self.image, "the picture, beside this file");
    visit("resolution", self.resolution, "m", Range{1e-3, 100.0}, "side of a pixel");
    visit.values("origin", self.origin, "1", Range{-1e5, 1e5}, "x, y and heading of the lower left corner");
    visit("occupied_thresh", self.occupied_thresh, "1", Range{0.0, 1.0}, "darker is occupied");
    visit("free_thresh", self.free_thresh, "1", Range{0.0, 1.0}, "lighter is free");
    visit("negate", self.negate, "whether light means occupied");
    visit("mode", self.mode, "how the rest is read");
  }
};

/// Value of a cell, as map servers tell it.
std::int8_t value_of(const MapFile& file, int brightness) {
  const int light = file.negate.on ? 255 - brightness : brightness;
  if (file.mode == map_server::Mode::raw) return light <= 100 ? static_cast<std::int8_t>(light) : kUnknown;
  const double occupancy = (255.0 - light) / 255.0;
  if (occupancy > file.occupied_thresh) return kOccupied;
  if (occupancy < file.free_thresh) return kFree;
  if (file.mode == map_server::Mode::trinary) return kUnknown;
  const double share = (occupancy - file.free_thresh) / (file.occupied_thresh - file.free_thresh);
  return static_cast<std::int8_t>(99.0 * share);
}

/// Rows of a picture go down, those of a map up.
std::vector<std::int8_t> cells_of(const GreyImage& image, const MapFile& file, UnknownCells unknown) {
  std::array<std::int8_t, 256> table;
  const auto seen = [unknown](std::int8_t value) {
    return value == kUnknown && unknown == UnknownCells::wall ? kOccupied : value;
  };
  for (int brightness = 0; brightness < 256; ++brightness)
    table[static_cast<std::size_t>(brightness)] = seen(value_of(file, brightness));
  std::vector<std::int8_t> cells(image.brightness.size());
  for (std::size_t row = 0; row < image.height; ++row)
    for (std::size_t column = 0; column < image.width; ++column) {
      const std::size_t pixel = (image.height - 1 - row) * image.width + column;
      const bool hidden = !image.transparent.empty() && image.transparent[pixel];
      cells[row * image.width + column] = hidden ? seen(kUnknown) : table[image.brightness[pixel]];
    }
  return cells;
}

/// Rules between keys, and those of the origin.
void check_map_file(const YamlNode& root, const MapFile& file, InputProblems& problems) {
  const auto refuse = [&](const char* key, const std::string& sentence) {
    if (const YamlNode* node = root.find(key)) ReadTarget{*node, key, problems}.refuse(sentence);
  };
  const YamlNode* origin = root.find("origin");
  if (file.origin.size() != 3 && origin != nullptr && origin->kind == YamlKind::list)
    refuse("origin", "must be x, y and heading: [0, 0, 0]");
  if (file.origin.size() == 3 && std::abs(file.origin[2]) > 6.3)
    refuse("origin", "must have a heading in [-6.3, 6.3] rad");
  if (!(file.free_thresh < file.occupied_thresh)) {
    const char* key = root.find("free_thresh") != nullptr ? "free_thresh" : "occupied_thresh";
    refuse(key, "contradicts: free_thresh must be less than occupied_thresh");
  }
  if (file.image.empty() && root.find("image") != nullptr) refuse("image", "must name a picture");
}

std::shared_ptr<const sim::StaticMap> map_of_image(const std::string& bytes, const std::string& name,
                                                   const MapFile& file, UnknownCells unknown,
                                                   InputProblems& problems) {
  GreyImage image;
  const ImageFailure failure = read_image(bytes, image);
  if (!failure.sentence.empty()) {
    problems.add({name, failure.line, 0}, failure.sentence);
    return nullptr;
  }
  try {
    return std::make_shared<const sim::StaticMap>(Pose2{{file.origin[0], file.origin[1]}, file.origin[2]},
                                                  file.resolution, image.width, image.height,
                                                  cells_of(image, file, unknown));
  } catch (const std::invalid_argument& error) {
    problems.add({name, 0, 0}, std::string{"is no usable map: "} + error.what());
    return nullptr;
  }
}

std::shared_ptr<const sim::StaticMap> map_of_yaml(const std::string& text, const std::string& path,
                                                  UnknownCells unknown, InputProblems& problems) {
  InputProblems found;
  const YamlNode root = parse_yaml(text, path, found);
  MapFile file;
  read_parameters(root, file, found);
  if (root.kind == YamlKind::map) check_map_file(root, file, found);
  std::shared_ptr<const sim::StaticMap> map;
  if (found.empty()) {
    const std::filesystem::path image = std::filesystem::path{path}.parent_path() / file.image;
    const std::string name = image.lexically_normal().string();
    const YamlNode& node = *root.find("image");
    const FileBytes file_bytes = read_file_bytes(name, kMostMapBytes);
    if (file_bytes.bytes)
      map = map_of_image(*file_bytes.bytes, name, file, unknown, found);
    else
      found.add(node.location, "image = " + name + " " + file_bytes.why);
  }
  for (const InputProblem& problem : found.kept()) problems.add(problem.location, problem.sentence);
  return map;
}

}  // namespace

std::shared_ptr<const sim::StaticMap> read_map_file(const std::string& path, const MapSettings& settings,
                                                    const SourceLocation& asked_at, InputProblems& problems) {
  const FileBytes file = read_file_bytes(path, kMostMapBytes);
  if (!file.bytes) {
    problems.add(asked_at, "map = " + path + " " + file.why);
    return nullptr;
  }
  const bool is_image = looks_like_image(*file.bytes);
  if (!is_image && (file.bytes->empty() || file.bytes->find('\0') != std::string::npos)) {
    problems.add(asked_at,
                 "map = " + path + " is neither a map server's YAML file nor a picture of kind PGM or PNG");
    return nullptr;
  }
  if (!is_image) return map_of_yaml(*file.bytes, path, settings.unknown, problems);
  MapFile alone;
  alone.resolution = settings.image_resolution;
  alone.origin = {settings.image_origin.x(), settings.image_origin.y(), settings.image_heading};
  return map_of_image(*file.bytes, path, alone, settings.unknown, problems);
}

}  // namespace spf
