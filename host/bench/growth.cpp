#include "bench/growth.h"

#include <optional>

#include "bench/mesh.h"
#include "render/renderer.h"

namespace facet::bench {

namespace {

/// One frame, ready to be rendered again and again.
class Frame {
 public:
  Frame(gpu::Device& device, std::size_t emitters, int size, std::uint32_t samples)
      : device_(device) {
    const Scene scene = generate_scene(10'000, emitters);
    RenderRequest request;
    request.integrator = "direct_mis";
    request.size = {size, size};
    request.samples = static_cast<int>(samples);
    packed_ = pack_scene(scene, resolve(scene, request));
  }

  double seconds() {
    Renderer renderer(device_, packed_);
    renderer.render({});
    return renderer.statistics().render_seconds;
  }

 private:
  gpu::Device& device_;
  PackedScene packed_;
};

class Series {
 public:
  explicit Series(std::string of) : of_(std::move(of)) {}

  void add(double number, Frame frame) { frames_.push_back({number, std::move(frame), {}}); }

  /// Nothing where `go_on` ends it.
  std::optional<GrowthSeries> measure(int repeats, const std::function<bool()>& go_on) {
    // The first round is not counted.
    for (int round = 0; round <= repeats; ++round) {
      for (Entry& e : frames_) {
        if (!go_on()) return {};
        const double seconds = e.frame.seconds();
        if (round > 0) e.seconds.push_back(seconds);
      }
    }
    GrowthSeries series{of_, {}};
    for (const Entry& e : frames_) series.points.push_back({e.number, summarise(e.seconds)});
    return series;
  }

 private:
  struct Entry {
    double number;
    Frame frame;
    std::vector<double> seconds;
  };

  std::string of_;
  std::vector<Entry> frames_;
};

/// first, first * factor, and so on, to last.
std::vector<std::uint32_t> ladder(std::uint32_t first, std::uint32_t factor, std::uint32_t last) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t number = first; number <= last; number *= factor) numbers.push_back(number);
  return numbers;
}

}  // namespace

std::vector<GrowthSeries> measure_growth(gpu::Device& device, const GrowthOptions& options,
                                         const std::function<bool()>& go_on) {
  Series pixels("pixels");
  for (const std::uint32_t size : ladder(64, 2, options.quick ? 256 : 1024))
    pixels.add(size * size, Frame(device, 1, static_cast<int>(size), 8));
  Series samples("samples a pixel");
  for (const std::uint32_t count : ladder(1, 4, options.quick ? 16 : 256))
    samples.add(count, Frame(device, 1, 128, count));
  Series emitters("emitters");
  for (const std::uint32_t count : ladder(1, 4, options.quick ? 256 : 4096))
    emitters.add(count, Frame(device, count, 256, options.quick ? 4 : 16));
  std::vector<GrowthSeries> complete;
  for (Series* series : {&pixels, &samples, &emitters}) {
    if (const auto measured = series->measure(options.repeats, go_on))
      complete.push_back(*measured);
  }
  return complete;
}

}  // namespace facet::bench
