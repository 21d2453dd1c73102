// Errors against a noisy reference, biases, efficiencies and advice: on numbers whose answers are
// known.
#include "tradeoff/tradeoff.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "image/film.h"
#include "support/scenes.h"
#include "tradeoff/advice.h"
#include "tradeoff/series.h"

namespace facet::tradeoff {

namespace {

constexpr int side = 64;

/// The mean of so many exponential samples a pixel, whose expectation is `mean`.
Film noisy_film(std::mt19937& random, int samples, double mean) {
  std::exponential_distribution<double> exponential(1 / mean);
  Film film = make_film(side, side, {0, 0, side, side}, true);
  for (PixelSums& pixel : film.pixels) {
    for (int i = 0; i < samples; ++i) {
      const double value = exponential(random);
      pixel.add({value, value, value});
    }
  }
  return film;
}

Image noisy_image(std::mt19937& random, int samples, double mean) {
  return develop(noisy_film(random, samples, mean), false);
}

/// Numbers of samples that are measured of a lit floor, by the reference, whatever the time.
std::set<std::uint32_t> samples_measured(const RenderRequest& base, double budget) {
  Scene scene = test::make_scene("direct_ems");
  test::add_mesh(scene, test::make_quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}),
                 bsdf::Diffuse{});
  test::add_mesh(scene, test::make_quad({-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}),
                 bsdf::Diffuse{}, Color(1));
  test::set_camera(scene, 8, 40, {0, 3, 4}, {0, 0, 0});
  const auto backend = open_backend({.reference = Precision::float_});
  Options options;
  options.base = base;
  options.budget = budget;
  const auto measured = measure(*backend, std::make_shared<const Scene>(std::move(scene)), options,
                                [](double, const std::string&) { return true; });
  std::set<std::uint32_t> samples;
  for (const Setting& setting : measured->settings) {
    for (const Point& p : setting.points) samples.insert(p.samples);
  }
  return samples;
}

TEST(TradeoffBudget, TooSmallForASizeItBuysFewerSamples) {
  using Counts = std::set<std::uint32_t>;
  constexpr double none = 1e-3;
  const ImageSize size{8, 6};
  EXPECT_EQ(samples_measured({.size = size}, none), (Counts{1, 4, 16}));
  EXPECT_EQ(samples_measured({.size = size, .crop = Crop{2, 1, 6, 5}}, none), (Counts{1, 4, 16}));
  EXPECT_EQ(samples_measured({.samples = 32, .size = size}, none), (Counts{2, 8, 32}))
      << "those that were asked for";
  EXPECT_EQ(samples_measured({}, none), (Counts{4, 16, 64})) << "of an image that may be small";
}

// Of exponential samples of mean 1, relMSE is 1 / samples. Over 4096 pixels, 1 / samples is known
// to 2.3 %: sqrt(2 / 4096), kurtosis aside. Bounds are five of these.

TEST(TradeoffErrors, WhatTheReferenceAddsIsTakenAway) {
  std::mt19937 random(1);
  const Reference reference = make_reference(noisy_film(random, 128, 1));
  EXPECT_NEAR(reference.relmse(), 1.0 / 128, 0.12 / 128);
  const RelativeError error = relative_error(noisy_image(random, 32, 1), reference);
  // 25 % more without.
  EXPECT_NEAR(error.relmse, 1.0 / 32, 0.14 / 32);
  EXPECT_LT(error.trimmed, error.relmse);
  EXPECT_GT(error.trimmed, 0.9 * error.relmse);
}

/// Four films of so many samples, and their sum.
struct Films {
  std::vector<Image> images;
  Film sum;

  Films(std::mt19937& random, int samples, double mean) {
    for (int k = 0; k < 4; ++k) {
      const Film film = noisy_film(random, samples, mean);
      images.push_back(develop(film, false));
      if (k == 0) {
        sum = film;
      } else {
        add_samples(sum, film);
      }
    }
  }
};

TEST(TradeoffErrors, NoiseIsNoBias) {
  std::mt19937 random(2);
  for (int k = 0; k < 20; ++k) {
    const Reference reference = make_reference(noisy_film(random, 256, 1));
    EXPECT_FALSE(is_biased(Films(random, 32, 1).sum, reference, 1e-4));
  }
}

TEST(TradeoffErrors, ABiasBelowTheNoiseIsMeasured) {
  std::mt19937 random(3);
  const Reference reference = make_reference(noisy_film(random, 1024, 1));
  // Each image's noise is 18 %.
  const Films films(random, 32, 1.08);
  EXPECT_NEAR(measure_bias(films.images, reference), 0.08, 0.012);
  // The noise of a pixel is 9 % with all samples, that of 16x16 of them 0.6 %.
  EXPECT_TRUE(is_biased(films.sum, reference, 1e-4));
  Film local = Films(random, 32, 1).sum;
  for (std::size_t i = 0; i < 4; ++i) {
    for (double& value : local.pixels[100 + i].values) value *= 1.8;
  }
  EXPECT_TRUE(is_biased(local, reference, 1e-4));
}

TEST(TradeoffErrors, CommonNoiseHidesNoBias) {
  std::mt19937 random(4);
  const Reference reference = make_reference(noisy_film(random, 1024, 1));
  std::vector<Image> images;
  std::vector<Image> plain;
  for (int k = 0; k < 4; ++k) {
    plain.push_back(noisy_image(random, 8, 1));
    Image changed = plain.back();
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < side * side; ++i) changed.plane(c)[i] += 1e-4F;
    }
    images.push_back(std::move(changed));
  }
  EXPECT_NEAR(measure_bias(images, plain, reference), 1e-4, 1e-5);
}

Series make_series(std::uint32_t samples, const std::vector<double>& errors, double seconds) {
  Series series;
  series.samples = samples;
  for (const double e : errors) {
    series.seconds.push_back(seconds);
    series.default_seconds.push_back(2);
    series.errors.push_back({e, e / 2});
  }
  return series;
}

TEST(TradeoffSeries, EfficienciesAreRatiosOfTheSameRounds) {
  const Series plain = make_series(16, {0.02, 0.04, 0.03}, 2);
  const Point p = point_of(make_series(16, {0.01, 0.02, 0.015}, 4), plain, 0.001);
  EXPECT_DOUBLE_EQ(p.relmse, 0.015);
  EXPECT_DOUBLE_EQ(p.relmse_trimmed, 0.0075);
  EXPECT_NEAR(p.efficiency_ratio, 1, 1e-9) << "half the error, in twice the time";
  // In every round it was half: nothing is uncertain about that.
  EXPECT_NEAR(p.ratio_interval.low, 1, 1e-9);
  EXPECT_NEAR(p.ratio_interval.high, 1, 1e-9);
  // Student's t of two degrees of freedom is 4.303; logarithms have the deviation 0.3482.
  EXPECT_NEAR(p.interval.high / p.relmse, std::exp(4.303 * 0.3482 / std::sqrt(3)), 1e-3);
  EXPECT_FALSE(p.at_reference);
  EXPECT_TRUE(point_of(make_series(16, {0.001, 0.0005}, 4), plain, 0.001).at_reference);
}

TEST(TradeoffSeries, ASlopeIsThatOfLogarithms) {
  std::vector<Point> points(3);
  for (std::size_t i = 0; i < 3; ++i) {
    points[i].samples = 4U << (2 * i);
    points[i].relmse = std::pow(points[i].samples, -1.5);
  }
  EXPECT_NEAR(slope_of(points).value(), -1.5, 1e-9);
  points.resize(1);
  EXPECT_FALSE(slope_of(points));
}

TEST(TradeoffSeries, OneBrightPixelDoesNotDecide) {
  // Settings whose trimmed errors are a half of the others', alike in all but luck.
  std::vector<Point> points(5);
  for (Point& p : points) {
    p.relmse = 0.02;
    p.relmse_trimmed = 0.01;
    p.log_variance = 0.01;
  }
  points[3].relmse = 0.08;  // unlucky: its renders do not agree
  points[3].log_variance = 1;
  points[4].relmse = 0.08;  // known to be so
  std::vector<Point*> list;
  list.reserve(points.size());
  for (Point& p : points) list.push_back(&p);
  expect(list);
  EXPECT_NEAR(points[1].expected, 0.02, 1e-12);
  EXPECT_NEAR(points[1].expected_ratio, 1, 1e-12);
  EXPECT_LT(points[3].expected, 0.035);
  EXPECT_GT(points[4].expected, 0.07);
}

Setting make_setting(double error_at_64, double seconds, double slope = -1) {
  Setting setting;
  for (const std::uint32_t n : {4U, 16U, 64U}) {
    Point p;
    p.samples = n;
    p.seconds = seconds * n / 64;
    p.relmse = p.expected = std::pow(error_at_64, 2) * std::pow(n / 64.0, slope);
    setting.points.push_back(p);
  }
  return setting;
}

TEST(TradeoffSeries, TheFrontIsWhatNothingBeats) {
  std::vector<Setting> settings{make_setting(0.1, 1), make_setting(0.1, 2),
                                make_setting(0.07, 1.5)};
  mark_front(settings);
  for (const Point& p : settings[0].points) EXPECT_TRUE(p.front);
  for (const Point& p : settings[1].points) EXPECT_FALSE(p.front) << "slower and no better";
  for (const Point& p : settings[2].points) EXPECT_TRUE(p.front);
}

Tradeoff make_tradeoff(std::vector<Setting> settings) {
  Tradeoff t;
  t.scene = "a scene.xml";
  t.size = {10, 10};
  t.own_size = {20, 20};
  t.startup_seconds = 1;
  t.settings = std::move(settings);
  return t;
}

TEST(TradeoffAdvice, SamplesLieOnTheLine) {
  const std::vector<Point> points = make_setting(0.1, 1, -1.5).points;
  EXPECT_NEAR(samples_for(points, std::pow(32 / 64.0, -1.5) * 0.01), 32, 1e-9);
  EXPECT_NEAR(samples_for(points, 0.01), 64, 1e-9);
  EXPECT_NEAR(samples_for(points, std::pow(1 / 64.0, -1.5) * 0.01), 1, 1e-9);
  // Nobody knows whether an order goes on: beyond, samples count as independent ones.
  EXPECT_NEAR(samples_for(points, 0.0025), 256, 1e-9);
}

TEST(TradeoffAdvice, IsTheSoonestForTheWantedError) {
  Setting steep = make_setting(0.1, 1, -1.4);
  steep.options = {"--sampler", "sobol"};
  Setting flat = make_setting(0.1, 1.05, -1);
  const Tradeoff t = make_tradeoff({flat, steep});
  // At 10 % the steep one is faster, at 30 % it needs more samples.
  const Advice fine = advise(t, 0.1).value();
  EXPECT_EQ(fine.setting, 1U);
  EXPECT_TRUE(fine.measured);
  EXPECT_EQ(fine.samples, 64);
  // Four times the pixels, and a second to start.
  EXPECT_NEAR(fine.seconds, 1 + 4 * 1, 1e-9);
  EXPECT_EQ(advise(t, 0.3).value().setting, 0U);
  EXPECT_FALSE(advise(t, 0.01).value().measured);
  EXPECT_EQ(command_of(t, steep, 64U),
            "facet render 'a scene.xml' --sampler sobol --spp 64 --resolution 10x10");
}

TEST(TradeoffAdvice, BiasedSettingsAreNotRecommendedButTold) {
  Setting biased = make_setting(0.1, 0.5);
  biased.biased = true;
  biased.bias = 0.02;
  const Tradeoff t = make_tradeoff({make_setting(0.1, 1), biased});
  const Advice advice = advise(t, 0.1).value();
  EXPECT_EQ(advice.setting, 0U);
  EXPECT_EQ(advise_biased(t, 0.1, advice).value().setting, 1U);
  EXPECT_FALSE(advise_biased(t, 0.03, advise(t, 0.03).value())) << "most of that were its bias";
  Setting checker = make_setting(0.1, 0.01);
  checker.plan.reference = Precision::double_;
  EXPECT_EQ(advise(make_tradeoff({make_setting(0.1, 1), checker}), 0.1).value().setting, 0U);
}

}  // namespace

}  // namespace facet::tradeoff
