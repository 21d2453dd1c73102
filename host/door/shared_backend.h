#pragma once
// Several backends that share each render.
#include "scene/testable_backend.h"

namespace facet {

/// A backend of several, at least one. The samples of a render are divided into 32 shares (the
/// largest power of two there is, where there are fewer samples); whoever is free renders the next
/// one, unless the others would be done before it. The films are added pair by pair in the order of
/// their samples, so that no bit depends on who rendered what, or how fast, where all round alike;
/// whether they do is tried with the first sample of every pixel, and told. A device that fails is
/// told, and the others go on. Renders end by their number of samples: start() throws InputError
/// where an error or a time is to end it, or where it is adaptive; such a render has no state.
[[nodiscard]] std::unique_ptr<Backend> share_renders(
    std::vector<std::unique_ptr<TestableBackend>> backends);

}  // namespace facet
