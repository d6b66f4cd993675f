#include "config/yaml_tree.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "config/utf8.hpp"

namespace spf {
namespace {
auto entry_of(std::string_view key) {
  return [key](const YamlEntry& entry) { return entry.key == key; };
}
}  // namespace

const YamlNode* YamlNode::find(std::string_view key) const {
  const auto found = std::find_if(entries.begin(), entries.end(), entry_of(key));
  return found == entries.end() ? nullptr : &found->value;
}

YamlNode* YamlNode::find(std::string_view key) {
  const auto found = std::find_if(entries.begin(), entries.end(), entry_of(key));
  return found == entries.end() ? nullptr : &found->value;
}

YamlNode read_yaml_file(const std::string& path, InputProblems& problems, const YamlLimits& limits) {
  const SourceLocation whole{path, 0, 0};
  YamlNode nothing;
  nothing.location = whole;
  const auto refuse = [&](const std::string& sentence) {
    problems.add(whole, sentence);
    return nothing;
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return refuse("no such file");
  if (error) return refuse("cannot be read: " + error.message());
  if (std::filesystem::is_directory(status)) return refuse("is a directory, not a file");
  if (!std::filesystem::is_regular_file(status)) return refuse("is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > limits.bytes)
    return refuse("is larger than " + std::to_string(limits.bytes >> 20) + " MiB");
  std::ifstream file{path, std::ios::binary};
  if (!file) return refuse("cannot be opened for reading");
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) return refuse("cannot be read");
  return parse_yaml(text.str(), path, problems, limits);
}

namespace {

void mark_all(YamlNode& node, const SourceLocation& location) {
  node.location = location;
  for (YamlNode& item : node.items) mark_all(item, location);
  for (YamlEntry& entry : node.entries) {
    entry.key_location = location;
    mark_all(entry.value, location);
  }
}

/// One step of a path: a key, or an index when `index` is set.
struct PathStep {
  std::string key;
  std::optional<std::size_t> index;
};

/// "robots[3].start" -> robots, [3], start. Nothing when it is malformed.
std::optional<std::vector<PathStep>> split_path(std::string_view path) {
  std::vector<PathStep> steps;
  while (true) {
    const std::size_t end = std::min(path.find_first_of(".["), path.size());
    if (end == 0) return std::nullopt;
    steps.push_back({std::string{path.substr(0, end)}, {}});
    path.remove_prefix(end);
    while (!path.empty() && path.front() == '[') {
      std::size_t index = 0;
      const auto [after, error] = std::from_chars(path.data() + 1, path.data() + path.size(), index);
      if (error != std::errc{} || after == path.data() + path.size() || *after != ']') return std::nullopt;
      steps.push_back({"", index});
      path.remove_prefix(static_cast<std::size_t>(after - path.data()) + 1);
    }
    if (path.empty()) return steps;
    if (path.front() != '.') return std::nullopt;
    path.remove_prefix(1);
  }
}

/// Follows one step of a setting's path, adding missing keys. Returns the reason when it cannot, else an
/// empty text.
std::string step_into(YamlNode*& node, const PathStep& step, const SourceLocation& location) {
  if (step.index) {
    if (node->kind != YamlKind::list || *step.index >= node->items.size())
      return "there is no entry [" + std::to_string(*step.index) + "]; the list has " +
             std::to_string(node->items.size());
    node = &node->items[*step.index];
    return "";
  }
  if (node->kind == YamlKind::nothing) {
    node->kind = YamlKind::map;
    node->location = location;
  }
  if (node->kind != YamlKind::map) return shown(*node) + " has no key " + step.key;
  if (node->find(step.key) == nullptr)
    node->entries.push_back({step.key, location, YamlNode{YamlKind::nothing, location, {}, {}, {}, {}}});
  node = node->find(step.key);
  return "";
}

/// Maps are merged key by key, any other value replaces the old one.
void merge_over(YamlNode& target, YamlNode value) {
  if (target.kind != YamlKind::map || value.kind != YamlKind::map) {
    target = std::move(value);
    return;
  }
  for (YamlEntry& entry : value.entries) {
    if (YamlNode* known = target.find(entry.key))
      merge_over(*known, std::move(entry.value));
    else
      target.entries.push_back(std::move(entry));
  }
}

}  // namespace

void apply_setting(YamlNode& root, const std::string& assignment, const std::string& source,
                   InputProblems& problems) {
  const SourceLocation location{source, 0, 0};
  const std::size_t equals = assignment.find('=');
  const std::optional<std::vector<PathStep>> steps =
      equals == std::string::npos ? std::nullopt : split_path(std::string_view{assignment}.substr(0, equals));
  if (!steps) {
    problems.add(location, "'" + assignment + "' must read key=value or group.key=value");
    return;
  }
  const std::string path = assignment.substr(0, equals);
  if (assignment.find_first_not_of(" \t\n", equals + 1) == std::string::npos) {
    problems.add(location, path + " needs a value");
    return;
  }
  InputProblems of_value;
  YamlNode value = parse_yaml(assignment.substr(equals + 1), source, of_value);
  for (const InputProblem& problem : of_value.kept()) problems.add(location, path + ": " + problem.sentence);
  if (!of_value.empty()) return;
  mark_all(value, location);

  YamlNode* node = &root;
  for (const PathStep& step : *steps) {
    const std::string obstacle = step_into(node, step, location);
    if (!obstacle.empty()) return problems.add(location, path + ": " + obstacle);
  }
  merge_over(*node, std::move(value));
}

const YamlNode& nearest_node(const YamlNode& root, std::string_view path) {
  const YamlNode* node = &root;
  const std::optional<std::vector<PathStep>> steps = split_path(path);
  if (!steps) return *node;
  for (const PathStep& step : *steps) {
    const YamlNode* next = nullptr;
    if (!step.index)
      next = node->find(step.key);
    else if (*step.index < node->items.size())
      next = &node->items[*step.index];
    if (next == nullptr) break;
    node = next;
  }
  return *node;
}

std::string shown(const YamlNode& node) {
  constexpr std::size_t kLongest = 60;
  std::string text;
  switch (node.kind) {
    case YamlKind::nothing:
      return "nothing";
    case YamlKind::map:
      return "{...}";
    case YamlKind::scalar:
      text = node.quoted ? "\"" + node.text + "\"" : node.text;
      break;
    case YamlKind::list:
      for (const YamlNode& item : node.items) {
        text += (text.empty() ? "[" : ", ") + shown(item);
        if (text.size() > kLongest) break;
      }
      text = text.empty() ? "[]" : text + "]";
      break;
  }
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  if (text.size() > kLongest) {
    std::size_t end = kLongest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80)
      --end;  // not inside a character
    text = text.substr(0, end) + "...";
  }
  return text;
}

}  // namespace spf
