#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "bench/yardstick.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/parallel.h"

namespace facet::bench {

namespace {

using shared::RayRecord;

constexpr std::size_t grain = 4096;  ///< rays a thread takes at a time; whole packets
constexpr std::size_t packet = 8;

/// Sets ray k of a packet, of which a single ray is the simplest.
template <typename Packet, typename Set>
void set_ray(Packet& ray, const RayRecord& r, const Set& set) {
  set(ray.org_x, r.origin.x);
  set(ray.org_y, r.origin.y);
  set(ray.org_z, r.origin.z);
  set(ray.tnear, r.origin.w);
  set(ray.dir_x, r.direction.x);
  set(ray.dir_y, r.direction.y);
  set(ray.dir_z, r.direction.z);
  set(ray.tfar, r.direction.w);
  set(ray.time, 0.0F);
  set(ray.mask, ~0U);
  set(ray.flags, 0U);
}

class Embree final : public Yardstick {
 public:
  explicit Embree(const PackedScene& packed) : device_(rtcNewDevice(nullptr)) {
    if (device_ == nullptr) throw DeviceError("Embree made no device");
    rtcSetDeviceMemoryMonitorFunction(
        device_,
        [](void* self, ssize_t bytes, bool /*post*/) {
          static_cast<Embree*>(self)->bytes_ += bytes;
          return true;
        },
        this);
    geometry_ = make_geometry(packed);
    build();
  }
  ~Embree() override {
    rtcReleaseScene(scene_);
    rtcReleaseGeometry(geometry_);
    rtcReleaseDevice(device_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  void trace_closest(std::span<const RayRecord> rays, Calls calls,
                     std::span<float> distances) override {
    for_each_call(rays, calls, [&](std::size_t i, std::size_t count, RTCIntersectContext& context) {
      if (calls == Calls::single) {
        distances[i] = closest(rays[i], context);
      } else {
        closest8(rays.subspan(i, count), context, distances.subspan(i));
      }
    });
  }

  void trace_any(std::span<const RayRecord> rays, Calls calls, std::span<char> occluded) override {
    for_each_call(rays, calls, [&](std::size_t i, std::size_t count, RTCIntersectContext& context) {
      if (calls == Calls::single) {
        occluded[i] = any(rays[i], context);
      } else {
        any8(rays.subspan(i, count), context, occluded.subspan(i));
      }
    });
  }

  double build() override {
    if (scene_ != nullptr) rtcReleaseScene(scene_);
    scene_ = rtcNewScene(device_);
    rtcAttachGeometry(scene_, geometry_);
    const ssize_t bytes_before = bytes_;
    const auto start = std::chrono::steady_clock::now();
    rtcCommitScene(scene_);
    const double seconds = seconds_since(start);
    tree_bytes_ = static_cast<std::uint64_t>(std::max<ssize_t>(0, bytes_ - bytes_before));
    return seconds;
  }

  [[nodiscard]] std::uint64_t bytes() const override { return tree_bytes_; }

 private:
  /// Calls body(first ray, rays, context) for every ray or packet, on all cores.
  template <typename Body>
  static void for_each_call(std::span<const RayRecord> rays, Calls calls, const Body& body) {
    const std::size_t step = calls == Calls::single ? 1 : packet;
    parallel_for(rays.size(), grain, [&](std::size_t begin, std::size_t end) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
      for (std::size_t i = begin; i < end; i += step) body(i, std::min(step, end - i), context);
    });
  }

  [[nodiscard]] RTCGeometry make_geometry(const PackedScene& packed) const {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t count = packed.triangle_count();
    auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
    auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), count));
    if (positions == nullptr || indices == nullptr)
      throw DeviceError("Embree has no memory for the triangles");
    for (std::size_t i = 0; i < count; ++i) {
      for (const vec3& corner : packed.triangle(packed.bvh.places[i])) {
        for (int a = 0; a < 3; ++a) *positions++ = corner[a];
      }
      for (std::size_t k = 0; k < 3; ++k)
        indices[3 * i + k] = static_cast<std::uint32_t>(3 * i + k);
    }
    rtcCommitGeometry(geometry);
    return geometry;
  }

  float closest(const RayRecord& r, RTCIntersectContext& context) const {
    RTCRayHit ray{};
    set_ray(ray.ray, r, [](auto& field, auto value) { field = value; });
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &ray);
    return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                     : ray.ray.tfar;
  }

  char any(const RayRecord& r, RTCIntersectContext& context) const {
    RTCRay ray{};
    set_ray(ray, r, [](auto& field, auto value) { field = value; });
    rtcOccluded1(scene_, &context, &ray);
    return ray.tfar < 0 ? 1 : 0;
  }

  void closest8(std::span<const RayRecord> rays, RTCIntersectContext& context,
                std::span<float> distances) const {
    alignas(32) std::array<int, packet> valid{};
    RTCRayHit8 rays8{};
    for (std::size_t k = 0; k < rays.size(); ++k) {
      valid[k] = -1;
      set_ray(rays8.ray, rays[k], [k](auto& field, auto value) { field[k] = value; });
      rays8.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect8(valid.data(), scene_, &context, &rays8);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const bool missed = rays8.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID;
      distances[k] = missed ? std::numeric_limits<float>::infinity() : rays8.ray.tfar[k];
    }
  }

  void any8(std::span<const RayRecord> rays, RTCIntersectContext& context,
            std::span<char> occluded) const {
    alignas(32) std::array<int, packet> valid{};
    RTCRay8 rays8{};
    for (std::size_t k = 0; k < rays.size(); ++k) {
      valid[k] = -1;
      set_ray(rays8, rays[k], [k](auto& field, auto value) { field[k] = value; });
    }
    rtcOccluded8(valid.data(), scene_, &context, &rays8);
    for (std::size_t k = 0; k < rays.size(); ++k) occluded[k] = rays8.tfar[k] < 0 ? 1 : 0;
  }

  std::atomic<ssize_t> bytes_ = 0;
  RTCDevice device_;
  RTCGeometry geometry_ = nullptr;
  RTCScene scene_ = nullptr;
  std::uint64_t tree_bytes_ = 0;
};

}  // namespace

std::string yardstick_name() { return fmt::format("Embree {}", RTC_VERSION_STRING); }

std::unique_ptr<Yardstick> make_yardstick(const PackedScene& packed) {
  return std::make_unique<Embree>(packed);
}

}  // namespace facet::bench
