// The formats of recorded people, each read line by line into a CrowdCollector. Any problem is told; the next
// line is read all the same.
#pragma once

#include <memory>
#include <string_view>

#include "study/crowd_collector.hpp"

namespace spf {

class CrowdFormat {
 public:
  virtual ~CrowdFormat() = default;
  /// Reads a line without its end. False when no further line can be understood.
  [[nodiscard]] virtual bool read(std::string_view line, CrowdCollector& collector) = 0;
};

/// The format of a file by its first line that is not blank: JSON objects (TrajNet++), numbers between blanks
/// (obsmat of ETH, or frame, id, x, y), else columns with names.
[[nodiscard]] std::unique_ptr<CrowdFormat> crowd_format_of(std::string_view first_line);

}  // namespace spf
