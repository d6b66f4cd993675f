#include "report/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace spf {
namespace {

using Cells = std::vector<std::string>;

/// Characters on the screen: every byte that does not continue a UTF-8 character.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string padded(const std::string& cell, std::size_t to_width, Alignment alignment) {
  const std::string blanks(to_width - std::min(to_width, width(cell)), ' ');
  return alignment == Alignment::left ? cell + blanks : blanks + cell;
}

std::string one_line(std::string_view cell) {
  std::string line{cell};
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return line;
}

std::string markdown_cell(const std::string& cell) {
  std::string safe;
  for (const char character : one_line(cell)) {
    if (character == '|' || character == '\\') safe += '\\';
    safe += character;
  }
  return safe;
}

Cells headers(const std::vector<TableColumn>& columns) {
  Cells names;
  for (const TableColumn& column : columns) names.push_back(column.header);
  return names;
}

/// Header first, then the rows, each cell changed by `change`.
template <class Change>
std::vector<Cells> all_lines(const std::vector<TableColumn>& columns, const std::vector<Cells>& rows,
                             Change change) {
  std::vector<Cells> lines{headers(columns)};
  lines.insert(lines.end(), rows.begin(), rows.end());
  for (Cells& line : lines) {
    for (std::string& cell : line) cell = change(cell);
  }
  return lines;
}

std::vector<std::size_t> widths(const std::vector<Cells>& lines, std::size_t least) {
  std::vector<std::size_t> widest(lines.front().size(), least);
  for (const Cells& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widest[i] = std::max(widest[i], width(line[i]));
  }
  return widest;
}

}  // namespace

Table::Table(std::vector<TableColumn> columns) : columns_{std::move(columns)} {
  if (columns_.empty()) throw std::invalid_argument("a table needs at least one column");
}

void Table::add_row(std::vector<std::string> cells) {
  if (cells.size() != columns_.size()) {
    throw std::invalid_argument("table row has " + std::to_string(cells.size()) + " cells, expected " +
                                std::to_string(columns_.size()));
  }
  rows_.push_back(std::move(cells));
}

std::string Table::to_text() const {
  const std::vector<Cells> lines =
      all_lines(columns_, rows_, [](const std::string& cell) { return one_line(cell); });
  const std::vector<std::size_t> widest = widths(lines, 0);
  std::string text;
  for (std::size_t row = 0; row < lines.size(); ++row) {
    std::string line;
    std::string rule;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const std::string gap = i == 0 ? "" : "  ";
      line += gap + padded(lines[row][i], widest[i], columns_[i].alignment);
      rule += gap + std::string(widest[i], '-');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
    if (row == 0) text += rule + '\n';
  }
  return text;
}

std::string Table::to_markdown() const {
  const std::vector<Cells> lines = all_lines(columns_, rows_, markdown_cell);
  const std::vector<std::size_t> widest = widths(lines, 3);
  std::string text;
  for (std::size_t row = 0; row < lines.size(); ++row) {
    std::string rule;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const bool left = columns_[i].alignment == Alignment::left;
      text += "| " + padded(lines[row][i], widest[i], columns_[i].alignment) + ' ';
      rule += "| " + std::string(widest[i] - 1, '-') + (left ? "- " : ": ");
    }
    text += "|\n";
    if (row == 0) text += rule + "|\n";
  }
  return text;
}

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 400> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", std::clamp(decimals, 0, 17), value);
  std::string text{buffer.data()};
  const bool is_zero = text.find_first_of("123456789") == std::string::npos;
  if (is_zero && text.front() == '-') text.erase(0, 1);
  return text;
}

}  // namespace spf
