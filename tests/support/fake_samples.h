#pragma once
// A source of samples whose truth and whose clock are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "convergence/sampling_plan.h"
#include "image/film.h"

namespace facet::test {

/// Pixels of expectation 1 whose samples are uniform within a width, and take a time.
class FakeSamples : public SampleSource {
 public:
  static constexpr int side = 48;  ///< pixels, of a square

  explicit FakeSamples(std::uint32_t seed = 1, double width = 1)
      : width_(width), random_(seed), films_{blank(), blank()} {}

  /// Of so many samples in a row, only the last is drawn; those before make up for each other. The
  /// mean is as good as that of so many times more samples.
  std::uint32_t order = 1;
  double spread = 1;             ///< one pixel in sixteen is so many times as noisy
  Clock::duration per_sample{};  ///< of one pixel
  double jitter = 0;             ///< part of that by which it varies
  int calls_left = 1 << 30;      ///< until it is interrupted
  std::uint32_t pixels_at_a_time = 1U << 30U;
  std::map<std::pair<Sums, std::uint32_t>, std::vector<SampleRange>> given;  ///< to each pixel
  std::vector<std::uint32_t> seeds;
  double expected = 0;

  bool add(const SamplingTask& task, std::uint32_t& next) override {
    seeds.push_back(task.seed);
    PixelList all = task.pixels;
    if (all.empty()) {
      for (std::uint32_t p = 0; p < side * side; ++p) all.push_back(p);
    }
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
    const SampleRange& samples = task.samples;
    while (next < all.size()) {
      const auto end = static_cast<std::uint32_t>(
          std::min<std::uint64_t>(all.size(), std::uint64_t{next} + pixels_at_a_time));
      for (; next < end; ++next) {
        const std::uint32_t p = all[next];
        given[{task.sums, p}].push_back(samples);
        add_pixel(films_.at(static_cast<std::size_t>(task.sums)).pixels[p],
                  samples.end - samples.begin, p % 16 == 0 ? spread * width_ : width_);
      }
      if (--calls_left <= 0) return false;
    }
    std::uniform_real_distribution<double> uneven(1 - jitter, 1 + jitter);
    const double count =
        static_cast<double>(all.size()) * static_cast<double>(samples.end - samples.begin);
    now_ += std::chrono::duration_cast<Clock::duration>(per_sample * count * uneven(random_));
    return true;
  }
  [[nodiscard]] Film sums(Sums of) const override {
    return films_.at(static_cast<std::size_t>(of));
  }
  void clear(Sums which) override {
    films_.at(static_cast<std::size_t>(which)) = blank();
    for (std::uint32_t p = 0; p < side * side; ++p) given.erase({which, p});
  }
  void expect(double samples) override { expected = samples; }
  [[nodiscard]] Clock::time_point now() const override { return now_; }

  /// Of the image.
  [[nodiscard]] double true_relmse() const {
    double sum = 0;
    for (const PixelSums& p : films_[0].pixels) {
      for (const double m : p.mean()) sum += (m - 1) * (m - 1);
    }
    return sum / (3 * side * side) / 1.0001;
  }

 private:
  static Film blank() { return make_film(side, side, {0, 0, side, side}, true); }

  void add_pixel(PixelSums& sums, std::uint32_t count, double width) {
    std::uniform_real_distribution<double> uniform(-width, width);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t place = sums.samples % order;
      double value = 1;
      if (place == order - 1) {
        value += uniform(random_);
      } else if (place + 1 < order / 2 * 2 - 1) {
        value += (place % 2 == 0 ? width : -width) / std::sqrt(3.0);
      }
      sums.add({value, value, value});
    }
  }

  double width_;
  std::mt19937 random_;
  std::array<Film, 2> films_;
  Clock::time_point now_{};
};

}  // namespace facet::test
