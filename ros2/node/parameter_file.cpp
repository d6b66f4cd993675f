#include "ros2/node/parameter_file.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace ros2 {
namespace {

constexpr std::size_t kMostBytes = 4U << 20;
constexpr std::size_t kMostValues = 100'000;  // aliases make many of few bytes
constexpr int kMostLevels = 32;
constexpr const char* kParameters = "ros__parameters";

[[noreturn]] void refuse(const std::string& source, const YAML::Node& node, const std::string& why) {
  const int line = node.Mark().line;
  throw std::invalid_argument{source + (line >= 0 ? ":" + std::to_string(line + 1) : "") + ": " + why};
}

bool is_quoted(const YAML::Node& node) {
  return node.Tag() == "!";
}

/// By the rules of ROS 2: true and false, whole numbers, numbers, and text for the rest.
ParameterValue scalar_value(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (is_quoted(node) || text.empty()) return text;
  if (text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "false" || text == "False" || text == "FALSE") return false;
  if (text == ".nan" || text == ".NaN" || text == ".NAN") return std::nan("");
  const std::string plain = text.front() == '+' || text.front() == '-' ? text.substr(1) : text;
  if (plain == ".inf" || plain == ".Inf" || plain == ".INF")
    return text.front() == '-' ? -HUGE_VAL : HUGE_VAL;
  if (plain.find_first_not_of("0123456789") == std::string::npos && !plain.empty()) {
    errno = 0;
    const long long number = std::strtoll(text.c_str(), nullptr, 10);
    if (errno == 0) return static_cast<std::int64_t>(number);
  }
  if (plain.find_first_not_of("0123456789.eE+-") == std::string::npos &&
      plain.find_first_of("0123456789") != std::string::npos) {
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (*end == '\0') return number;
  }
  return text;
}

template <class Value>
std::vector<Value> list_of(const std::vector<ParameterValue>& values) {
  std::vector<Value> list;
  for (const ParameterValue& value : values) list.push_back(std::get<Value>(value));
  return list;
}

ParameterValue list_value(const YAML::Node& node, const std::string& source) {
  std::vector<ParameterValue> values;
  for (const YAML::Node& item : node) {
    if (!item.IsScalar()) refuse(source, item, "a list of parameters holds scalars alone");
    values.push_back(scalar_value(item));
  }
  if (values.empty()) refuse(source, node, "an empty list has no type");
  // Whole numbers among others are numbers.
  const auto is = [&](std::uint8_t type) {
    return std::any_of(values.begin(), values.end(),
                       [&](const auto& value) { return type_of(value) == type; });
  };
  using Type = rcl_interfaces::ParameterType;
  if (is(Type::PARAMETER_DOUBLE))
    for (ParameterValue& value : values)
      if (const auto* whole = std::get_if<std::int64_t>(&value)) value = static_cast<double>(*whole);
  const std::uint8_t type = type_of(values.front());
  for (const ParameterValue& value : values)
    if (type_of(value) != type)
      refuse(source, node,
             std::string{"a list of both "} + type_name(type) + " and " + type_name(type_of(value)));
  if (type == Type::PARAMETER_BOOL) return list_of<bool>(values);
  if (type == Type::PARAMETER_INTEGER) return list_of<std::int64_t>(values);
  if (type == Type::PARAMETER_DOUBLE) return list_of<double>(values);
  return list_of<std::string>(values);
}

class FileReader {
 public:
  explicit FileReader(std::string source) : source_{std::move(source)} {}

  /// Names of nodes and namespaces down to where the parameters are.
  void read_nodes(const YAML::Node& node, const std::string& pattern, int level) {
    if (!node.IsMap()) refuse(source_, node, "'" + pattern + "' must be a map with the key " + kParameters);
    check(node, level);
    for (const auto& entry : node) {
      const std::string key = entry.first.Scalar();
      if (key == kParameters) {
        if (pattern.empty())
          refuse(source_, entry.first, std::string{kParameters} + " without a node's name");
        if (!entry.second.IsNull()) read_values(entry.second, pattern, "", level + 1);
        continue;
      }
      std::string name = pattern;
      if (!name.empty() && name.back() != '/' && key.front() != '/') name += "/";
      read_nodes(entry.second, name + key, level + 1);
    }
  }

  [[nodiscard]] std::vector<ParameterRule> take() { return std::move(rules_); }

 private:
  void read_values(const YAML::Node& node, const std::string& pattern, const std::string& prefix, int level) {
    if (!node.IsMap())
      refuse(source_, node, std::string{kParameters} + " of '" + pattern + "' must be a map");
    check(node, level);
    for (const auto& entry : node) {
      const std::string name = prefix + entry.first.Scalar();
      const YAML::Node& value = entry.second;
      if (value.IsMap())
        read_values(value, pattern, name + ".", level + 1);
      else if (value.IsSequence())
        rules_.push_back({pattern, name, list_value(value, source_)});
      else if (value.IsScalar())
        rules_.push_back({pattern, name, scalar_value(value)});
      else
        refuse(source_, entry.first, "'" + name + "' has no value");
    }
  }
  void check(const YAML::Node& node, int level) {
    if (level > kMostLevels) refuse(source_, node, "more than " + std::to_string(kMostLevels) + " levels");
    values_ += node.size();
    if (values_ > kMostValues) refuse(source_, node, "more than " + std::to_string(kMostValues) + " values");
  }

  std::string source_;
  std::size_t values_ = 0;
  std::vector<ParameterRule> rules_;
};

std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts;
  for (std::size_t begin = name.rfind('/', 0) == 0 ? 1 : 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    parts.push_back(name.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

bool matches(const std::vector<std::string>& pattern, std::size_t i, const std::vector<std::string>& name,
             std::size_t k) {
  if (i == pattern.size()) return k == name.size();
  if (pattern[i] == "**") {
    // Whole names end with the node's own, for which ** may stand too.
    for (std::size_t next = k; next <= name.size(); ++next)
      if (matches(pattern, i + 1, name, next)) return true;
    return false;
  }
  return k < name.size() && (pattern[i] == "*" || pattern[i] == name[k]) &&
         matches(pattern, i + 1, name, k + 1);
}

}  // namespace

bool matches(const std::string& pattern, const std::string& node) {
  const std::string whole = pattern.find('/') == std::string::npos ? "/**/" + pattern : pattern;
  if (std::count(whole.begin(), whole.end(), '*') > 16) return false;
  return matches(parts_of(whole), 0, parts_of(node), 0);
}

std::vector<ParameterRule> parse_parameters(const std::string& text, const std::string& source) {
  FileReader reader{source};
  try {
    const YAML::Node root = YAML::Load(text);
    if (root.IsNull()) return {};
    reader.read_nodes(root, "", 0);
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument{source + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg};
  }
  return reader.take();
}

std::vector<ParameterRule> read_parameter_file(const std::string& path) {
  std::ifstream file{path, std::ios::binary};
  std::string text(kMostBytes + 1, '\0');
  if (!file || !(file.read(text.data(), static_cast<std::streamsize>(text.size())) || file.eof()))
    throw std::invalid_argument{path + ": cannot be read"};
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kMostBytes)
    throw std::invalid_argument{path + ": is larger than " + std::to_string(kMostBytes) + " bytes"};
  return parse_parameters(text, path);
}

ParameterValue parse_parameter_value(const std::string& text) {
  if (text.size() > kMostBytes) throw std::invalid_argument{"a value of more than 4 MiB"};
  try {
    const YAML::Node node = YAML::Load(text);
    if (node.IsSequence()) return list_value(node, "'" + text + "'");
    if (node.IsScalar()) return scalar_value(node);
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument{"'" + text + "': " + error.msg};
  }
  throw std::invalid_argument{"'" + text + "' is neither a value nor a list of values"};
}

}  // namespace ros2
