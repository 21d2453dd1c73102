#pragma once
// Who renders: kernels on a Vulkan device, or the reference on the CPU.
#include <facet/film.h>
#include <facet/scene.h>

#include <memory>
#include <string>
#include <vector>

namespace facet {

/// Linear radiance (R, G, B) in W sr^-1 m^-2.
using Radiance = std::array<float, 3>;

struct RenderState;

/// One render on its way.
class Rendering {
 public:
  Rendering() = default;
  virtual ~Rendering() = default;
  Rendering(const Rendering&) = delete;
  Rendering& operator=(const Rendering&) = delete;

  /// Renders all samples that were asked for, or as many as `progress` lets it. To be called once.
  virtual void run(const ProgressCallback& progress) = 0;

  /// One sample of every pixel of the crop, row by row: what the integrator estimates with the
  /// numbers of that sample, before the reconstruction filter's weight. Not for renderings that are
  /// run.
  [[nodiscard]] virtual std::vector<Radiance> sample(std::uint32_t index) = 0;

  /// How what there is so far was made.
  [[nodiscard]] virtual RenderRecord record() const = 0;
  /// The film so far, with its record.
  [[nodiscard]] virtual Film film() const = 0;
  [[nodiscard]] virtual const RenderStatistics& statistics() const = 0;

  /// All that it takes to continue this rendering elsewhere; checkpoint.h keeps it in files. While
  /// progress is told, or before or after run().
  [[nodiscard]] virtual RenderState state() const = 0;
  /// Whether now is a good moment for it: every pixel has the same samples, which makes it a part
  /// that others can be merged with. Of an adaptive render, any moment is as good.
  [[nodiscard]] virtual bool is_good_moment() const = 0;
  /// Continues where another rendering of the same request was, once run() is called. Throws
  /// std::invalid_argument for a state that cannot be of such a one.
  virtual void restore(const RenderState& state) = 0;
};

class Backend {
 public:
  Backend() = default;
  virtual ~Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;

  /// For people: the device's name, or "CPU reference in float".
  [[nodiscard]] virtual std::string name() const = 0;
  /// The device's driver, or "none".
  [[nodiscard]] virtual std::string driver() const = 0;
  /// What Vulkan's validation layers have said so far, a line each.
  [[nodiscard]] virtual std::vector<std::string> validation_messages() const { return {}; }

  /// What a caller should know of the renders so far, a line each.
  [[nodiscard]] virtual std::vector<std::string> remarks() const { return {}; }

  /// Gets everything ready: packing, uploading and compiling. Throws Error for a request that does
  /// not fit the scene, and for a scene that does not fit the device. The backend must outlive the
  /// rendering.
  [[nodiscard]] virtual std::unique_ptr<Rendering> start(const ScenePtr& scene,
                                                         const RenderRequest& request) = 0;

  /// Starts and runs a render; returns its film.
  [[nodiscard]] Film render(const ScenePtr& scene, const RenderRequest& request = {});
};

struct BackendOptions {
  /// Of Vulkan: an index or part of a name; empty: the best. "all", or several with commas between:
  /// they share the samples of each render; "reference" among them is the reference in float.
  std::string device = {};
  std::optional<Precision> reference = {};  ///< the reference in this precision, and no device
  bool validate = false;                    ///< turn Vulkan's validation layers on
};

/// Throws Error where there is no such device, or none that is usable.
[[nodiscard]] std::unique_ptr<Backend> open_backend(const BackendOptions& options = {});

}  // namespace facet
