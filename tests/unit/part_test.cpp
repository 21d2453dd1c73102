// Parts: sums go to floats and come back, whatever their size.
#include "parts/part.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "image/files.h"
#include "image/film.h"
#include "image/record.h"
#include "support/input.h"

namespace facet {

namespace {

using test::expect_message;
using test::input_error_of;

constexpr std::uint32_t most = 1U << 30U;
constexpr double inf = std::numeric_limits<double>::infinity();

Film make_row(const std::vector<PixelSums>& pixels, bool with_squares) {
  const int width = static_cast<int>(pixels.size());
  Film film = make_film(width, 1, {0, 0, width, 1}, with_squares);
  film.pixels = pixels;
  return film;
}

PixelSums make_sums(double value, std::uint32_t samples = 1000) {
  PixelSums sums;
  sums.values = {value, 0.5 * value, -value};
  sums.squares = {value * value, 0.25 * value * value, value * value};
  sums.samples = samples;
  sums.nonzero = samples / 3;
  return sums;
}

Film there_and_back(const Film& film) {
  return film_of_part(make_part(film, film.has_squares), most, "a.exr");
}

/// Expects |a - b| <= 2^-49 |a| for every sum.
void expect_close(const Film& a, const Film& b) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = a.pixels[i].values[c];
      const double square = a.pixels[i].squares[c];
      EXPECT_LE(std::abs(value - b.pixels[i].values[c]), 0x1p-49 * std::abs(value)) << value;
      const double lost = a.has_squares ? std::abs(square - b.pixels[i].squares[c]) : 0;
      EXPECT_LE(lost, 0x1p-49 * square) << square;
    }
    EXPECT_EQ(a.pixels[i].samples, b.pixels[i].samples);
    EXPECT_EQ(a.pixels[i].nonzero, b.pixels[i].nonzero);
  }
}

/// Sums without a pattern, of magnitudes 10^low to 10^high.
Film random_film(double low, double high) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(low, high);
  std::vector<PixelSums> pixels;
  for (int i = 0; i < 2000; ++i) pixels.push_back(make_sums(std::pow(10.0, exponent(random))));
  return make_row(pixels, true);
}

TEST(Part, SumsKeepFortyNineBits) {
  const Film film = random_film(-6, 6);
  const Image image = make_part(film, true);
  EXPECT_EQ(*find_metadata(image.metadata, "facet.sumExponent"), "0");
  EXPECT_EQ(*find_metadata(image.metadata, "facet.squareExponent"), "0");
  expect_close(film, there_and_back(film));
}

TEST(Part, PairsOfFloatsAreExact) {
  // What the kernels' films hold: two floats, one below the other's last digit.
  std::vector<PixelSums> pixels;
  for (const double low : {0x1p-25, -0x1p-25, 0x1.fffffep-26, 0x1.000002p-28, 0.0})
    pixels.push_back(make_sums(0x1.000002p3 * (1 + low) - 0x1.000002p3 + 0x1.000002p3));
  const Film film = make_row(pixels, false);
  EXPECT_TRUE(film_of_part(make_part(film, false), most, "a").pixels[4].values ==
              film.pixels[4].values);
  const Film once = there_and_back(film);
  EXPECT_TRUE(there_and_back(once).pixels == once.pixels) << "a part of a part loses nothing more";
}

TEST(Part, LargeAndSmallSumsAreScaled) {
  // Squares of 1e30 are no floats, nor are those of 1e-30, nor 2^30 samples of 1e38.
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{{29, 30},
                                                                        {-30, -29},
                                                                        {40, 47},
                                                                        {-44, -40},
                                                                        {-14, 19},
                                                                        {-16, 16},
                                                                        {-150, -149},
                                                                        {150, 150}}) {
    SCOPED_TRACE(fmt::format("1e{} to 1e{}", low, high));
    expect_close(random_film(low, high), there_and_back(random_film(low, high)));
  }
}

TEST(Part, WhatIsTooSmallBesideTheLargestKeepsItsAbsoluteError) {
  const Film film = make_row({make_sums(1e50), make_sums(1e-45)}, false);
  const Film back = there_and_back(film);
  EXPECT_LE(std::abs(back.pixels[0].values[0] - 1e50), 0x1p-49 * 1e50);
  EXPECT_LE(std::abs(back.pixels[1].values[0] - 1e-45), 0x1p-276 * 1e50);
}

TEST(Part, NoNumberStaysNoNumber) {
  Film film = make_row({make_sums(inf), make_sums(1e30), make_sums(std::nan(""))}, true);
  film.pixels[0].squares = {inf, inf, 0};
  const Film back = there_and_back(film);
  EXPECT_EQ(back.pixels[0].values[0], inf);
  EXPECT_EQ(back.pixels[0].values[2], -inf);
  EXPECT_EQ(back.pixels[0].squares[0], inf);
  EXPECT_TRUE(std::isnan(back.pixels[2].values[0]));
  EXPECT_NEAR(back.pixels[1].squares[0], 1e60, 1e45);
}

TEST(Part, CountsAreExact) {
  std::vector<PixelSums> pixels;
  for (const std::uint32_t n :
       {0U, 1U, (1U << 24U) - 1, (1U << 24U) + 1, (1U << 30U) - 1, 1U << 30U}) {
    pixels.push_back(make_sums(n, n));
    pixels.back().nonzero = n;
  }
  const Film film = make_row(pixels, false);
  for (const bool with_variance : {false, true}) {
    const Film back = film_of_part(make_part(film, with_variance), most, "a.exr");
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      EXPECT_EQ(back.pixels[i].samples, pixels[i].samples);
      EXPECT_EQ(back.pixels[i].nonzero, pixels[i].nonzero);
    }
  }
}

TEST(Part, FilesKeepEverything) {
  const test::TemporaryFolder folder;
  Film film = random_film(-40, 40);
  film.width = 50;
  film.height = 40;
  film.window = {3, 4, 100, 90};
  write_exr(folder.file("a.exr"), make_part(film, false));
  const Film back = film_of_part(read_exr(folder.file("a.exr")), most, "a.exr");
  EXPECT_TRUE(back.pixels == there_and_back(film).pixels);
  EXPECT_EQ(back.width, 50);
  EXPECT_EQ(back.height, 40);
  EXPECT_EQ(back.window.x, 3);
  EXPECT_EQ(back.window.full_height, 90);
  EXPECT_TRUE(back.has_squares);
}

TEST(Part, ShowsTheImageAsDevelopDoes) {
  const Film film = random_film(-3, 3);
  const Image plain = develop(there_and_back(film), true);
  const Image part = make_part(film, true);
  for (std::size_t c = 0; c < plain.channels().size(); ++c) {
    ASSERT_EQ(part.channels()[c], plain.channels()[c]);
    const auto plane = static_cast<int>(c);
    EXPECT_TRUE(std::equal(plain.plane(plane), plain.plane(plane) + 2000, part.plane(plane)));
  }
  EXPECT_EQ(make_part(make_row({make_sums(1)}, false), false).find_channel("square.R"), -1);
}

TEST(Part, AddingJoinsSumsAndKeepsSquaresOfBothOnly) {
  Film film = make_row({make_sums(2, 10)}, true);
  add_samples(film, make_row({make_sums(3, 20)}, true));
  EXPECT_EQ(film.pixels[0].values[0], 5);
  EXPECT_EQ(film.pixels[0].squares[0], 13);
  EXPECT_EQ(film.pixels[0].samples, 30U);
  EXPECT_EQ(film.pixels[0].nonzero, 9U);
  EXPECT_TRUE(film.has_squares);
  add_samples(film, make_row({make_sums(3)}, false));
  EXPECT_FALSE(film.has_squares);
  EXPECT_EQ(film.pixels[0].squares[0], 0);
}

TEST(Part, LacksAreNamed) {
  const Image part = make_part(make_row({make_sums(1)}, true), false);
  const auto error = [](const Image& image) {
    return input_error_of([&] { return film_of_part(image, most, "a.exr"); });
  };
  expect_message(error(Image(1, 1, {"R", "G", "B"})), "a.exr", {"lacks the channel samples"});
  for (const char* key : {"facet.sumExponent", "facet.squareExponent"}) {
    Image image = part;
    std::erase_if(image.metadata, [&](const auto& entry) { return entry.first == key; });
    expect_message(error(image), "a.exr", {"lacks the metadata", key});
  }
}

TEST(Part, ContradictionsAreFound) {
  const Image part = make_part(make_row({make_sums(1), make_sums(2)}, true), false);
  const auto error_with = [&](const char* channel, float value) {
    Image image = part;
    image.at(1, 0, image.find_channel(channel)) = value;
    return input_error_of([&] { return film_of_part(image, 2000, "a.exr"); });
  };
  expect_message(error_with("R", 7), "a.exr", {"pixel (1, 0)", "R = 7", "changed"});
  expect_message(error_with("sum.G", 7), "a.exr", {"pixel (1, 0)", "G = "});
  for (const float count : {2001.F, -1.F, 0.5F, std::nanf(""), 1e30F})
    expect_message(error_with("samples", count), "a.exr",
                   {"pixel (1, 0)", "in samples", "2000 samples"});
  expect_message(error_with("samples.nonzero", 2001), "a.exr", {"in samples.nonzero"});
}

}  // namespace

}  // namespace facet
