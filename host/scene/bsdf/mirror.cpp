#include "scene/bsdf/mirror.h"

#include "scene/xml/property_reader.h"

namespace facet::bsdf {

Mirror Mirror::read(PropertyReader& /*properties*/) { return {}; }

shared::BsdfRecord Mirror::pack() const {
  shared::BsdfRecord r = empty_record();
  r.flags = shared::BSDF_DELTA;
  return r;
}

}  // namespace facet::bsdf
