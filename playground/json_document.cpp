// Stands for config/yaml_parser.cpp where there is no YAML parser: documents are JSON, which is YAML too, so
// that a scene of the playground is a scenario file of the program.
#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <utility>

#include "config/yaml_tree.hpp"

namespace spf {
namespace {

/// Builds the tree from the parser's events; false ends the parse.
class JsonTreeBuilder : public nlohmann::json::json_sax_t {
 public:
  JsonTreeBuilder(std::string source, const YamlLimits& limits, InputProblems& problems)
      : whole_{std::move(source), 0, 0}, limits_{limits}, problems_{problems} {}

  [[nodiscard]] YamlNode take() { return std::move(root_); }

  bool null() override { return leaf(YamlKind::nothing, "", false); }
  bool boolean(bool value) override { return leaf(YamlKind::scalar, value ? "true" : "false", false); }
  bool number_integer(number_integer_t value) override {
    return leaf(YamlKind::scalar, std::to_string(value), false);
  }
  bool number_unsigned(number_unsigned_t value) override {
    return leaf(YamlKind::scalar, std::to_string(value), false);
  }
  bool number_float(number_float_t, const string_t& text) override {
    return leaf(YamlKind::scalar, text, false);
  }
  bool string(string_t& text) override { return leaf(YamlKind::scalar, text, true); }
  bool binary(binary_t&) override { return refuse("holds bytes"); }
  bool start_object(std::size_t) override { return open(YamlKind::map); }
  bool start_array(std::size_t) override { return open(YamlKind::list); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    if (levels_.back().node.find(name) != nullptr) return refuse("key " + name + " stands twice");
    levels_.back().key = name;
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
    return refuse("is not JSON: look near character " + std::to_string(position));
  }

 private:
  struct Level {
    YamlNode node;
    std::string key = {};
  };

  bool refuse(const std::string& sentence) {
    problems_.add(whole_, sentence);
    return false;
  }
  bool place(YamlNode made) {
    if (levels_.empty())
      root_ = std::move(made);
    else if (levels_.back().node.kind == YamlKind::list)
      levels_.back().node.items.push_back(std::move(made));
    else
      levels_.back().node.entries.push_back({levels_.back().key, whole_, std::move(made)});
    return true;
  }
  bool leaf(YamlKind kind, const std::string& text, bool quoted) {
    YamlNode made;
    made.kind = kind;
    made.location = whole_;
    made.text = text;
    made.quoted = quoted;
    return count() && place(std::move(made));
  }
  bool open(YamlKind kind) {
    if (levels_.size() >= limits_.depth)
      return refuse("is nested deeper than " + std::to_string(limits_.depth) + " levels");
    Level level;
    level.node.kind = kind;
    level.node.location = whole_;
    levels_.push_back(std::move(level));
    return count();
  }
  bool close() {
    YamlNode made = std::move(levels_.back().node);
    levels_.pop_back();
    return place(std::move(made));
  }
  bool count() {
    if (++nodes_ <= limits_.nodes) return true;
    return refuse("holds more than " + std::to_string(limits_.nodes) + " values");
  }

  SourceLocation whole_;
  YamlLimits limits_;
  InputProblems& problems_;
  YamlNode root_;
  std::vector<Level> levels_;
  std::size_t nodes_ = 0;
};

}  // namespace

YamlNode parse_yaml(std::string_view text, const std::string& source, InputProblems& problems,
                    const YamlLimits& limits) {
  YamlNode nothing;
  nothing.location = {source, 0, 0};
  if (text.size() > limits.bytes) {
    problems.add(nothing.location, "is larger than " + std::to_string(limits.bytes >> 20) + " MiB");
    return nothing;
  }
  JsonTreeBuilder builder{source, limits, problems};
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) return nothing;
  return builder.take();
}

}  // namespace spf
