// One finished trial as Python sees it.
#pragma once

#include <memory>

#include "experiments/trial_record.hpp"
#include "python/bind.hpp"
#include "sim/recording.hpp"
#include "study/scenario_file.hpp"

namespace spf::python {

struct Trial {
  TrialRecord record;
  std::shared_ptr<const sim::Recording> recording;  ///< null unless asked for
  std::shared_ptr<const RunConfiguration> config;   ///< of what was recorded
};

/// A line of JSON as a dict.
[[nodiscard]] py::object from_json(const std::string& line);

void bind_recording(py::module_& module);

}  // namespace spf::python
