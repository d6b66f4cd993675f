// Ctrl-C and SIGTERM as a flag that long computations poll.
#pragma once

namespace spf {

/// From now on the first SIGINT or SIGTERM asks the program to stop; a second one ends it at once.
void catch_interrupts();
[[nodiscard]] bool interrupted();

/// Exit status of a run that was interrupted, by the convention of shells.
inline constexpr int kInterruptedStatus = 130;

}  // namespace spf
