// The figures of the paper's Tables 2 and 3, to be printed beside ours.
#pragma once

#include <string_view>

namespace spf {

/// Mean, minimum, standard deviation, as the paper prints them.
struct PaperTriple {
  double mean, minimum, deviation;
};

struct PaperTable2Row {
  double level;                      ///< [1] multiple of Sigma
  std::string_view method;           ///< our name
  std::string_view label;            ///< the paper's
  double success, timeout;           ///< [%]
  PaperTriple distance, path, time;  ///< [m], [m], [s]
  double iterations;                 ///< optimiser calls per robot and trial
};

struct PaperTable3Row {
  std::string_view condition;  ///< of scenarios/experiments/table3.yaml
  std::string_view method;
  std::string_view label;
  double success, timeout;  ///< [%]
  double time;              ///< [s]
};

/// Null when the paper has no such row.
[[nodiscard]] const PaperTable2Row* paper_table2(double level, std::string_view method);
[[nodiscard]] const PaperTable3Row* paper_table3(std::string_view condition, std::string_view method);

}  // namespace spf
