#include "config/yaml_tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "config/utf8.hpp"

namespace spf {
namespace {

/// Ends the parse at once; yaml-cpp passes exceptions of its handlers on.
struct DocumentRefused {
  SourceLocation location;
  std::string sentence;
};

/// Builds the tree from the parser's events. Nothing is expanded: an alias is an error, so a small file stays
/// small.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string source, const YamlLimits& limits, InputProblems& problems)
      : source_{std::move(source)}, limits_{limits}, problems_{problems} {}

  [[nodiscard]] YamlNode take() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    leaf(YamlKind::nothing, mark, "", anchor, "");
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    problems_.add(location(mark), "aliases (*name) are not supported: write the value out");
    leaf(YamlKind::nothing, mark, "", 0, "");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    leaf(YamlKind::scalar, mark, tag, anchor, value);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(YamlKind::list, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(YamlKind::map, mark, tag, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  /// A list or map that is being read.
  struct Level {
    YamlNode node;
    std::optional<std::pair<std::string, SourceLocation>> key;  ///< read, its value not yet
    bool skips_value = false;                                   ///< the key was refused, and so is its value
    std::map<std::string, int, std::less<>> lines;  ///< of the keys so far, to find duplicates fast
  };

  [[nodiscard]] SourceLocation location(const YAML::Mark& mark) const {
    return {source_, mark.line + 1, mark.column + 1};
  }

  YamlNode node(YamlKind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (++nodes_ > limits_.nodes)
      throw DocumentRefused{location(mark), "holds more than " + std::to_string(limits_.nodes) + " values"};
    if (anchor != 0) problems_.add(location(mark), "anchors (&name) are not supported");
    if (!tag.empty() && tag != "?" && tag != "!")
      problems_.add(location(mark), "tags (" + tag + ") are not supported");
    YamlNode made;
    made.kind = kind;
    made.location = location(mark);
    made.quoted = tag == "!";
    return made;
  }
  void leaf(YamlKind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
            const std::string& text) {
    YamlNode made = node(kind, mark, tag, anchor);
    made.text = text;
    place_in_parent(std::move(made));
  }
  void open(YamlKind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    if (levels_.size() >= limits_.depth)
      throw DocumentRefused{location(mark),
                            "is nested deeper than " + std::to_string(limits_.depth) + " levels"};
    levels_.push_back({node(kind, mark, tag, anchor), {}, false, {}});
  }
  void close() {
    YamlNode made = std::move(levels_.back().node);
    levels_.pop_back();
    place_in_parent(std::move(made));
  }

  void place_in_parent(YamlNode made) {
    if (levels_.empty()) {
      root_ = std::move(made);
      return;
    }
    Level& parent = levels_.back();
    if (parent.node.kind == YamlKind::list) {
      parent.node.items.push_back(std::move(made));
    } else if (std::exchange(parent.skips_value, false)) {
      return;
    } else if (parent.key) {
      parent.node.entries.push_back(
          {std::move(parent.key->first), std::move(parent.key->second), std::move(made)});
      parent.key.reset();
    } else {
      take_key(parent, std::move(made));
    }
  }
  void take_key(Level& parent, YamlNode made) {
    if (made.kind != YamlKind::scalar) {
      problems_.add(made.location, "a key must be a plain name, not " + shown(made));
      parent.skips_value = true;
    } else if (const auto [first, is_new] = parent.lines.emplace(made.text, made.location.line); !is_new) {
      problems_.add(made.location, "key " + shown(made) + " stands twice (first in line " +
                                       std::to_string(first->second) + ")");
      parent.skips_value = true;
    } else {
      parent.key.emplace(made.text, made.location);
    }
  }

  std::string source_;
  YamlLimits limits_;
  InputProblems& problems_;
  YamlNode root_;
  std::vector<Level> levels_;
  std::size_t nodes_ = 0;
};

SourceLocation location_of_byte(std::string_view text, std::size_t offset, const std::string& source) {
  SourceLocation location{source, 1, 1};
  for (std::size_t i = 0; i < offset; ++i) {
    if (text[i] == '\n') {
      ++location.line;
      location.column = 0;
    }
    ++location.column;
  }
  return location;
}

}  // namespace

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

YamlNode parse_yaml(std::string_view text, const std::string& source, InputProblems& problems,
                    const YamlLimits& limits) {
  const SourceLocation whole{source, 0, 0};
  YamlNode nothing;
  nothing.location = whole;
  if (text.size() > limits.bytes) {
    problems.add(whole, "is larger than " + std::to_string(limits.bytes >> 20) + " MiB");
    return nothing;
  }
  if (const std::optional<std::size_t> bad = first_bad_byte(text)) {
    std::ostringstream sentence;
    sentence << "byte 0x" << std::hex << static_cast<int>(static_cast<unsigned char>(text[*bad]))
             << " is not UTF-8 text";
    problems.add(location_of_byte(text, *bad, source), sentence.str());
    return nothing;
  }
  TreeBuilder builder{source, limits, problems};
  try {
    std::istringstream stream{std::string{text}};
    YAML::Parser parser{stream};
    if (!parser.HandleNextDocument(builder)) {
      problems.add(whole, "is empty: must be a map of keys and values");
      return nothing;
    }
    YamlNode root = builder.take();
    TreeBuilder second{source, limits, problems};
    if (parser.HandleNextDocument(second))
      problems.add(second.take().location, "must hold one YAML document, not several");
    return root;
  } catch (const DocumentRefused& refused) {
    problems.add(refused.location, refused.sentence);
  } catch (const YAML::Exception& error) {
    const bool known = error.mark.line >= 0;
    problems.add(known ? SourceLocation{source, error.mark.line + 1, error.mark.column + 1} : whole,
                 "is not YAML: " + error.msg);
  }
  return nothing;
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
