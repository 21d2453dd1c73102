#pragma once
// Error against seconds over what whoever renders can choose.
#include <facet/backend.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tradeoff/choices.h"
#include "tradeoff/relative_errors.h"

namespace facet::tradeoff {

/// The largest number of samples a pixel that is measured where none is given; fewer, but 16 at
/// least, where a size, a crop or a reference is given and the budget too small for so many.
inline constexpr std::uint32_t default_most_samples = 64;

struct Options {
  RenderRequest base;       ///< what every render has; `samples`: the most of any, if given
  double budget = 120;      ///< seconds for all, about
  std::string reference;    ///< a file to measure errors against; empty: one is made
  bool exhaustive = false;  ///< all combinations of choices, not only those on the way to the best
  bool pictures = false;    ///< also an image of each setting in the default's time
};

/// What a figure lies within, with a confidence of 95 %.
struct Interval {
  double low = 0;
  double high = 0;
};

/// One setting at one number of samples.
struct Point {
  std::uint32_t samples = 0;    ///< a pixel
  double seconds = 0;           ///< of rendering; the median of its renders
  double relmse = 0;            ///< the mean of its renders, above 0 in any case
  double relmse_trimmed = 0;    ///< likewise, without the 0.1 % largest terms
  Interval interval;            ///< of relmse
  double log_variance = 0;      ///< of the mean of its renders' logarithms of relmse
  double efficiency_ratio = 1;  ///< 1 / (relmse * seconds) over that of the default
  Interval ratio_interval;      ///< of it
  double trimmed_ratio = 1;     ///< the same by the trimmed errors
  double expected = 0;          ///< relmse as far as renders of all settings tell (series.h)
  double expected_ratio = 1;    ///< efficiency by it
  bool at_reference = false;    ///< the reference is no better: the error says little
  bool front = false;           ///< nothing that was measured is both faster and better
};

/// The image that a setting makes in the time that the default takes for its largest number of
/// samples.
struct Picture {
  Image image;
  std::uint32_t samples = 0;
  double seconds = 0;
  RelativeError error;
};

/// A combination of choices, and what it gives.
struct Setting {
  std::string name;                  ///< its choices; "default" has none
  std::vector<std::string> options;  ///< of `facet render`
  Plan plan;
  bool biased = false;          ///< by its choices, or as was measured
  double bias = 0;              ///< relative; 0: none was seen
  std::vector<Point> points;    ///< by samples, ascending
  std::optional<double> slope;  ///< of the logarithm of relmse over that of the samples
  std::optional<Picture> picture;

  /// That of the most samples.
  [[nodiscard]] const Point& last() const { return points.back(); }
};

struct Tradeoff {
  std::string scene;  ///< its file
  std::string device;
  std::string driver;
  ImageSize size;      ///< of the images
  ImageSize own_size;  ///< of what the scene, or whoever asked, wants rendered
  Reference reference;
  std::uint32_t seeds = 0;        ///< renders of each point
  double startup_seconds = 0;     ///< before the first sample of the default
  std::uint64_t bound_hits = 0;   ///< rays stopped by the safety bound: images are wrong there
  bool interrupted = false;       ///< this is what was measured until then
  std::vector<Setting> settings;  ///< the default first
  std::size_t best = 0;  ///< of those without bias that whose expected efficiency is the greatest
};

/// What there is so far, from 0 to 1, and what is being done; returns whether to go on.
using Callback = std::function<bool(double done, const std::string& what)>;

/// Measures. Each choice is tried alone, biased ones too; then the best of each kind together;
/// then, as long as anything gets better, that with one choice otherwise. Renders of one number of
/// samples take turns, so that no setting has the machine at a better time. Nothing where the
/// callback ended it before each choice had two renders. Throws InputError for what cannot be
/// rendered, and for a reference of another size.
[[nodiscard]] std::optional<Tradeoff> measure(Backend& kernels, const ScenePtr& scene,
                                              const Options& options, const Callback& callback);

}  // namespace facet::tradeoff
