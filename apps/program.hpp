// The spf program as a function, for programs with further methods (docs/add_a_method.md).
#pragma once

#include "spf/team/method_table.hpp"

namespace spf {

/// Runs the command line; returns the exit status. Never throws.
[[nodiscard]] int run_program(int argc, char** argv, const MethodTable& methods = {});

}  // namespace spf
