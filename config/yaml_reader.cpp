#include "config/yaml_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <system_error>

#include "config/closest_name.hpp"
#include "config/number_text.hpp"
#include "config/parameter_text.hpp"

namespace spf {
namespace {

std::string in_unit(const char* unit) {
  return std::string_view{unit} == "1" ? "" : std::string{" in "} + unit;
}

/// The text of an unquoted scalar without a leading plus; nothing for other kinds.
std::optional<std::string_view> plain_text(const YamlNode& node) {
  if (node.kind != YamlKind::scalar || node.quoted || node.text.empty()) return std::nullopt;
  std::string_view text = node.text;
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

bool is_one_of(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

/// Why a text is no number, for example a number with its unit.
std::string no_number(std::string_view text, const char* rest, const char* kind, const char* unit) {
  std::string sentence = std::string{"must be "} + kind + in_unit(unit);
  const bool begins_with_number = rest != text.data() && text.find_first_of("0123456789") < 2;
  const std::string_view tail = text.substr(static_cast<std::size_t>(rest - text.data()));
  if (begins_with_number && tail.find_first_of(".0123456789,") == std::string_view::npos)
    sentence += ", written without a unit";
  return sentence;
}

std::optional<double> read_double(const ReadTarget& target, const char* unit, Range range) {
  constexpr const char* kKind = "a number";
  const std::optional<std::string_view> text = plain_text(target.node);
  if (!text) {
    target.refuse(std::string{"must be a number"} + in_unit(unit));
    return std::nullopt;
  }
  double value = 0.0;
  if (is_one_of(*text, {".inf", ".Inf", ".INF"})) {
    value = std::numeric_limits<double>::infinity();
  } else if (is_one_of(*text, {"-.inf", "-.Inf", "-.INF"})) {
    value = -std::numeric_limits<double>::infinity();
  } else if (is_one_of(*text, {".nan", ".NaN", ".NAN", "nan", "NaN", "NAN"})) {
    target.refuse("must be a number" + in_unit(unit) + ", not NaN");
    return std::nullopt;
  } else {
    const NumberRead number = read_number(*text);
    value = number.value;
    const bool spelled_out =
        text->find_first_of("iInN") != std::string_view::npos;  // "inf" and "nan" would be read
    if (number.error == std::errc::result_out_of_range) {
      target.refuse("is too large or too small for a number; it " + limit_sentence(range, unit));
      return std::nullopt;
    }
    if (number.error != std::errc{} || number.used != text->size() || spelled_out) {
      const std::size_t good = number.error == std::errc{} ? number.used : 0;
      target.refuse(no_number(*text, text->data() + good, kKind, unit));
      return std::nullopt;
    }
  }
  if (std::isinf(value) && !(range.contains(value) && std::isinf(value > 0.0 ? range.high : range.low))) {
    target.refuse(limit_sentence(range, unit) + " and be finite");
    return std::nullopt;
  }
  if (!range.contains(value)) {
    target.refuse(limit_sentence(range, unit));
    return std::nullopt;
  }
  return value;
}

template <class Whole>
void read_whole(const ReadTarget& target, const char* unit, Range range, Whole& value) {
  const std::optional<std::string_view> text = plain_text(target.node);
  if (!text) return target.refuse("must be a whole number" + in_unit(unit));
  Whole read = 0;
  const char* end = text->data() + text->size();
  const auto [rest, error] = std::from_chars(text->data(), end, read);
  if (error == std::errc::result_out_of_range && rest == end)
    return target.refuse(limit_sentence(range, unit));
  if (error != std::errc{} || rest != end)
    return target.refuse(
        no_number(*text, error == std::errc{} ? rest : text->data(), "a whole number", unit));
  if (!range.contains(static_cast<double>(read))) return target.refuse(limit_sentence(range, unit));
  value = read;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string last_part(const std::string& key) {
  return key.substr(key.find_last_of('.') + 1);
}

}  // namespace

void ReadTarget::refuse(const std::string& sentence) const {
  problems.add(node.location, key + " = " + shown(node) + " " + sentence, key);
}

void read_value(const ReadTarget& target, const char* unit, Range range, double& value) {
  if (const std::optional<double> read = read_double(target, unit, range)) value = *read;
}

void read_value(const ReadTarget& target, const char* unit, Range range, int& value) {
  read_whole(target, unit, range, value);
}

void read_value(const ReadTarget& target, const char* unit, Range range, std::uint64_t& value) {
  read_whole(target, unit, range, value);
}

void read_value(const ReadTarget& target, const char* unit, Range range, Eigen::Vector2d& value) {
  if (target.node.kind != YamlKind::list || target.node.items.size() != 2)
    return target.refuse("must be a pair [x, y]" + in_unit(unit));
  Eigen::Vector2d read;
  for (int axis = 0; axis < 2; ++axis) {
    const ReadTarget part{target.node.items[static_cast<std::size_t>(axis)],
                          target.key + "[" + std::to_string(axis) + "]", target.problems};
    const std::optional<double> number = read_double(part, unit, range);
    if (!number) return;
    read[axis] = *number;
  }
  value = read;
}

void read_value(const ReadTarget& target, const char* unit, Range range, std::optional<double>& value) {
  if (target.node.kind == YamlKind::scalar && !target.node.quoted && target.node.text == "none") {
    value.reset();
  } else if (const std::optional<double> read = read_double(target, unit, range)) {
    value = *read;
  }
}

void read_value(const ReadTarget& target, const char* unit, Range range,
                std::optional<Eigen::Vector2d>& value) {
  if (target.node.kind == YamlKind::scalar && !target.node.quoted && target.node.text == "none")
    return value.reset();
  constexpr double kUnread = std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector2d read = Eigen::Vector2d::Constant(kUnread);
  read_value(target, unit, range, read);
  if (read.allFinite()) value = read;
}

void read_choice(const ReadTarget& target, bool& value) {
  const std::optional<std::string_view> text = plain_text(target.node);
  if (!text || !is_one_of(*text, {"true", "false"})) return target.refuse("must be true or false");
  value = *text == "true";
}

void read_choice(const ReadTarget& target, std::string& value) {
  if (target.node.kind != YamlKind::scalar) return target.refuse("must be text");
  value = target.node.text;
}

std::optional<std::size_t> read_name(const ReadTarget& target, const std::vector<std::string>& names) {
  const std::string& text = target.node.text;
  if (target.node.kind == YamlKind::scalar)
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == text) return i;
  // A problem that is only counted needs no hint.
  const std::optional<std::string> meant = target.problems.full() ? std::nullopt : closest_name(text, names);
  target.refuse("must be one of " + listed(names) + (meant ? "; did you mean " + *meant + "?" : ""));
  return std::nullopt;
}

const YamlNode* FieldReader::take(const char* name) {
  known_.emplace_back(name);
  return map_.find(name);
}

const YamlNode* FieldReader::take_list(const char* name) {
  const YamlNode* node = take(name);
  if (node == nullptr) return nullptr;
  const ReadTarget target{*node, prefix_ + name, problems_};
  if (node->kind != YamlKind::list) {
    target.refuse("must be a list");
  } else if (node->items.size() > kMostEntries) {
    target.refuse("has " + std::to_string(node->items.size()) + " entries: must have at most " +
                  std::to_string(kMostEntries));
  } else {
    return node;
  }
  return nullptr;
}

void FieldReader::required(const char* name) {
  if (map_.find(name) == nullptr)
    problems_.add(map_.location, prefix_ + name + " is missing", prefix_ + name);
}

void FieldReader::finish() {
  for (const YamlEntry& entry : map_.entries) {
    if (std::find(known_.begin(), known_.end(), entry.key) != known_.end()) continue;
    if (problems_.full()) {  // more hints are not shown
      problems_.add(entry.key_location, "");
      continue;
    }
    std::optional<std::string> meant = closest_name(entry.key, known_);
    if (meant) meant = prefix_ + *meant;
    if (!meant)  // perhaps the key of another group
      for (const std::string& key : all_keys_)
        if (!meant && last_part(key) == entry.key) meant = key;
    YamlNode key;
    key.kind = YamlKind::scalar;
    key.text = entry.key;
    problems_.add(entry.key_location, prefix_ + shown(key) + " = " + shown(entry.value) +
                                          " is not a known key" +
                                          (meant ? "; did you mean " + *meant + "?" : ""));
  }
}

bool require_map(const YamlNode& root, InputProblems& problems) {
  if (root.kind == YamlKind::map) return true;
  if (root.kind != YamlKind::nothing || problems.empty())
    problems.add(root.location, "must be a map of keys and values, not " + shown(root));
  return false;
}

}  // namespace spf
