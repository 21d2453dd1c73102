#pragma once
// Allocations of the whole program, its libraries' included.

namespace facet::cli {

/// From now on an allocation that is refused ends the program with a line that says what it was
/// for and how much, and exit code 2; before, while libraries are set up, with a shorter one. No
/// exception is thrown: few libraries let one pass, and drivers and OpenEXR then wait for ever.
void tell_of_refused_allocations();

}  // namespace facet::cli
