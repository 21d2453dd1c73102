#include "extremes/bsdf_models.h"

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <limits>

namespace facet::extremes {

namespace {

using Channels = std::array<Exact, 3>;

const Exact pi = boost::math::constants::pi<Exact>();

struct Vector {
  Exact x, y, z;

  explicit Vector(const vec3& v) : x(v.x), y(v.y), z(v.z) {}
  Vector(Exact vx, Exact vy, Exact vz) : x(std::move(vx)), y(std::move(vy)), z(std::move(vz)) {}
};

Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector operator*(const Exact& s, const Vector& v) { return {s * v.x, s * v.y, s * v.z}; }
Exact dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Channels channels(const Color& c) { return {Exact(c.r), Exact(c.g), Exact(c.b)}; }
Channels all(const Exact& x) { return {x, x, x}; }
Exact power5(const Exact& x) { return x * x * x * x * x; }

/// A rough surface's distribution and masking.
class Microfacets {
 public:
  Microfacets(const Exact& alpha, const bsdf::MicrofacetOptions& options)
      : alpha2_(alpha * alpha), options_(options) {}

  [[nodiscard]] Exact exponent(const Vector& h) const {
    return (h.x * h.x + h.y * h.y) / (h.z * h.z * alpha2_);
  }
  /// D of a half vector of any length on the upper side.
  [[nodiscard]] Exact d(const Vector& h) const {
    const Exact cos2 = h.z * h.z / dot(h, h);
    if (options_.distribution == bsdf::Distribution::ggx) {
      const Exact sum = cos2 * (1 + exponent(h));
      return 1 / (pi * alpha2_ * sum * sum);
    }
    return exp(-exponent(h)) / (pi * alpha2_ * cos2 * cos2);
  }
  [[nodiscard]] Exact g1(const Vector& w) const {
    const Exact tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    const Exact b2 = 1 / (alpha2_ * tan2);
    if (tan2 == 0) return 1;
    if (options_.distribution == bsdf::Distribution::ggx) return 2 / (1 + sqrt(1 + alpha2_ * tan2));
    const Exact b = sqrt(b2);
    if (options_.masking == Masking::exact) {
      if (b > 30) return 1;
      const Exact lambda = exp(-b2) / (2 * b * sqrt(pi)) - erfc(b) / 2;
      return 1 / (1 + lambda);
    }
    if (b >= Exact(16) / 10) return 1;
    return (Exact("3.535") * b + Exact("2.181") * b2) /
           (1 + Exact("2.276") * b + Exact("2.577") * b2);
  }

 private:
  Exact alpha2_;
  bsdf::MicrofacetOptions options_;
};

/// Unpolarised reflectance at cosine c from index `from` to `to`.
Exact fresnel(const Exact& c, const Exact& from, const Exact& to) {
  if (from == to) return 0;
  const Exact cos2 = 1 - (from / to) * (from / to) * (1 - c) * (1 + c);
  if (cos2 <= 0) return 1;
  const Exact t = sqrt(cos2);
  const Exact s = (from * c - to * t) / (from * c + to * t);
  const Exact p = (to * c - from * t) / (to * c + from * t);
  return (s * s + p * p) / 2;
}

/// A reflectance, and how far two ulp of the cosine move it: unit directions are rounded, and so
/// are their sum, its length and the product.
struct Reflectance {
  Channels values = all(0);
  Exact change = 0;

  Reflectance() = default;
  /// of(cosine), a function.
  template <typename Of>
  Reflectance(const Exact& cosine, const Of& of) : values(of(cosine)) {
    for (const double by : {-0x1p-22, 0x1p-22}) {
      const Channels near = of(std::min(Exact(cosine * (1 + by)), Exact(1)));
      for (std::size_t i = 0; i < 3; ++i)
        change = std::max(change, Exact(abs(near.at(i) - values.at(i))));
    }
  }
};

/// Of a dielectric.
Reflectance of_dielectric(const Exact& cosine, const Exact& from, const Exact& to) {
  return {cosine, [&](const Exact& c) { return all(fresnel(c, from, to)); }};
}

/// What a dielectric lets through.
Reflectance through_dielectric(const Exact& cosine, const Exact& from, const Exact& to) {
  return {cosine, [&](const Exact& c) { return all(1 - fresnel(c, from, to)); }};
}

/// Schlick's, of r0 at normal incidence.
Reflectance by_schlick(const Exact& cosine, const Channels& r0) {
  return {cosine, [&](const Exact& c) {
            Channels r = r0;
            for (Exact& x : r) x += (1 - x) * power5(1 - c);
            return r;
          }};
}

/// Of a pair on the upper side, with its half vector.
struct Reflection {
  Vector wo;
  Vector wi;
  Vector h;
  Exact cosine;  ///< between either direction and h, of unit vectors half the length of h

  explicit Reflection(const statistics::DirectionPair& p)
      : wo(p.wo), wi(p.wi), h(wo + wi), cosine(sqrt(dot(h, h)) / 2) {
    if (cosine > 1) cosine = 1;
  }
  /// D G / (4 cos_i cos_o).
  [[nodiscard]] Exact gloss(const Microfacets& m) const {
    return m.d(h) * m.g1(wi) * m.g1(wo) / (4 * wi.z * wo.z);
  }
};

/// Channel by channel: `gloss` times reflectance, and a base.
ExactValue sum_of(const Channels& base, const Exact& gloss, const Reflectance& reflectance,
                  const Exact& exponent) {
  ExactValue v;
  for (std::size_t i = 0; i < 3; ++i) {
    const Exact& r = reflectance.values.at(i);
    v.f.at(i) = base.at(i) + gloss * r;
    v.size.at(i) = base.at(i) + gloss * (r + 100000 * reflectance.change);
    if (v.f.at(i) > 0)
      v.cosine_change =
          std::max(v.cosine_change, static_cast<double>(gloss * reflectance.change / v.f.at(i)));
  }
  v.exponent = static_cast<double>(exponent);
  return v;
}

/// The diffuse base of Ashikhmin and Shirley.
Channels base_under(const Reflection& r, const Channels& albedo, const Channels& coat) {
  const auto under = [](const Exact& c) { return Exact(1 - power5(1 - c / 2)); };
  const Exact shape = 28 / (23 * pi) * under(r.wi.z) * under(r.wo.z);
  Channels result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = shape * albedo[i] * (1 - coat[i]);
  return result;
}

bool is_above(const statistics::DirectionPair& p) { return p.wo.z > 0 && p.wi.z > 0; }

using Result = std::optional<ExactValue>;
using statistics::DirectionPair;

Result value(const bsdf::Diffuse& b, const DirectionPair& p) {
  if (!is_above(p)) return ExactValue();
  Channels f = channels(b.albedo.value);
  for (Exact& x : f) x /= pi;
  return sum_of(f, 0, Reflectance(), 0);
}

Result value(const bsdf::Mirror& /*b*/, const DirectionPair& /*p*/) { return ExactValue(); }
Result value(const bsdf::Dielectric& /*b*/, const DirectionPair& /*p*/) { return ExactValue(); }

Result value(const bsdf::RoughConductor& b, const DirectionPair& p) {
  if (b.multiscatter || b.ior()) return {};
  if (!is_above(p)) return ExactValue();
  const Reflection r(p);
  const Microfacets m(b.alpha.value, b.options);
  return sum_of(all(0), r.gloss(m), by_schlick(r.cosine, channels(b.r0.value)), m.exponent(r.h));
}

Result value(const bsdf::Microfacet& b, const DirectionPair& p) {
  if (!is_above(p)) return ExactValue();
  const Reflection r(p);
  const Microfacets m(b.alpha, b.options);
  Channels base = channels(b.kd);
  const Exact share = 1 - std::max({base[0], base[1], base[2]});
  for (Exact& x : base) x /= pi;
  return sum_of(base, share * r.gloss(m), of_dielectric(r.cosine, b.ext_ior, b.int_ior),
                m.exponent(r.h));
}

Result value(const bsdf::RoughSubstrate& b, const DirectionPair& p) {
  if (!is_above(p)) return ExactValue();
  const Reflection r(p);
  const Microfacets m(b.alpha.value, b.options);
  const Exact root = (Exact(b.ext_ior) - b.int_ior) / (Exact(b.ext_ior) + b.int_ior);
  return sum_of(base_under(r, channels(b.kd.value), all(root * root)), r.gloss(m),
                of_dielectric(r.cosine, b.ext_ior, b.int_ior), m.exponent(r.h));
}

Result value(const bsdf::FresnelBlend& b, const DirectionPair& p) {
  if (!is_above(p)) return ExactValue();
  const Reflection r(p);
  const Microfacets m(b.alpha.value, b.options);
  const Channels rs = channels(b.rs.value);
  const Exact gloss =
      r.cosine > 0 ? Exact(m.d(r.h) / (4 * r.cosine * std::max(r.wi.z, r.wo.z))) : Exact(0);
  return sum_of(base_under(r, channels(b.rd.value), rs), gloss, by_schlick(r.cosine, rs),
                m.exponent(r.h));
}

/// Walter et al. 2007, equations 20 and 21.
Result value(const bsdf::RoughDielectric& b, const DirectionPair& p) {
  if (b.ext_ior == b.int_ior) return ExactValue();
  const bool from_above = p.wo.z > 0;
  const bool reflects = from_above == (p.wi.z > 0);
  const Exact eta_o = from_above ? b.ext_ior : b.int_ior;
  const Exact eta_i = p.wi.z > 0 ? b.ext_ior : b.int_ior;
  const Exact beyond = from_above ? b.int_ior : b.ext_ior;
  const Vector wo(p.wo);
  const Vector wi(p.wi);
  Vector h = reflects ? wo + wi : eta_o * wo + eta_i * wi;
  if (h.z < 0) h = Exact(-1) * h;
  const Exact length = sqrt(dot(h, h));
  if (h.z == 0) return ExactValue();
  const Microfacets m(b.alpha.value, b.options);
  const Exact exponent = m.exponent(h);
  const Exact dg = m.d(h) * m.g1(wi) * m.g1(wo);
  ExactValue v;
  if (reflects) {
    const Exact cosine = std::min(Exact(length / 2), Exact(1));
    const Exact sided = dg / (4 * abs(wi.z * wo.z));
    v = sum_of(all(0), sided, of_dielectric(cosine, eta_o, beyond), exponent);
  } else {
    const Exact o = dot(wo, h) / length;
    const Exact i = dot(wi, h) / length;
    if (o / wo.z <= 0 || i / wi.z <= 0) return ExactValue();
    const Exact sum = eta_i * i + eta_o * o;
    const Exact sided = abs(i * o) / abs(wi.z * wo.z) * eta_o * eta_o * dg / (sum * sum);
    v = sum_of(all(0), sided, through_dielectric(abs(o), eta_o, eta_i), exponent);
    v.refracts = true;
  }
  const Channels tint = channels(b.ka.value);
  for (std::size_t k = 0; k < 3; ++k) v.f[k] *= tint[k], v.size[k] *= tint[k];
  return v;
}

/// One that nobody has written down here.
template <typename T>
Result value(const T& /*b*/, const DirectionPair& /*p*/) {
  return {};
}

/// The neighbour of a component, in direction of `sign`.
void round_component(vec3& v, int component, float sign) {
  v[component] = std::nextafter(v[component], sign * std::numeric_limits<float>::infinity());
}

}  // namespace

double change_by_rounding(const BsdfCase& c, const statistics::DirectionPair& pair, RelativeTo to) {
  const std::optional<ExactValue> right = exact_value(c, pair);
  if (!right) return 0;
  double sum = 0;
  for (int component = 0; component < 6; ++component) {
    double largest = 0;
    for (const float sign : {-1.0F, 1.0F}) {
      statistics::DirectionPair moved = pair;
      round_component(component < 3 ? moved.wo : moved.wi, component % 3, sign);
      const std::optional<ExactValue> value = exact_value(c, moved);
      for (std::size_t i = 0; i < 3; ++i) {
        const Exact change = abs(value->f.at(i) - right->f.at(i));
        const Exact& whole = to == RelativeTo::value ? right->f.at(i) : right->size.at(i);
        if (change != 0) largest = std::max(largest, static_cast<double>(change / whole));
      }
    }
    sum += largest;
  }
  return sum;
}

double change_by_cosine(const BsdfCase& c, const DirectionPair& pair) {
  if (const std::optional<ExactValue> right = exact_value(c, pair)) return right->cosine_change;
  const auto* metal = std::get_if<bsdf::RoughConductor>(&c.bsdf);
  if (metal == nullptr || metal->ior() || !is_above(pair)) return 0;
  const Reflectance r = by_schlick(Reflection(pair).cosine, channels(metal->r0.value));
  double largest = 0;
  for (const Exact& value : r.values) {
    if (value > 0) largest = std::max(largest, static_cast<double>(r.change / value));
  }
  return largest;
}

std::optional<ExactValue> exact_value(const BsdfCase& c, const DirectionPair& pair) {
  return std::visit([&](const auto& b) { return value(b, pair); }, c.bsdf);
}

}  // namespace facet::extremes
