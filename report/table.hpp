// A table as text for the terminal, or Markdown for documents.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace spf {

enum class Alignment { left, right };

struct TableColumn {
  std::string header;  ///< with the unit: "travel time [s]"
  Alignment alignment = Alignment::right;
};

class Table {
 public:
  explicit Table(std::vector<TableColumn> columns);

  /// Throws std::invalid_argument unless there is one cell for every column.
  void add_row(std::vector<std::string> cells);

  /// Aligned columns, a rule under the header, no trailing blanks; widths count characters (UTF-8 code
  /// points).
  [[nodiscard]] std::string to_text() const;
  /// GitHub's pipe table; pipes and line breaks inside cells are escaped.
  [[nodiscard]] std::string to_markdown() const;

 private:
  std::vector<TableColumn> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// A number with this many decimals; "-" when it is not finite. Never "-0.00".
[[nodiscard]] std::string fixed(double value, int decimals);

}  // namespace spf
