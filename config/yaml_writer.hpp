// Writes any parameter struct as YAML that the reader of yaml_reader.hpp reads back to the same values;
// optionally with every key explained in a comment.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/parameter_text.hpp"
#include "spf/math/parameters.hpp"

namespace spf {

/// Visitor for visit_fields; made by to_yaml.
class YamlWriter {
 public:
  explicit YamlWriter(bool explains) : explains_{explains} {}

  template <class Value>
  void operator()(const char* name, const Value& value, const char* unit, Range range, const char* what) {
    const std::string suffix = std::string_view{unit} == "1" ? "" : std::string{" "} + unit;
    line(name, to_text(value), std::string{what} + "; " + to_text(range) + suffix);
  }
  template <class Choice>
  void operator()(const char* name, const Choice& value, const char* what) {
    line(name, to_text(value), std::string{what} + "; " + choices_of(value));
  }
  template <class Nested>
  void group(const char* name, const Nested& nested) {
    line(name, "", "");
    indent_ += "  ";
    Nested::visit_fields(nested, *this);
    indent_.resize(indent_.size() - 2);
  }
  template <class Nested>
  void optional_group(const char* name, const std::optional<Nested>& nested, const char* what) {
    if (!nested) return;
    explain(what);
    group(name, *nested);
  }
  template <class Number>
  void values(const char* name, const std::vector<Number>& numbers, const char* unit, Range range,
              const char* what) {
    const std::string suffix = std::string_view{unit} == "1" ? "" : std::string{" "} + unit;
    line(name, in_brackets(numbers), std::string{what} + "; " + to_text(range) + suffix);
  }
  template <class Choice>
  void values(const char* name, const std::vector<Choice>& choices, const char* what) {
    line(name, in_brackets(choices), std::string{what} + "; " + choices_of(Choice{}));
  }
  template <class Entry>
  void list(const char* name, const std::vector<Entry>& entries, const char* what) {
    explain(what);
    line(name, entries.empty() ? "[]" : "", "");
    indent_ += "    ";
    for (const Entry& entry : entries) {
      dash_ = true;
      Entry::visit_fields(entry, *this);
    }
    indent_.resize(indent_.size() - 4);
  }
  void required(const char*) {}
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  template <class Value>
  static std::string in_brackets(const std::vector<Value>& values) {
    std::string text;
    for (const Value& value : values) text += (text.empty() ? "" : ", ") + to_text(value);
    return "[" + text + "]";
  }
  void explain(const std::string& comment) {
    if (explains_) text_ += indent_ + "# " + comment + "\n";
  }
  void line(const char* name, const std::string& value, const std::string& comment) {
    constexpr std::size_t kCommentColumn = 36;
    std::string start = indent_;
    if (std::exchange(dash_, false)) start.replace(start.size() - 2, 2, "- ");
    std::string text = start + name + ":" + (value.empty() ? "" : " ") + value;
    if (explains_ && !comment.empty()) {
      if (text.size() < kCommentColumn) text.resize(kCommentColumn, ' ');
      text += "  # " + comment;
    }
    text_ += text + "\n";
  }

  bool explains_;
  std::string text_;
  std::string indent_;
  bool dash_ = false;  ///< the next line begins a list entry
};

template <class Parameters>
[[nodiscard]] std::string to_yaml(const Parameters& parameters, bool explains = false) {
  YamlWriter writer{explains};
  Parameters::visit_fields(parameters, writer);
  return writer.take();
}

}  // namespace spf
