// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/retrieval.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "cuboids/applications/registration.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"

namespace unseen::cuboids {
namespace {

constexpr std::size_t kStructurePoints = 3000, kPointsOfModel = 3000, kFewPoints = 300, kPointsToRefine = 600;
constexpr std::size_t kRefined = 3;   // of the sampled turns
constexpr double kReach = 0.1;        // of the diagonal: partners of the refinement

struct Extent {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  void add(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Vec3 size() const { return high - low; }
};

/// The boxes of the object, its surface, and its bounding box along its own yaw.
struct Structure {
  std::vector<OrientedBox> boxes;
  std::vector<Vec3> points, normals;  ///< on the outer faces
  Mat3 axes;                          ///< upright
  Extent extent;                      ///< along the axes
  double diagonal() const { return extent.size().norm(); }

  bool covers(const Vec3& p, double margin) const {
    return std::any_of(boxes.begin(), boxes.end(), [&](const OrientedBox& box) {
      return ((box.axes.transpose() * (p - box.center)).cwiseAbs() - box.half_size).maxCoeff() <= margin;
    });
  }
};

/// Upright axes of which the first is the longest horizontal edge of the largest box.
Mat3 axes_of(const std::vector<OrientedBox>& boxes) {
  const auto& largest = *std::max_element(boxes.begin(), boxes.end(),
                                          [](const OrientedBox& a, const OrientedBox& b) { return a.volume() < b.volume(); });
  Vec3 along = Vec3::UnitX();
  double longest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 flat = largest.half_size[k] * Vec3(largest.axes(0, k), largest.axes(1, k), 0.0);
    if (flat.norm() <= longest) continue;
    longest = flat.norm();
    along = flat / longest;
  }
  Mat3 axes;
  axes << along, Vec3::UnitZ().cross(along), Vec3::UnitZ();
  return axes;
}

Structure structure_of(std::vector<OrientedBox> boxes, std::uint64_t seed) {
  Structure out;
  out.boxes = std::move(boxes);
  out.axes = axes_of(out.boxes);
  std::vector<double> up_to;  // summed areas of faces
  double area = 0.0;
  for (const OrientedBox& box : out.boxes)
    for (int k = 0; k < 3; ++k) {
      for (const double side : {-1.0, 1.0}) {
        up_to.push_back(area += 4.0 * box.half_size[(k + 1) % 3] * box.half_size[(k + 2) % 3]);
        for (const double s : {-1.0, 1.0})
          for (const double t : {-1.0, 1.0}) {
            Vec3 corner = box.half_size * side;
            corner[(k + 1) % 3] = s * box.half_size[(k + 1) % 3];
            corner[(k + 2) % 3] = t * box.half_size[(k + 2) % 3];
            out.extent.add(out.axes.transpose() * (box.center + box.axes * corner));
          }
      }
    }
  Random random(seed);
  const double inside = -1e-3 * out.diagonal();
  for (std::size_t n = 0; n < kStructurePoints; ++n) {
    const auto at = std::upper_bound(up_to.begin(), up_to.end(), random.uniform(0.0, area));
    const std::size_t face = std::min<std::size_t>(at - up_to.begin(), up_to.size() - 1);
    const OrientedBox& box = out.boxes[face / 6];
    const int k = static_cast<int>(face % 6 / 2);
    Vec3 p, normal = Vec3::Zero();
    normal[k] = face % 2 == 0 ? -1.0 : 1.0;
    for (int j = 0; j < 3; ++j) p[j] = j == k ? normal[k] * box.half_size[k] : random.uniform(-1.0, 1.0) * box.half_size[j];
    const Vec3 world = box.center + box.axes * p;
    if (out.covers(world, inside)) continue;
    out.points.push_back(world);
    out.normals.push_back(box.axes * normal);
  }
  return out;
}

/// A model as it is laid into the structure.
struct Matcher {
  const Structure& structure;
  const RetrievalOptions& options;

  /// Turned by an angle against the structure's axes, as large as fits into its bounding box, standing on its bottom.
  RetrievedModel fitted(const std::vector<Vec3>& points, double angle) const {
    RetrievedModel out;
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    Extent extent;
    for (const Vec3& p : points) extent.add(turn * p);
    const Vec3 room = structure.extent.size(), size = extent.size();
    out.scale = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k)
      if (size[k] > 0.0) out.scale = std::min(out.scale, room[k] / size[k]);
    Vec3 from = 0.5 * (extent.low + extent.high), to = 0.5 * (structure.extent.low + structure.extent.high);
    from.z() = extent.low.z();
    to.z() = structure.extent.low.z();
    out.T_world_model = {structure.axes * turn, structure.axes * (to - out.scale * from)};
    return out;
  }

  /// Sets the shares and the score (thesis, Section 4.5 (ii)).
  void judge(const std::vector<Vec3>& points, const std::vector<Vec3>& samples, RetrievedModel& at) const {
    const double margin = options.tolerance * structure.diagonal();
    std::vector<Vec3> covered;
    for (const Vec3& p : points) {
      const Vec3 world = at.T_world_model * (at.scale * p);
      if (structure.covers(world, margin)) covered.push_back(world);
    }
    at.model_share = static_cast<double>(covered.size()) / static_cast<double>(points.size());
    const std::vector<Vec3> normals(covered.size(), Vec3::UnitZ());  // not needed, so not fitted
    const SampledSurface near(std::move(covered), normals);
    const auto matched = std::count_if(samples.begin(), samples.end(), [&](const Vec3& p) { return near.nearest(p, margin).has_value(); });
    at.structure_share = static_cast<double>(matched) / static_cast<double>(samples.size());
    at.score = at.structure_share + at.model_share;
  }

  /// Drawn to the structure's surface.
  RetrievedModel refined(const std::vector<Vec3>& points, const SampledSurface& surface, const RetrievedModel& start) const {
    std::vector<Vec3> scaled;
    for (const Vec3& p : every_nth(points, kPointsToRefine)) scaled.push_back(start.scale * p);
    RetrievedModel out = start;
    out.T_world_model = register_upright(scaled, surface, start.T_world_model, kReach * structure.diagonal()).T_target_source;
    return out;
  }

  RetrievedModel best(const RetrievalModel& model, const SampledSurface& surface) const {
    const std::vector<Vec3> all = every_nth(model.points, kPointsOfModel), few = every_nth(model.points, kFewPoints);
    const std::vector<Vec3> samples = every_nth(structure.points, kFewPoints);
    std::vector<RetrievedModel> turns;
    const int steps = std::max(1, static_cast<int>(std::lround(2.0 * kPi / options.angle_step)));
    for (int i = 0; i < steps; ++i) {
      turns.push_back(fitted(model.points, 2.0 * kPi * i / steps));
      judge(few, samples, turns.back());
    }
    std::stable_sort(turns.begin(), turns.end(), [](const RetrievedModel& a, const RetrievedModel& b) { return a.score > b.score; });
    RetrievedModel best;
    for (std::size_t i = 0; i < std::min(kRefined, turns.size()); ++i)
      for (RetrievedModel candidate : {turns[i], refined(all, surface, turns[i])}) {
        judge(all, structure.points, candidate);
        if (candidate.score > best.score) best = candidate;
      }
    return best;
  }
};

/// None for a model without extent.
std::vector<Vec3> finite_points(const RetrievalModel& model) {
  std::vector<Vec3> out;
  Extent extent;
  for (const Vec3& p : model.points)
    if (p.allFinite()) {
      out.push_back(p);
      extent.add(p);
    }
  if (out.size() < 4 || !(extent.size().maxCoeff() > 0.0) || !extent.size().allFinite()) out.clear();
  return out;
}

std::vector<OrientedBox> boxes_of(const Completion& scene, const std::vector<int>& ids) {
  std::vector<OrientedBox> out;
  for (const int id : ids) {
    const auto at = std::find_if(scene.cuboids.begin(), scene.cuboids.end(), [&](const Cuboid& c) { return c.id == id; });
    if (at == scene.cuboids.end()) throw InputError("ids", "", std::to_string(id), "the id of a cuboid");
    out.push_back(at->box);
  }
  if (out.empty()) throw InputError("scene", "cuboids", "none", "an object to find a model for");
  return out;
}

}  // namespace

std::vector<int> largest_structure(const Completion& scene) {
  std::map<int, int> group;  // id of a cuboid → smallest id of its group
  for (const Cuboid& c : scene.cuboids) group[c.id] = c.id;
  for (bool again = true; again;) {
    again = false;
    for (const Contact& contact : scene.contacts) {
      if (!group.contains(contact.a) || !group.contains(contact.b)) continue;
      int &a = group[contact.a], &b = group[contact.b];
      again = again || a != b;
      a = b = std::min(a, b);
    }
  }
  std::map<int, double> volume;
  for (const Cuboid& c : scene.cuboids) volume[group[c.id]] += c.box.volume();
  int largest = -1;
  for (const auto& [id, v] : volume)
    if (largest < 0 || v > volume[largest]) largest = id;
  std::vector<int> out;
  for (const auto& [id, its_group] : group)
    if (its_group == largest) out.push_back(id);
  return out;
}

Retrieval retrieve_models(const Completion& scene, const std::vector<RetrievalModel>& models, const RetrievalOptions& options,
                          Context& context) {
  if (!(options.angle_step > 0.0)) throw InputError("options", "angle_step", fmt::format("{}", options.angle_step), "more than 0");
  Retrieval out;
  out.ids = options.ids.empty() ? largest_structure(scene) : options.ids;
  const Structure structure = structure_of(boxes_of(scene, out.ids), options.seed);
  const SampledSurface surface(structure.points, structure.normals);
  const Matcher matcher{structure, options};
  std::vector<RetrievalModel> usable;
  std::vector<int> index;
  for (std::size_t m = 0; m < models.size(); ++m) {
    std::vector<Vec3> points = finite_points(models[m]);
    if (points.empty()) {
      context.warn(fmt::format("left out: {} has no extent", models[m].name));
      continue;
    }
    usable.push_back({models[m].name, std::move(points)});
    index.push_back(static_cast<int>(m));
  }
  if (usable.empty()) throw InputError(models.empty() ? "models" : models.front().name, "points", "none usable", "a model with an extent");
  out.ranked.resize(usable.size());
  parallel_blocks(context, usable.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      out.ranked[m] = matcher.best(usable[m], surface);
      out.ranked[m].model = index[m];
    }
  });
  std::stable_sort(out.ranked.begin(), out.ranked.end(),
                   [](const RetrievedModel& a, const RetrievedModel& b) { return a.score > b.score; });
  return out;
}

}  // namespace unseen::cuboids
