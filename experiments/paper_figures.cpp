#include "experiments/paper_figures.hpp"

#include <array>

namespace spf {
namespace {

constexpr std::array<PaperTable2Row, 9> kTable2{{
    {0.25, "es2", "ES2", 14, 0, {2.30, 0.67, 1.70}, {25.43, 25.13, 0.44}, {34.22, 32.00, 4.15}, 253.74},
    {0.25,
     "es2_constant_velocity",
     "ES2*",
     76,
     10,
     {1.76, 0.97, 1.11},
     {26.41, 25.15, 1.29},
     {35.30, 31.01, 2.71},
     69.92},
    {0.25, "spf_empc", "Ours", 72, 2, {1.52, 0.62, 0.85}, {27.17, 25.14, 2.42}, {38.83, 32.00, 7.02}, 58.4},
    {1.0, "es2", "ES2", 10, 0, {1.50, 0.73, 0.79}, {25.62, 25.15, 0.44}, {31.80, 31.00, 0.57}, 270.16},
    {1.0,
     "es2_constant_velocity",
     "ES2*",
     62,
     4,
     {1.41, 0.85, 3.41},
     {26.53, 25.28, 1.33},
     {36.08, 31.50, 3.59},
     92.52},
    {1.0, "spf_empc", "Ours", 56, 2, {1.38, 0.69, 0.62}, {29.64, 25.18, 4.44}, {39.34, 33.50, 5.10}, 55.78},
    {2.0, "es2", "ES2", 12, 2, {1.39, 0.57, 0.68}, {26.21, 25.20, 1.28}, {33.33, 31.50, 1.57}, 300.96},
    {2.0,
     "es2_constant_velocity",
     "ES2*",
     52,
     4,
     {1.39, 0.57, 0.68},
     {27.37, 25.46, 1.88},
     {38.33, 33.00, 5.37},
     101.74},
    {2.0, "spf_empc", "Ours", 40, 2, {1.47, 0.53, 1.01}, {29.35, 25.17, 3.71}, {39.60, 31.50, 5.35}, 60.36},
}};

constexpr std::array<PaperTable3Row, 5> kTable3{{
    {"0 Sigma'", "spf_empc_without_self_sampling", "SPF-EMPC w/o SS", 48, 0, 47.50},
    {"0 Sigma'", "spf_empc_without_field", "SPF-EMPC w/o SPF", 56, 4, 30.00},
    {"0 Sigma'", "spf_empc", "Ours", 86, 2, 33.12},
    {"1 Sigma'", "spf_empc_without_observer", "SPF-EMPC w/o ESO", 42, 2, 76.43},
    {"1 Sigma'", "spf_empc", "Ours", 88, 0, 33.42},
}};

}  // namespace

const PaperTable2Row* paper_table2(double level, std::string_view method) {
  for (const PaperTable2Row& row : kTable2)
    if (row.level == level && row.method == method) return &row;
  return nullptr;
}

const PaperTable3Row* paper_table3(std::string_view condition, std::string_view method) {
  for (const PaperTable3Row& row : kTable3)
    if (row.condition == condition && row.method == method) return &row;
  return nullptr;
}

}  // namespace spf
