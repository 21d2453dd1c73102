#include "sky.h"

#include <ImfRgbaFile.h>

#include <numbers>
#include <vector>

#include "asset_file.h"
#include "vec3.h"

namespace facet::generate {
namespace {

constexpr int width = 1024;
constexpr int height = 512;

constexpr double turbidity = 3.0;
constexpr double sun_elevation = 38.0 * std::numbers::pi / 180.0;
/// From +x towards +z: the sun stands to the right of and behind a camera that looks along -z.
constexpr double sun_azimuth = 50.0 * std::numbers::pi / 180.0;
/// Twice the real sun's, so that the disc is some twenty texels.
constexpr double sun_radius = 1.0 * std::numbers::pi / 180.0;

constexpr double sky_irradiance =
    1.7;  ///< Of the horizontal ground, by the sky alone, in luminance.
constexpr double sun_irradiance = 3.0;  ///< Of a surface that faces the sun.
constexpr Vec3 sun_colour{1.08, 0.99, 0.84};
constexpr Vec3 ground_albedo{0.20, 0.18, 0.15};

/// One quantity of the sky model: its zenith value and the five coefficients of Perez's
/// distribution.
struct Perez {
  double zenith;
  double a, b, c, d, e;

  /// `theta` from the zenith, `gamma` from the sun, both in radians.
  double shape(double cos_theta, double gamma) const {
    const double cos_gamma = std::cos(gamma);
    return (1 + a * std::exp(b / cos_theta)) *
           (1 + c * std::exp(d * gamma) + e * cos_gamma * cos_gamma);
  }

  double at(double cos_theta, double gamma) const {
    const double sun_zenith = 0.5 * std::numbers::pi - sun_elevation;
    return zenith * shape(cos_theta, gamma) / shape(1.0, sun_zenith);
  }
};

/// The zenith's chromaticity: a cubic in the sun's zenith angle, its coefficients quadratic in the
/// turbidity.
double zenith_chromaticity(const double (&m)[3][4]) {
  const double s = 0.5 * std::numbers::pi - sun_elevation;
  double result = 0;
  const double powers[3] = {turbidity * turbidity, turbidity, 1.0};
  for (int i = 0; i < 3; ++i)
    result += powers[i] * (((m[i][0] * s + m[i][1]) * s + m[i][2]) * s + m[i][3]);
  return result;
}

/// Preetham, Shirley and Smits, "A Practical Analytic Model for Daylight" (1999), appendix A.2.
struct DaylightModel {
  Perez luminance;
  Perez x;
  Perez y;
};

DaylightModel make_daylight() {
  constexpr double t = turbidity;
  constexpr double x_matrix[3][4] = {{0.00166, -0.00375, 0.00209, 0.0},
                                     {-0.02903, 0.06377, -0.03202, 0.00394},
                                     {0.11693, -0.21196, 0.06052, 0.25886}};
  constexpr double y_matrix[3][4] = {{0.00275, -0.00610, 0.00317, 0.0},
                                     {-0.04214, 0.08970, -0.04153, 0.00516},
                                     {0.15346, -0.26756, 0.06670, 0.26688}};
  return {{1.0, 0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
           0.1206 * t - 2.5771, -0.0670 * t + 0.3703},
          {zenith_chromaticity(x_matrix), -0.0193 * t - 0.2592, -0.0665 * t + 0.0008,
           -0.0004 * t + 0.2125, -0.0641 * t - 0.8989, -0.0033 * t + 0.0452},
          {zenith_chromaticity(y_matrix), -0.0167 * t - 0.2608, -0.0950 * t + 0.0092,
           -0.0079 * t + 0.2102, -0.0441 * t - 1.6537, -0.0109 * t + 0.0529}};
}

Vec3 sun_direction() {
  return {std::cos(sun_azimuth) * std::cos(sun_elevation), std::sin(sun_elevation),
          std::sin(sun_azimuth) * std::cos(sun_elevation)};
}

/// Linear Rec. 709 from chromaticity and luminance; out-of-gamut values are clipped at 0.
Vec3 rgb_from_xyy(double x, double y, double luminance) {
  const double big_x = x / y * luminance;
  const double big_z = (1 - x - y) / y * luminance;
  return {std::max(0.0, 3.2406 * big_x - 1.5372 * luminance - 0.4986 * big_z),
          std::max(0.0, -0.9689 * big_x + 1.8758 * luminance + 0.0415 * big_z),
          std::max(0.0, 0.0557 * big_x - 0.2040 * luminance + 1.0570 * big_z)};
}

double luminance_of(Vec3 c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

Vec3 sky_radiance(const DaylightModel& model, Vec3 direction) {
  // The model has a pole at the horizon; a little above it is what the eye sees there anyway.
  const double cos_theta = std::max(direction.y, 0.02);
  const double gamma = std::acos(std::clamp(dot(direction, sun_direction()), -1.0, 1.0));
  return rgb_from_xyy(model.x.at(cos_theta, gamma), model.y.at(cos_theta, gamma),
                      model.luminance.at(cos_theta, gamma));
}

/// The direction at a position inside the image, in texels from its corner.
Vec3 direction_at(double column, double row) {
  const double phi = 2.0 * std::numbers::pi * (1.0 - column / width);
  const double theta = std::numbers::pi * (1.0 - row / height);
  return {std::cos(phi) * std::sin(theta), std::cos(theta), std::sin(phi) * std::sin(theta)};
}

/// The sun's share of a texel in [0, 1], by supersampling, so that its disc has a soft rim.
double sun_coverage(int column, int row) {
  constexpr int grid = 8;
  const double limit = std::cos(sun_radius);
  int hits = 0;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      const Vec3 d = direction_at(column + (i + 0.5) / grid, row + (j + 0.5) / grid);
      hits += dot(d, sun_direction()) > limit ? 1 : 0;
    }
  }
  return hits / static_cast<double>(grid * grid);
}

struct SkyImage {
  std::vector<Vec3> texels = std::vector<Vec3>(static_cast<std::size_t>(width) * height);
  Vec3& at(int column, int row) {
    return texels[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)];
  }
};

/// Fills the upper half with sky of the wanted irradiance; returns that irradiance as a colour.
Vec3 paint_sky(SkyImage& image) {
  const DaylightModel model = make_daylight();
  Vec3 irradiance;
  for (int row = height / 2; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const Vec3 direction = direction_at(column + 0.5, row + 0.5);
      const Vec3 radiance = sky_radiance(model, direction);
      const double solid_angle = (2 * std::numbers::pi / width) * (std::numbers::pi / height) *
                                 std::sqrt(1 - direction.y * direction.y);
      irradiance = irradiance + radiance * (solid_angle * direction.y);
      image.at(column, row) = radiance;
    }
  }
  const double factor = sky_irradiance / luminance_of(irradiance);
  for (Vec3& texel : image.texels) texel = texel * factor;
  return irradiance * factor;
}

void paint_ground(SkyImage& image, Vec3 sky) {
  const double sun = sun_irradiance * std::sin(sun_elevation);
  const Vec3 total{sky.x + sun * sun_colour.x, sky.y + sun * sun_colour.y,
                   sky.z + sun * sun_colour.z};
  const Vec3 reflected{total.x * ground_albedo.x / std::numbers::pi,
                       total.y * ground_albedo.y / std::numbers::pi,
                       total.z * ground_albedo.z / std::numbers::pi};
  for (int row = 0; row < height / 2; ++row) {
    for (int column = 0; column < width; ++column) image.at(column, row) = reflected;
  }
}

void paint_sun(SkyImage& image) {
  const double radiance =
      sun_irradiance / (std::numbers::pi * std::sin(sun_radius) * std::sin(sun_radius));
  const double texels_per_radian = height / std::numbers::pi;
  const int centre = static_cast<int>((0.5 + sun_elevation / std::numbers::pi) * height);
  const int margin = static_cast<int>(sun_radius * texels_per_radian) + 2;
  for (int row = centre - margin; row <= centre + margin; ++row) {
    for (int column = 0; column < width; ++column) {
      image.at(column, row) =
          image.at(column, row) + sun_colour * (radiance * sun_coverage(column, row));
    }
  }
}

}  // namespace

void write_sky(const std::filesystem::path& file) {
  SkyImage image;
  paint_ground(image, paint_sky(image));
  paint_sun(image);
  std::vector<Imf::Rgba> pixels;
  pixels.reserve(image.texels.size());
  for (const Vec3& c : image.texels) {
    pixels.emplace_back(static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z));
  }
  replace_file(file, [&pixels](const std::filesystem::path& temporary) {
    Imf::RgbaOutputFile output(temporary.c_str(), width, height, Imf::WRITE_RGB);
    output.setFrameBuffer(pixels.data(), 1, static_cast<std::size_t>(width));
    output.writePixels(height);
  });
}

}  // namespace facet::generate
