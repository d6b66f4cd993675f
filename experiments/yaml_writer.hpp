// Writes any parameter struct as YAML that the reader of yaml_reader.hpp reads back to the same values.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/parameter_text.hpp"
#include "spf/math/parameters.hpp"

namespace spf {

/// Visitor for visit_fields; made by to_yaml.
class YamlWriter {
 public:
  template <class Value>
  void operator()(const char* name, const Value& value, const char*, Range, const char*) {
    line(name, to_text(value));
  }
  template <class Choice>
  void operator()(const char* name, const Choice& value, const char*) {
    line(name, to_text(value));
  }
  template <class Nested>
  void group(const char* name, const Nested& nested) {
    line(name, "");
    indent_ += "  ";
    Nested::visit_fields(nested, *this);
    indent_.resize(indent_.size() - 2);
  }
  template <class Nested>
  void optional_group(const char* name, const std::optional<Nested>& nested, const char*) {
    if (nested) group(name, *nested);
  }
  template <class Entry>
  void list(const char* name, const std::vector<Entry>& entries, const char*) {
    line(name, entries.empty() ? "[]" : "");
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
  void line(const char* name, const std::string& value) {
    std::string start = indent_;
    if (std::exchange(dash_, false)) start.replace(start.size() - 2, 2, "- ");
    text_ += start + name + ":" + (value.empty() ? "" : " ") + value + "\n";
  }

  std::string text_;
  std::string indent_;
  bool dash_ = false;  ///< the next line begins a list entry
};

template <class Parameters>
[[nodiscard]] std::string to_yaml(const Parameters& parameters) {
  YamlWriter writer;
  Parameters::visit_fields(parameters, writer);
  return writer.take();
}

}  // namespace spf
