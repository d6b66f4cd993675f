// Fills any parameter struct from a YAML map by walking its visit_fields list, the one declaration of its
// fields. Every problem is collected with file, line, column, key, value and limit; nothing throws, and bad
// values are not stored.
//
// Beside the calls of spf/math/parameters.hpp a visit_fields may use
//   visit(name, Eigen::Vector2d or std::optional of it or of double, unit, range, what)
//   visit(name, std::string, what)
//   visit.list(name, std::vector<Struct>, what)   entries are maps, each read over the entry that is there
//   visit.values(name, std::vector<double>, unit, range, what)           numbers in brackets
//   visit.values(name, std::vector<std::string or enumeration>, what)    words in brackets
//   visit.optional_group(name, std::optional<Struct>, what)
//   visit.required(name)                          the key must be there
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/yaml_tree.hpp"
#include "spf/math/parameters.hpp"

namespace spf {

/// Longer lists are refused.
inline constexpr std::size_t kMostEntries = 10'000;

/// The full key of a value to read, and where to report problems.
struct ReadTarget {
  const YamlNode& node;
  std::string key;  ///< "noise.level"
  InputProblems& problems;

  /// Adds "key = value sentence" at the node's location.
  void refuse(const std::string& sentence) const;
};

void read_value(const ReadTarget& target, const char* unit, Range range, double& value);
void read_value(const ReadTarget& target, const char* unit, Range range, int& value);
void read_value(const ReadTarget& target, const char* unit, Range range, std::uint64_t& value);
void read_value(const ReadTarget& target, const char* unit, Range range, Eigen::Vector2d& value);
void read_value(const ReadTarget& target, const char* unit, Range range, std::optional<double>& value);
void read_value(const ReadTarget& target, const char* unit, Range range,
                std::optional<Eigen::Vector2d>& value);
void read_choice(const ReadTarget& target, bool& value);
void read_choice(const ReadTarget& target, std::string& value);
/// Index of the name given.
[[nodiscard]] std::optional<std::size_t> read_name(const ReadTarget& target,
                                                   const std::vector<std::string>& names);

template <class E, class = decltype(EnumNames<E>::values)>
void read_choice(const ReadTarget& target, E& value) {
  std::vector<std::string> names;
  for (const auto& entry : EnumNames<E>::values) names.emplace_back(entry.second);
  if (const std::optional<std::size_t> index = read_name(target, names))
    value = EnumNames<E>::values[*index].first;
}

/// Every key of a struct, groups too, nested ones with dots; list entries as "robots[].start".
class KeyCollector {
 public:
  template <class... Rest>
  void operator()(const char* name, const Rest&...) {
    keys_.push_back(prefix_ + name);
  }
  template <class Nested>
  void group(const char* name, const Nested& nested) {
    keys_.push_back(prefix_ + name);
    const std::string outer = std::exchange(prefix_, prefix_ + name + ".");
    Nested::visit_fields(nested, *this);
    prefix_ = outer;
  }
  template <class Nested>
  void optional_group(const char* name, const std::optional<Nested>&, const char*) {
    const Nested nested;
    group(name, nested);
  }
  template <class Entry>
  void list(const char* name, const std::vector<Entry>&, const char*) {
    const Entry entry;
    keys_.push_back(prefix_ + name);
    const std::string outer = std::exchange(prefix_, prefix_ + name + "[].");
    Entry::visit_fields(entry, *this);
    prefix_ = outer;
  }
  template <class... Rest>
  void values(const char* name, const Rest&...) {
    keys_.push_back(prefix_ + name);
  }
  void required(const char*) {}
  [[nodiscard]] std::vector<std::string> take() { return std::move(keys_); }

 private:
  std::string prefix_;
  std::vector<std::string> keys_;
};

template <class Parameters>
[[nodiscard]] std::vector<std::string> keys_of(const Parameters& parameters) {
  KeyCollector collector;
  Parameters::visit_fields(parameters, collector);
  return collector.take();
}

/// Reads one map; made by read_parameters.
class FieldReader {
 public:
  /// `all_keys` are those of the whole document, for hints.
  FieldReader(const YamlNode& map, std::string prefix, const std::vector<std::string>& all_keys,
              InputProblems& problems)
      : map_{map}, prefix_{std::move(prefix)}, all_keys_{all_keys}, problems_{problems} {}

  template <class Value>
  void operator()(const char* name, Value& value, const char* unit, Range range, const char*) {
    if (const YamlNode* node = take(name)) read_value({*node, prefix_ + name, problems_}, unit, range, value);
  }
  template <class Choice>
  void operator()(const char* name, Choice& value, const char*) {
    if (const YamlNode* node = take(name)) read_choice({*node, prefix_ + name, problems_}, value);
  }
  template <class Nested>
  void group(const char* name, Nested& nested) {
    if (const YamlNode* node = take(name)) read_map(*node, prefix_ + name, nested);
  }
  template <class Nested>
  void optional_group(const char* name, std::optional<Nested>& nested, const char*) {
    if (const YamlNode* node = take(name)) read_map(*node, prefix_ + name, nested.emplace());
  }
  template <class Number>
  void values(const char* name, std::vector<Number>& numbers, const char* unit, Range range, const char*) {
    read_values(name, numbers, [&](const ReadTarget& target, Number& value) {
      if constexpr (std::is_same_v<Number, Eigen::Vector2d>) value.setZero();
      read_value(target, unit, range, value);
    });
  }
  template <class Choice>
  void values(const char* name, std::vector<Choice>& choices, const char*) {
    read_values(name, choices, [](const ReadTarget& target, Choice& value) { read_choice(target, value); });
  }
  template <class Entry>
  void list(const char* name, std::vector<Entry>& entries, const char*) {
    const YamlNode* node = take_list(name);
    if (node == nullptr) return;
    entries.resize(node->items.size());
    for (std::size_t i = 0; i < entries.size(); ++i)
      read_map(node->items[i], prefix_ + name + "[" + std::to_string(i) + "]", entries[i]);
  }
  void required(const char* name);
  /// Refuses the keys that no visit has read.
  void finish();

 private:
  template <class Nested>
  void read_map(const YamlNode& node, const std::string& key, Nested& nested) {
    if (node.kind == YamlKind::nothing) {
      // An empty group sets nothing; its required keys are missing.
    } else if (node.kind != YamlKind::map) {
      return ReadTarget{node, key, problems_}.refuse("must be a map of keys and values");
    }
    FieldReader reader{node, key + ".", all_keys_, problems_};
    Nested::visit_fields(nested, reader);
    reader.finish();
  }
  template <class Value, class Read>
  void read_values(const char* name, std::vector<Value>& values, Read read) {
    const YamlNode* node = take_list(name);
    if (node == nullptr) return;
    Value blank{};
    if constexpr (std::is_same_v<Value, Eigen::Vector2d>) blank.setZero();
    values.assign(node->items.size(), blank);
    for (std::size_t i = 0; i < values.size(); ++i)
      read({node->items[i], prefix_ + name + "[" + std::to_string(i) + "]", problems_}, values[i]);
  }
  const YamlNode* take(const char* name);
  /// Null when the key is absent or holds something else, which is refused.
  const YamlNode* take_list(const char* name);

  const YamlNode& map_;
  std::string prefix_;
  const std::vector<std::string>& all_keys_;
  InputProblems& problems_;
  std::vector<std::string> known_;
};

/// Whether the document is a map; reports a problem if not, unless one was reported when it could not be
/// read.
[[nodiscard]] bool require_map(const YamlNode& root, InputProblems& problems);

/// Reads the document `root` over `parameters`: keys that are absent keep their value.
template <class Parameters>
void read_parameters(const YamlNode& root, Parameters& parameters, InputProblems& problems) {
  if (!require_map(root, problems)) return;
  const std::vector<std::string> keys = keys_of(parameters);
  FieldReader reader{root, "", keys, problems};
  Parameters::visit_fields(parameters, reader);
  reader.finish();
}

}  // namespace spf
