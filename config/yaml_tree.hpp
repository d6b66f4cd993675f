// A YAML document as a tree whose values have their location. A plain subset of YAML is read: maps, lists,
// scalars. Duplicate keys, anchors, aliases, tags and more than one document are refused, as is anything
// huge.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/input_problem.hpp"

namespace spf {

enum class YamlKind { nothing, scalar, list, map };

struct YamlEntry;

struct YamlNode {
  YamlKind kind = YamlKind::nothing;
  SourceLocation location;
  std::string text;                ///< of a scalar
  bool quoted = false;             ///< a scalar in quotation marks is text, never a number
  std::vector<YamlNode> items;     ///< of a list
  std::vector<YamlEntry> entries;  ///< of a map, in the order of the file; no key twice

  /// The value of a key, null when there is none.
  [[nodiscard]] const YamlNode* find(std::string_view key) const;
  [[nodiscard]] YamlNode* find(std::string_view key);
};

struct YamlEntry {
  std::string key;
  SourceLocation key_location;
  YamlNode value;
};

/// Limits of what is read; beyond them a document is refused. They are far above any sensible scenario.
struct YamlLimits {
  std::size_t bytes = 4u << 20;
  std::size_t nodes = 1'000'000;
  std::size_t depth = 32;
};

/// Reads a document. Errors are added to `problems`; the rest is returned, so that a reader can report
/// further problems in the same run. A document that cannot be parsed gives a node of kind `nothing`.
[[nodiscard]] YamlNode parse_yaml(std::string_view text, const std::string& source, InputProblems& problems,
                                  const YamlLimits& limits = {});

/// Reads a file, with the same report of problems: missing, a directory, not a regular file, not UTF-8,
/// empty, ...
[[nodiscard]] YamlNode read_yaml_file(const std::string& path, InputProblems& problems,
                                      const YamlLimits& limits = {});

/// Writes `value`, one `key.path=value` of the command line, over `root`. A path may name list entries that
/// exist, as in robots[2].goal. Problems have `source` ("--set") as their location.
void apply_setting(YamlNode& root, const std::string& assignment, const std::string& source,
                   InputProblems& problems);

/// The node at a path such as "robots[3].start", or its nearest ancestor that exists.
[[nodiscard]] const YamlNode& nearest_node(const YamlNode& root, std::string_view path);

/// A short rendering of a value for messages: the scalar, "[1, 2]", "{...}".
[[nodiscard]] std::string shown(const YamlNode& node);

}  // namespace spf
