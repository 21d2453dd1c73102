#pragma once
// Allocations of the whole program, its libraries' included.

namespace facet::cli {

/// From now on an allocation that is refused throws OutOfMemory, which says what it was for and how
/// much. The program ends with a line, and exit code 3, where the exception would pass through a
/// library that was loaded later, as a device's driver: few can take it, and some then hang.
/// Before, while libraries are set up, nobody could catch it, and the program ends likewise.
void expect_refused_allocations();

}  // namespace facet::cli
