#pragma once
// The reference: the whole path from scene to film on the CPU, in float or in double, written from
// docs/reference/sampling.md and the papers and sharing no code with the kernels.
#include "scene/testable_backend.h"

namespace facet::reference {

/// LobeSampling::uniform ignores all sampling code of the BSDFs.
[[nodiscard]] std::unique_ptr<TestableBackend> make_backend(Precision precision);

}  // namespace facet::reference
