#include "report/table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace spf {
namespace {

Table sample() {
  Table table{{{"method", Alignment::left}, {"SR [%]"}, {"time [s]"}}};
  table.add_row({"spf_empc", "56", "31.20"});
  table.add_row({"ES2*, \"quoted\" | piped", "2", "\xC2\xB1 1"});
  return table;
}

TEST(Table, TextIsAlignedByCharactersNotBytes) {
  EXPECT_EQ(sample().to_text(),
            "method                  SR [%]  time [s]\n"
            "----------------------  ------  --------\n"
            "spf_empc                    56     31.20\n"
            "ES2*, \"quoted\" | piped       2       \xC2\xB1 1\n");
}

TEST(Table, TextHasNoTrailingBlanks) {
  Table table{{{"a", Alignment::left}, {"b", Alignment::left}}};
  table.add_row({"long cell", ""});
  EXPECT_EQ(table.to_text(), "a          b\n---------  -\nlong cell\n");
}

TEST(Table, MarkdownEscapesPipesAndMarksAlignment) {
  EXPECT_EQ(sample().to_markdown(),
            "| method                  | SR [%] | time [s] |\n"
            "| ----------------------- | -----: | -------: |\n"
            "| spf_empc                |     56 |    31.20 |\n"
            "| ES2*, \"quoted\" \\| piped |      2 |      \xC2\xB1 1 |\n");
}

TEST(Table, RefusesRowsOfAnotherLength) {
  Table table = sample();
  EXPECT_THROW(table.add_row({"one"}), std::invalid_argument);
  EXPECT_THROW(Table{{}}, std::invalid_argument);
}

TEST(Fixed, WritesPlainNumbers) {
  EXPECT_EQ(fixed(3.14159, 2), "3.14");
  EXPECT_EQ(fixed(-0.001, 2), "0.00");
  EXPECT_EQ(fixed(-0.006, 2), "-0.01");
  EXPECT_EQ(fixed(12.0, 0), "12");
  EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 2), "-");
  EXPECT_EQ(fixed(std::numeric_limits<double>::max(), 17).size(), 309U + 18U);
}

}  // namespace
}  // namespace spf
