#include "curls.h"

#include <numbers>

#include "distance.h"

namespace facet::generate {
namespace {

constexpr double slab_height = 0.1;
constexpr double blend = 0.03;
constexpr double reach = 1.6;  ///< In curl radii: beyond it a curl cannot be blended with anything.

}  // namespace

Curls::Curls(std::vector<Curl> curls) {
  double highest = -1e9;
  lowest_ = 1e9;
  for (const Curl& curl : curls) {
    lowest_ = std::min(lowest_, curl.centre.y - reach * curl.radius);
    highest = std::max(highest, curl.centre.y + reach * curl.radius);
  }
  slabs_.resize(curls.empty() ? 0
                              : static_cast<std::size_t>((highest - lowest_) / slab_height) + 1);
  for (const Curl& curl : curls) {
    const Vec3 helper = std::abs(curl.outward.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    const Vec3 tangent = normalize(cross(helper, curl.outward));
    const double first = (curl.centre.y - reach * curl.radius - lowest_) / slab_height;
    const double last = (curl.centre.y + reach * curl.radius - lowest_) / slab_height;
    for (auto slab = static_cast<std::size_t>(std::max(first, 0.0));
         slab <= static_cast<std::size_t>(last); ++slab) {
      slabs_[slab].push_back(curls_.size());
    }
    curls_.push_back({curl, tangent, cross(curl.outward, tangent)});
  }
}

double Curls::distance(Vec3 p, double far_away) const {
  const double slab = (p.y - lowest_) / slab_height;
  if (slab < 0 || slab >= static_cast<double>(slabs_.size())) return far_away;
  double nearest = far_away;
  for (const std::size_t index : slabs_[static_cast<std::size_t>(slab)]) {
    const Placed& placed = curls_[index];
    const Vec3 offset = p - placed.curl.centre;
    const double limit = reach * placed.curl.radius;
    if (dot(offset, offset) < limit * limit)
      nearest = join(nearest, distance_to(placed, offset), blend);
  }
  return nearest;
}

double Curls::distance_to(const Placed& placed, Vec3 offset) {
  const Curl& curl = placed.curl;
  const double s = dot(offset, placed.tangent);
  const double t = dot(offset, placed.bitangent);
  const double height = dot(offset, curl.outward);
  const double across = std::hypot(s, t);
  const double knob = std::sqrt(across * across + 1.5 * height * height) - curl.radius;
  // One and a half turns from rim to centre; the groove fades at the centre, where the angle is
  // undefined.
  const double angle =
      curl.handed * std::atan2(t, s) + curl.turn + 3.0 * std::numbers::pi * across / curl.radius;
  const double groove = 0.5 + 0.5 * std::cos(angle);
  return knob + 0.3 * curl.radius * groove * groove * smooth_step(0.05, 0.35, across / curl.radius);
}

}  // namespace facet::generate
