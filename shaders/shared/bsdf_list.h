// Every BSDF, once: X(name, Type, id). The ids, the GLSL dispatch (shaders/lib/bsdf.glsl), the
// host's readers and packers (host/scene/bsdf) and the tests all follow from this list. `name` is
// the scene language's type, `Type` its parameters' type in C++.
#ifndef FACET_SHARED_BSDF_LIST_H
#define FACET_SHARED_BSDF_LIST_H

#define FACET_BSDF_LIST(X)             \
  X(diffuse, Diffuse, 0)               \
  X(roughconductor, RoughConductor, 1) \
  X(roughsubstrate, RoughSubstrate, 2) \
  X(mirror, Mirror, 3)                 \
  X(dielectric, Dielectric, 4)         \
  X(microfacet, Microfacet, 5)         \
  X(fresnelblend, FresnelBlend, 6)     \
  X(roughdielectric, RoughDielectric, 7)

#endif
