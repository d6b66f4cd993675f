// A scenario file as Python sees it: where it comes from, and what it says. Immutable.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "python/bind.hpp"
#include "study/scenario_file.hpp"

namespace spf::python {

/// {"noise.level": 1} as settings that are written over a file's; keys nest ({"noise": {"level": 1}}).
[[nodiscard]] std::vector<Setting> settings_from(const py::dict& settings);
/// A value as a file would write it: 1, true, walk, [0, 1], none.
[[nodiscard]] std::string value_text(py::handle value);

class ScenarioFile {
 public:
  [[nodiscard]] static ScenarioFile load(const std::string& path, const std::vector<Setting>& settings,
                                         const MethodTable& methods);
  /// `name` stands for the file in messages.
  [[nodiscard]] static ScenarioFile from_text(const std::string& text, const std::string& name,
                                              const std::vector<Setting>& settings,
                                              const MethodTable& methods);
  /// Read again with more settings: defaults that depend on them follow.
  [[nodiscard]] ScenarioFile changed(const std::vector<Setting>& settings) const;

  [[nodiscard]] const RunConfiguration& config() const { return *config_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  ScenarioFile() = default;
  void read();

  std::string name_;  // path of the file, where there is no text
  std::string text_;
  bool is_text_ = false;
  std::vector<Setting> settings_;
  MethodTable methods_;
  std::shared_ptr<const RunConfiguration> config_;
};

}  // namespace spf::python
