// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "planes/synth/synth_builder.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

constexpr double kLowest = radians(-70.0), kHighest = radians(90.0);  // elevation that a scanner reaches
constexpr std::uint32_t kNothing = RTC_INVALID_GEOMETRY_ID;
constexpr std::size_t kMostRays = 400'000'000;

/// The mesh as Embree wants it. Distances are computed anew in double precision.
class Caster {
 public:
  explicit Caster(const TriangleMesh& mesh)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
    for (const Vec3& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) *vertices++ = static_cast<float>(v[k]);
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    for (const auto& t : mesh.triangles) indices = std::copy(t.begin(), t.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
  }
  Caster(const Caster&) = delete;
  Caster& operator=(const Caster&) = delete;
  ~Caster() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  /// Index of the first triangle on the ray, or kNothing.
  std::uint32_t first_hit(const Vec3& origin, const Vec3& direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(origin.x());
    ray.ray.org_y = static_cast<float>(origin.y());
    ray.ray.org_z = static_cast<float>(origin.z());
    ray.ray.dir_x = static_cast<float>(direction.x());
    ray.ray.dir_y = static_cast<float>(direction.y());
    ray.ray.dir_z = static_cast<float>(direction.z());
    ray.ray.tnear = 0.05f;
    ray.ray.tfar = 1e6f;
    ray.ray.mask = 0xffffffffu;
    ray.hit.geomID = kNothing;
    rtcIntersect1(scene_, &context, &ray);
    return ray.hit.geomID == kNothing ? kNothing : ray.hit.primID;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

/// The angular grid of all scanners: rays are numbered scanner by scanner, column by column.
struct Grid {
  std::vector<Vec3> scanners;
  std::size_t columns = 0, rows = 0;

  Grid(std::vector<Vec3> positions, std::size_t rays) : scanners(std::move(positions)) {
    const double ratio = 2.0 * kPi / (kHighest - kLowest);
    rows = static_cast<std::size_t>(
        std::ceil(std::sqrt(static_cast<double>(rays) / static_cast<double>(scanners.size()) / ratio)));
    columns = static_cast<std::size_t>(std::ceil(static_cast<double>(rows) * ratio));
  }
  std::size_t per_scanner() const { return columns * rows; }
  std::size_t size() const { return scanners.size() * per_scanner(); }
  std::size_t scanner_of(std::size_t ray) const { return ray / per_scanner(); }
  Vec3 direction(std::size_t ray) const {
    const std::size_t in_scan = ray % per_scanner();
    const double azimuth =
        2.0 * kPi * (static_cast<double>(in_scan / rows) + 0.5) / static_cast<double>(columns);
    const double elevation = kLowest + (kHighest - kLowest) * (static_cast<double>(in_scan % rows) + 0.5) /
                                           static_cast<double>(rows);
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation)};
  }
};

using Counts = std::array<std::size_t, 2>;  // points on other surfaces, points on turned furniture

/// What every ray of a grid hits, after the drops that make the density uneven.
struct Hits {
  std::vector<std::uint32_t> triangles;
  Counts counts = {0, 0};
};

Hits cast(const SynthModel& model, const std::vector<bool>& turned, const Caster& caster, const Grid& grid,
          const SynthOptions& options, Context& context) {
  Hits hits;
  hits.triangles.resize(grid.size());
  parallel_blocks(context, grid.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      hits.triangles[i] = caster.first_hit(grid.scanners[grid.scanner_of(i)], grid.direction(i));
  });
  Random random(static_cast<std::uint64_t>(options.seed) * 3 + 1);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (hits.triangles[i] == kNothing) continue;
    const int label = model.mesh.labels[hits.triangles[i]];
    if (options.uneven > 0) {
      const double cosine = std::abs(model.planes[label].normal.dot(grid.direction(i)));
      if (random.uniform() < options.uneven * (1.0 - cosine)) {
        hits.triangles[i] = kNothing;
        continue;
      }
    }
    ++hits.counts[turned[label] ? 1 : 0];
  }
  return hits;
}

/// Small rigid misplacement of one scan, about its scanner.
RigidTransform misplacement(const Vec3& scanner, double size, Random& random) {
  constexpr double kArm = 5.0;  // m: at this distance rotation moves a point by about as much as translation
  const Vec3 axis = random.direction();
  const Mat3 rotation = Eigen::AngleAxisd(size / kArm * random.normal(), axis).toRotationMatrix();
  const Vec3 shift = size / std::sqrt(3.0) * Vec3(random.normal(), random.normal(), random.normal());
  return {rotation, scanner - rotation * scanner + shift};
}

PointCloud gather(const SynthModel& model, const std::vector<bool>& turned, const Grid& grid,
                  const Hits& hits, const Counts& wanted, const SynthOptions& options) {
  Random random(static_cast<std::uint64_t>(options.seed) * 3 + 2);
  std::vector<RigidTransform> moved(grid.scanners.size());
  for (std::size_t s = 1; s < moved.size(); ++s)
    if (options.registration > 0) moved[s] = misplacement(grid.scanners[s], options.registration, random);
  PointCloud cloud;
  Counts left = hits.counts, need = wanted;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (hits.triangles[i] == kNothing) continue;
    const int label = model.mesh.labels[hits.triangles[i]];
    const std::size_t kind = turned[label] ? 1 : 0;
    // Selection sampling: exactly `need` of those that are left, each subset equally likely.
    if (random.uniform() * static_cast<double>(left[kind]--) >= static_cast<double>(need[kind])) continue;
    --need[kind];
    const std::size_t s = grid.scanner_of(i);
    const Vec3 direction = grid.direction(i);
    const Plane& plane = model.planes[label];
    const double slope = plane.normal.dot(direction);
    const double range = -plane.signed_distance(grid.scanners[s]) / slope;
    const double slant = 1.0 / std::max(std::abs(slope), 0.1);
    const double sigma = options.noise * (1.0 + options.incidence * (slant - 1.0));
    cloud.positions.push_back(moved[s] * (grid.scanners[s] + (range + sigma * random.normal()) * direction));
    cloud.labels.push_back(label);
    if (options.normals)
      cloud.normals.push_back((moved[s].rotation * (slope < 0 ? plane.normal : -plane.normal)).cast<float>());
  }
  return cloud;
}

}  // namespace

PointCloud scan_model(const SynthModel& model, const SynthOptions& options, Context& context) {
  std::vector<bool> turned(model.planes.size());
  for (const int label : model.turned) turned[label] = true;
  const auto total = static_cast<std::size_t>(options.points);
  const double share = model.turned.empty() ? 0.0 : options.share;
  const auto on_turned = static_cast<std::size_t>(std::llround(share * static_cast<double>(total)));
  const Counts wanted = {total - on_turned, on_turned};

  const Caster caster(model.mesh);
  std::size_t rays = 100'000;
  while (true) {
    const Grid grid(model.scanners, rays);
    const Hits hits = cast(model, turned, caster, grid, options, context);
    double factor = 0;
    for (const int kind : {0, 1})
      if (wanted[kind] > 0)
        factor = std::max(factor, hits.counts[kind] == 0 ? 8.0
                                                         : static_cast<double>(wanted[kind]) /
                                                               static_cast<double>(hits.counts[kind]));
    if (factor <= 1.0) return gather(model, turned, grid, hits, wanted, options);
    rays = static_cast<std::size_t>(static_cast<double>(rays) * std::max(1.05 * factor, 1.2));
    if (rays > kMostRays)
      throw InputError("synth", "points and share",
                       fmt::format("{} points, {} on turned furniture", total, on_turned),
                       fmt::format("what {} rays can see; fewer points or another share", kMostRays));
  }
}

}  // namespace unseen::planes
