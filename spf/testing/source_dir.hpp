// Where the repository lies, for tests that read its files.
#pragma once

#include <string>

namespace spf {

/// Absolute path, without a slash at its end. Compiled into one object alone, so that a compiler cache knows
/// all others wherever the repository lies.
[[nodiscard]] std::string source_dir();

}  // namespace spf
