#pragma once
// Evaluates functions on the device for very many inputs.
#include <bit>
#include <map>
#include <mutex>
#include <span>

#include "core/parallel.h"
#include "extremes/extremes.h"
#include "gpu/buffer.h"
#include "gpu/program.h"
#include "render/kernels.h"

namespace facet::extremes {

/// Thrown through everything when the callback has had enough.
struct Interrupted {};

/// A run of words, which are indices or the bits of floats.
struct WordRange {
  std::uint32_t first = 0;
  std::uint64_t count = 0;
};

[[nodiscard]] inline float as_float(std::uint32_t word) { return std::bit_cast<float>(word); }
[[nodiscard]] inline std::uint32_t as_word(float x) { return std::bit_cast<std::uint32_t>(x); }
/// "0.1 (0x3dcccccd)": the float with these bits, and the bits.
[[nodiscard]] std::string float_text(std::uint32_t word);

/// "triangle (...), (...), (...)": the corners of shared/extreme_inputs.h of that index.
[[nodiscard]] std::string triangle_text(std::uint32_t index);

/// The floats from `low` to `high`, both of the same sign, |low| <= |high|.
[[nodiscard]] inline WordRange floats(float low, float high) {
  return {as_word(low), std::uint64_t{as_word(high)} - as_word(low) + 1};
}

/// The largest of many deviations. Those of chunks are found by several threads; the result is that
/// of one.
class Worst {
 public:
  /// A deviation below 0 says that the word is no input. NaN counts as infinite. Of equal
  /// deviations the first word is kept.
  void add(std::uint32_t word, double deviation);
  void add(const Worst& other);

  [[nodiscard]] double value() const { return value_; }
  [[nodiscard]] double sum() const { return sum_; }
  [[nodiscard]] std::uint64_t inputs() const { return inputs_; }
  /// Of the largest deviation that is not 0.
  [[nodiscard]] std::uint32_t word() const { return word_; }

 private:
  double value_ = 0;
  double sum_ = 0;
  std::uint64_t inputs_ = 0;
  std::uint32_t word_ = 0;
};

class Bench {
 public:
  Bench(KernelBackend& backend, bool quick, std::function<bool(double)> callback);

  [[nodiscard]] bool quick() const { return quick_; }
  [[nodiscard]] gpu::Device& device() { return backend_.device(); }
  [[nodiscard]] KernelBackend& backend() { return backend_; }

  /// Deviations of what a function of a kernel makes of every word of some ranges; in a quick
  /// measurement of a sample, and of 1024 at either end. deviation(word, result): of the bits
  /// that the kernel returned; called by several threads.
  template <typename Deviation>
  [[nodiscard]] Worst sweep(Kernel kernel, std::uint32_t function,
                            std::span<const WordRange> ranges, const Deviation& deviation) {
    Worst worst;
    for (const Run& run : runs_over(ranges)) {
      const std::vector<std::uint32_t> results = evaluate(kernel, function, run);
      std::mutex mutex;
      parallel_for(results.size(), 1U << 14U, [&](std::size_t begin, std::size_t end) {
        Worst part;
        for (std::size_t i = begin; i < end; ++i) {
          const auto word = static_cast<std::uint32_t>(run.first + i * run.stride);
          part.add(word, deviation(word, results[i]));
        }
        const std::scoped_lock lock(mutex);
        worst.add(part);
      });
      tell(run.done);
    }
    return worst;
  }

  /// How much of a check is done; may throw Interrupted.
  void tell(double done);

 private:
  /// The words first, first + stride, ... that one dispatch takes.
  struct Run {
    std::uint32_t first;
    std::uint32_t stride;
    std::uint32_t count;
    double done;  ///< share of all that is, then
  };
  [[nodiscard]] std::vector<Run> runs_over(std::span<const WordRange> ranges) const;
  [[nodiscard]] std::vector<std::uint32_t> evaluate(Kernel kernel, std::uint32_t function,
                                                    const Run& run);

  KernelBackend& backend_;
  bool quick_;
  std::function<bool(double)> callback_;
  gpu::Buffer results_;
  gpu::Program program_;
  gpu::BoundBuffers bound_;
  std::map<std::pair<Kernel, std::uint32_t>, gpu::CompiledKernel> kernels_;
};

}  // namespace facet::extremes
