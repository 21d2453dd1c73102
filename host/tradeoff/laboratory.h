#pragma once
// Where settings are rendered: images of one size, against one reference, within a budget of time.
#include <map>
#include <memory>

#include "tradeoff/tradeoff.h"

namespace facet::tradeoff {

/// Thrown through everything when the callback has had enough.
struct Interrupted {};

// Until which share of the budget what is done.
inline constexpr double reference_until = 0.3;
inline constexpr double alone_until = 0.65;
inline constexpr double climbing_until = 0.92;

class Laboratory {
 public:
  /// Chooses the images' size, and finds or makes the reference.
  Laboratory(Backend& kernels, ScenePtr scene, const Options& options, const Callback& callback);

  /// What every setting starts from.
  [[nodiscard]] const Plan& base() const { return base_; }
  /// The base and each choice alone; where it is to be exhaustive also all combinations of unbiased
  /// choices, which have no kind.
  [[nodiscard]] const std::vector<Candidate>& first() const { return first_; }
  /// Numbers of samples that are measured, of the base and most others, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& ladder() const { return ladder_; }
  /// Those of them that a plan is rendered with, at least one.
  [[nodiscard]] std::vector<std::uint32_t> ladder(const Plan& plan) const;
  [[nodiscard]] ImageSize size() const { return size_; }
  /// That which the scene, or whoever asked, wants rendered.
  [[nodiscard]] ImageSize own_size() const { return own_size_; }
  [[nodiscard]] Reference& reference() { return reference_; }
  /// Of a render before its first sample, with kernels still to be compiled.
  [[nodiscard]] double startup_seconds() const { return startup_seconds_; }
  /// Rays that were stopped by the safety bound of traversal: images are wrong there.
  [[nodiscard]] std::uint64_t bound_hits() const { return bound_hits_; }

  /// Seconds that so many rounds of first() are expected to take.
  [[nodiscard]] double expected_seconds(std::uint32_t rounds) const;
  /// Seconds of the budget that are left until a share of it is spent.
  [[nodiscard]] double seconds_until(double share) const;
  /// What is being done, from now on; may throw Interrupted.
  void tell(const std::string& what);
  /// `seed` counts from 0: that of the scene. May throw Interrupted.
  [[nodiscard]] Film render(const Plan& plan, std::uint32_t samples, std::uint32_t seed);

 private:
  [[nodiscard]] Film render(const Plan& plan, RenderRequest request);
  [[nodiscard]] Backend& backend_of(const Plan& plan);
  [[nodiscard]] ImageSize shrunk(double pixels) const;
  /// Of the base, by small images of it.
  void measure_rate();
  /// Pixels of the largest image that the budget suffices for, with ladder()'s numbers of samples;
  /// 0 or less where it does not even suffice for compiling.
  [[nodiscard]] double affordable_pixels() const;
  /// Of an image of size(), or of the crop of it.
  [[nodiscard]] double pixels() const;
  /// A sixteenth, a quarter and all of so many, where that is enough for the base.
  [[nodiscard]] std::vector<std::uint32_t> ladder_to(std::uint32_t most) const;
  /// Of all of first(), a pixel.
  [[nodiscard]] double samples_of_round() const;
  void take_reference();
  void find_reference();
  [[nodiscard]] bool go_on() const;

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Backend& kernels_;
  std::map<Precision, std::unique_ptr<Backend>> references_;
  ScenePtr scene_;
  const Options& options_;
  const Callback& callback_;
  std::string what_;
  Plan base_;
  std::vector<Candidate> first_;
  std::vector<std::uint32_t> ladder_;
  std::uint32_t seed_ = 0;
  ImageSize own_size_;
  ImageSize size_;
  Reference reference_;
  double startup_seconds_ = 0;
  double rate_ = 0;  ///< samples of the base a second
  std::uint64_t bound_hits_ = 0;
};

}  // namespace facet::tradeoff
