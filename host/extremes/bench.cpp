#include "extremes/bench.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "gpu/commands.h"
#include "shared/bindings.h"
#include "shared/extreme_inputs.h"

namespace facet::extremes {

namespace {

/// Words of one dispatch: within the fewest workgroups that a device may allow, 65535.
constexpr std::uint32_t words_of_run = 1U << 21U;
/// Of a quick measurement: words left out are those between multiples of an odd number, and none
/// at the ends of a range.
constexpr std::uint64_t largest_quick_stride = 4099;
constexpr std::uint64_t quick_inputs = 1U << 17U;
constexpr std::uint64_t quick_ends = 1024;

/// Push constants of the kernels.
struct RangeConstants {
  std::uint32_t first;
  std::uint32_t stride;
  std::uint32_t count;
};

}  // namespace

std::string float_text(std::uint32_t word) {
  return fmt::format("{:.9g} ({:#010x})", as_float(word), word);
}

std::string triangle_text(std::uint32_t index) {
  const auto corner = [index](std::uint32_t k) {
    const vec3 v = shared::extreme_corner(index, k);
    return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z);
  };
  return fmt::format("triangle {}, {}, {}", corner(0), corner(1), corner(2));
}

void Worst::add(std::uint32_t word, double deviation) {
  if (deviation < 0) return;
  if (std::isnan(deviation)) deviation = std::numeric_limits<double>::infinity();
  ++inputs_;
  sum_ += deviation;
  if (deviation > value_) {
    value_ = deviation;
    word_ = word;
  }
}

void Worst::add(const Worst& other) {
  inputs_ += other.inputs_;
  sum_ += other.sum_;
  if (other.value_ > value_ || (other.value_ == value_ && other.word_ < word_)) {
    value_ = other.value_;
    word_ = other.word_;
  }
}

Bench::Bench(KernelBackend& backend, bool quick, std::function<bool(double)> callback)
    : backend_(backend),
      quick_(quick),
      callback_(std::move(callback)),
      results_(device(), std::uint64_t{words_of_run} * sizeof(std::uint32_t), "results"),
      program_(device(), {{0, gpu::Access::storage}}, sizeof(RangeConstants)),
      bound_(program_.bind({{0, &results_}})) {}

std::vector<Bench::Run> Bench::runs_over(std::span<const WordRange> ranges) const {
  std::vector<Run> runs;
  const auto add = [&](std::uint64_t first, std::uint64_t count, std::uint32_t stride) {
    for (std::uint64_t begin = 0; begin < count; begin += words_of_run) {
      const auto n =
          static_cast<std::uint32_t>(std::min<std::uint64_t>(words_of_run, count - begin));
      runs.push_back({static_cast<std::uint32_t>(first + begin * stride), stride, n, 0});
    }
  };
  for (const WordRange& range : ranges) {
    if (!quick_ || range.count <= 2 * quick_ends) {
      add(range.first, range.count, 1);
      continue;
    }
    add(range.first, quick_ends, 1);
    const std::uint64_t inner = range.count - 2 * quick_ends;
    const std::uint64_t stride = std::min((inner / quick_inputs) | 1U, largest_quick_stride);
    add(range.first + quick_ends, (inner + stride - 1) / stride,
        static_cast<std::uint32_t>(stride));
    add(range.first + range.count - quick_ends, quick_ends, 1);
  }
  for (std::size_t i = 0; i < runs.size(); ++i)
    runs[i].done = static_cast<double>(i + 1) / static_cast<double>(runs.size());
  return runs;
}

std::vector<std::uint32_t> Bench::evaluate(Kernel kernel, std::uint32_t function, const Run& run) {
  auto found = kernels_.find({kernel, function});
  if (found == kernels_.end()) {
    const std::array constants{function};
    found = kernels_
                .emplace(std::pair(kernel, function),
                         program_.compile(kernel_code(kernel, GeometryFetch::storage_buffer),
                                          constants, kernel_name(kernel)))
                .first;
  }
  device().run([&](gpu::Commands& c) {
    c.bind(bound_);
    c.dispatch(found->second, RangeConstants{run.first, run.stride, run.count},
               (run.count + shared::WORKGROUP_SIZE - 1) / shared::WORKGROUP_SIZE);
  });
  return results_.download<std::uint32_t>(run.count);
}

void Bench::tell(double done) {
  if (!callback_(done)) throw Interrupted();
}

}  // namespace facet::extremes
