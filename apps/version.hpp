// Version of the program.
#pragma once

namespace spf {

extern const char* const
    kCommit;  ///< of the sources, with -dirty when they were changed; "unknown" outside a checkout

[[nodiscard]] const char* version();   ///< "0.2.0"
[[nodiscard]] const char* compiler();  ///< "GNU 12.2.0, Release"

}  // namespace spf
