// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/planes/synth.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planes/synth/synth_builder.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

SynthModel make_model(const SynthOptions& options) {
  if (options.scene == "lhouse") return make_lhouse(options);
  if (options.scene == "stairs") return make_stairs(options);
  if (options.scene == "floorplan") return make_floorplan(options);
  if (options.scene == "building") return make_building(options);
  return make_room(options);
}

void add_outliers(PointCloud& cloud, std::size_t count, bool two_dimensional, const SynthOptions& options) {
  if (count == 0) return;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : cloud.positions) box.extend(p);
  Random random(static_cast<std::uint64_t>(options.seed) * 3);
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = random.uniform(box.min()[k], box.max()[k]);
    if (two_dimensional) p.z() = 0;
    cloud.positions.push_back(p);
    cloud.labels.push_back(-1);
    if (!options.normals) continue;
    const double angle = random.uniform(0.0, 2.0 * kPi);
    cloud.normals.push_back(two_dimensional ? Vec3f(std::cos(angle), std::sin(angle), 0)
                                            : Vec3f(random.direction().cast<float>()));
  }
}

}  // namespace

OptionTable describe(SynthOptions& o) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  OptionTable table;
  // clang-format off
  table.add({"scene", &o.scene, "", "what is scanned; floorplan is 2D", -kInf, kInf, {"lhouse", "stairs", "room", "floorplan", "building"}});
  table.add({"points", &o.points, "", "number of points, outliers included", 100, 100000000, {}});
  table.add({"turn", &o.turn, "deg", "yaw of the turned furniture against the room (room, floorplan, building)", -90, 90, {}});
  table.add({"share", &o.share, "1", "share of the scanned points on turned furniture; 0 = there is none", 0, 0.5, {}});
  table.add({"yaw", &o.yaw, "deg", "yaw of the whole scene against the axes", -180, 180, {}});
  table.add({"floors", &o.floors, "", "storeys of the building", 1, 100, {}});
  table.add({"scanners", &o.scanners, "", "how many of the scene's scanner positions are used; 0 = all", 0, 10000, {}});
  table.add({"noise", &o.noise, "m", "standard deviation along the ray (floorplan: across the line)", 0, 1, {}});
  table.add({"incidence", &o.incidence, "1", "how much noise grows with slanted incidence", 0, 10, {}});
  table.add({"uneven", &o.uneven, "1", "how much density falls with slanted incidence (floorplan: from line to line)", 0, 1, {}});
  table.add({"outliers", &o.outliers, "1", "share of points that lie anywhere in the bounding box", 0, 0.9, {}});
  table.add({"registration", &o.registration, "m", "size of the rigid misplacement of each scan but the first", 0, 1, {}});
  table.add({"normals", &o.normals, "", "give each point the true normal of its surface", -kInf, kInf, {}});
  table.add({"seed", &o.seed, "", "seed of everything random", 0, 2147483647, {}});
  // clang-format on
  return table;
}

PointCloud sample_floorplan(const SynthModel& model, const SynthOptions& options) {
  Random random(static_cast<std::uint64_t>(options.seed) * 3 + 1);
  std::array<std::vector<int>, 2> labels;
  for (int label = 0; label < static_cast<int>(model.segments.size()); ++label)
    labels[std::count(model.turned.begin(), model.turned.end(), label)].push_back(label);
  const auto total = static_cast<std::size_t>(options.points);
  const double share = model.turned.empty() ? 0.0 : options.share;
  const auto on_turned = static_cast<std::size_t>(std::llround(share * static_cast<double>(total)));
  PointCloud cloud;
  for (const int kind : {0, 1}) {
    std::vector<double> reach;  // running sum of length times density
    double sum = 0;
    for (const int label : labels[kind]) {
      const auto& [a, b] = model.segments[label];
      reach.push_back(sum += (b - a).norm() * (1.0 - 0.9 * options.uneven * random.uniform()));
    }
    for (std::size_t i = 0; i < (kind == 1 ? on_turned : total - on_turned); ++i) {
      const auto found = std::upper_bound(reach.begin(), std::prev(reach.end()), random.uniform(0.0, sum));
      const int label = labels[kind][static_cast<std::size_t>(found - reach.begin())];
      const auto& [a, b] = model.segments[label];
      const Vec3& normal = model.planes[label].normal;
      cloud.positions.push_back(a + random.uniform() * (b - a) + options.noise * random.normal() * normal);
      cloud.labels.push_back(label);
      if (options.normals) cloud.normals.push_back(normal.cast<float>());
    }
  }
  return cloud;
}

SynthScene make_scene(const SynthOptions& options, Context& context) {
  check_options(options, "synth");
  SynthModel model = make_model(options);
  if (options.scanners > 0 && static_cast<std::size_t>(options.scanners) < model.scanners.size())
    model.scanners.resize(static_cast<std::size_t>(options.scanners));
  SynthScene scene;
  scene.two_dimensional = options.scene == "floorplan";
  const auto outliers = static_cast<std::size_t>(std::llround(options.outliers * options.points));
  SynthOptions surface = options;
  surface.points -= static_cast<int>(outliers);
  scene.cloud =
      scene.two_dimensional ? sample_floorplan(model, surface) : scan_model(model, surface, context);
  add_outliers(scene.cloud, outliers, scene.two_dimensional, options);
  if (model.scanners.size() == 1) scene.cloud.viewpoint = model.scanners.front();
  scene.truth = std::move(model.mesh);
  scene.planes = std::move(model.planes);
  scene.frames = std::move(model.frames);
  scene.axes = std::move(model.axes);
  scene.turned = std::move(model.turned);
  scene.scanners = std::move(model.scanners);
  return scene;
}

}  // namespace unseen::planes
