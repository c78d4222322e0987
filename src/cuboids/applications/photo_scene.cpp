// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/applications/photo_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

constexpr double kLeastTolerance = 0.006, kSurfaceSigmas = 3.0;  // m: what counts as on a surface
constexpr double kInFront = 0.03;                         // m: so much nearer than the object is before it
constexpr int kRimShare = 160;                            // the rim of a hole is that part of the picture's width
constexpr double kFarthest = 1.5;                         // times the largest measured depth: planes end there
constexpr std::size_t kRowsAtOnce = 16;
constexpr double kNoDepth = std::numeric_limits<double>::infinity();

/// How far a point is outside a box; 0 within.
double distance_outside(const OrientedBox& box, const Vec3& p) {
  return ((box.axes.transpose() * (p - box.center)).cwiseAbs() - box.half_size).cwiseMax(0.0).norm();
}

/// How far a point is from the surface of a box.
double distance_to_faces(const OrientedBox& box, const Vec3& p) {
  const double outside = distance_outside(box, p);
  return outside > 0.0 ? outside : -((box.axes.transpose() * (p - box.center)).cwiseAbs() - box.half_size).maxCoeff();
}

bool within_outline(const Support& support, const Vec3& p) {
  const std::size_t n = support.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& a = support.outline[i];
    const Vec3& b = support.outline[(i + 1) % n];
    if (support.plane.normal.dot((b - a).cross(p - a)) < 0.0) return false;
  }
  return true;
}

struct Seen {
  const RgbdFrame& frame;
  const Completion& scene;
  const PhotoEditOptions& options;

  double tolerance(double depth) const { return std::max(kLeastTolerance, kSurfaceSigmas * options.noise * depth * depth); }

  /// Index of the support that a point lies on, −1 = none.
  int support_at(const Vec3& p, double within) const {
    for (std::size_t s = 0; s < scene.supports.size(); ++s)
      if (std::abs(scene.supports[s].plane.signed_distance(p)) < within) return static_cast<int>(s);
    return -1;
  }

  /// Index of the cuboid that a measured point belongs to, −1 = none.
  int cuboid_at(const Vec3& p, double depth) const {
    int best = -1;
    double least_outside = options.margin + 1e-12, least_depth = kNoDepth;
    for (std::size_t c = 0; c < scene.cuboids.size(); ++c) {
      const OrientedBox& box = scene.cuboids[c].box;
      const double outside = distance_outside(box, p);
      if (outside > least_outside) continue;
      const double to_faces = distance_to_faces(box, p);
      if (outside == least_outside && to_faces >= least_depth) continue;
      best = static_cast<int>(c);
      least_outside = outside;
      least_depth = to_faces;
    }
    return best >= 0 && least_outside > 0.0 && support_at(p, tolerance(depth)) >= 0 ? -1 : best;
  }

  /// Index of the cuboid whose box a ray without measurement meets first.
  int cuboid_along(const Ray& ray) const {
    const auto hit = nearest_surface(ray, scene, std::vector<char>(scene.cuboids.size(), 0));
    if (!hit) return -1;
    const auto at = std::find_if(scene.cuboids.begin(), scene.cuboids.end(), [&](const Cuboid& c) { return c.id == hit->id; });
    return at == scene.cuboids.end() ? -1 : static_cast<int>(at - scene.cuboids.begin());
  }
};

/// The pixels of edited cuboids, and a rim of so many pixels that is not before them.
std::vector<char> hole_of(const RgbdFrame& frame, const std::vector<float>& object_depth, int rim) {
  const int w = frame.camera.width, h = frame.camera.height;
  std::vector<float> reach = object_depth;
  for (int step = 0; step < rim; ++step) {
    const std::vector<float> before = reach;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const int i = y * w + x;
        if (before[i] > 0.0f) continue;
        float nearest = 0.0f;
        for (int v = std::max(0, y - 1); v <= std::min(h - 1, y + 1); ++v)
          for (int u = std::max(0, x - 1); u <= std::min(w - 1, x + 1); ++u)
            if (before[v * w + u] > 0.0f && (nearest == 0.0f || before[v * w + u] < nearest)) nearest = before[v * w + u];
        const bool in_front = frame.depth[i] > 0.0f && frame.depth[i] < nearest - kInFront;
        if (nearest > 0.0f && !in_front) reach[i] = nearest;
      }
  }
  std::vector<char> hole;
  for (const float depth : reach) hole.push_back(depth > 0.0f ? 1 : 0);
  return hole;
}

}  // namespace

Ray ray_of_pixel(const Camera& camera, const RigidTransform& T_world_camera, double u, double v) {
  return {T_world_camera.translation, T_world_camera.rotation * camera.unproject(u, v, 1.0)};
}

std::optional<BoxHit> hit_box(const Ray& ray, const OrientedBox& box) {
  const Vec3 origin = box.axes.transpose() * (ray.origin - box.center), direction = box.axes.transpose() * ray.direction;
  double enter = 0.0, leave = kNoDepth;
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) {
      if (std::abs(origin[k]) > box.half_size[k]) return std::nullopt;
      continue;
    }
    const double side = direction[k] > 0.0 ? -1.0 : 1.0;
    const double in = (side * box.half_size[k] - origin[k]) / direction[k], out = (-side * box.half_size[k] - origin[k]) / direction[k];
    if (in > enter) {
      enter = in;
      axis = k;
    }
    leave = std::min(leave, out);
  }
  if (axis < 0 || enter >= leave) return std::nullopt;
  return BoxHit{enter, leave, box.axes.col(axis) * (direction[axis] > 0.0 ? -1.0 : 1.0)};
}

std::optional<SurfaceHit> nearest_surface(const Ray& ray, const Completion& scene, const std::vector<char>& left_out) {
  SurfaceHit best{-1, kNoDepth};
  for (const Support& support : scene.supports) {
    const double slope = support.plane.normal.dot(ray.direction);
    if (slope >= 0.0) continue;  // seen from behind
    const double depth = -support.plane.signed_distance(ray.origin) / slope;
    if (depth > 0.0 && depth < best.depth && within_outline(support, ray.at(depth))) best = {support.id, depth};
  }
  for (std::size_t c = 0; c < scene.cuboids.size(); ++c) {
    if (left_out[c]) continue;
    const auto hit = hit_box(ray, scene.cuboids[c].box);
    if (hit && hit->enter < best.depth) best = {scene.cuboids[c].id, hit->enter};
  }
  return best.depth < kNoDepth ? std::optional(best) : std::nullopt;
}

std::vector<EditedBody> bodies_of(const std::vector<PhotoEdit>& edits, const Completion& scene) {
  std::vector<int> ids;
  for (const Cuboid& c : scene.cuboids) ids.push_back(c.id);
  const auto index_of = [&](int id) { return static_cast<int>(std::find(ids.begin(), ids.end(), id) - ids.begin()); };
  std::vector<EditedBody> bodies;
  std::vector<char> taken(ids.size(), 0);
  for (std::size_t e = 0; e < edits.size(); ++e) {
    const std::string field = fmt::format("edits[{}].id", e);
    const int first = index_of(edits[e].id);
    if (first == static_cast<int>(ids.size()))
      throw InputError("edits", field, std::to_string(edits[e].id), fmt::format("the id of a cuboid: {}", fmt::join(ids, ", ")));
    if (taken[first]) throw InputError("edits", field, std::to_string(edits[e].id), "one edit for each body (fixed cuboids are one)");
    EditedBody body;
    body.removed = edits[e].remove;
    const Vec3& middle = scene.cuboids[first].box.center;
    body.motion.rotation = Eigen::AngleAxisd(edits[e].turn, Vec3::UnitZ()).toRotationMatrix();
    body.motion.translation = middle + edits[e].move - body.motion.rotation * middle;
    body.cuboids = {first};
    taken[first] = 1;
    for (std::size_t next = 0; next < body.cuboids.size(); ++next)
      for (const Contact& contact : scene.contacts) {
        if (contact.kind != ContactKind::fixed) continue;
        const int id = ids[body.cuboids[next]];
        if (contact.a != id && contact.b != id) continue;
        const int other = index_of(contact.a == id ? contact.b : contact.a);
        if (other == static_cast<int>(ids.size()) || taken[other]) continue;
        taken[other] = 1;
        body.cuboids.push_back(other);
      }
    bodies.push_back(std::move(body));
  }
  return bodies;
}

PhotoScene photo_scene(const RgbdFrame& frame, const Completion& scene, const std::vector<EditedBody>& bodies,
                       const PhotoEditOptions& options, const Context& context) {
  const Seen seen{frame, scene, options};
  const std::size_t width = static_cast<std::size_t>(frame.camera.width), pixels = frame.depth.size();
  PhotoScene out;
  out.edited.assign(scene.cuboids.size(), 0);
  for (const EditedBody& body : bodies)
    for (const int c : body.cuboids) out.edited[c] = 1;
  out.owner.assign(pixels, -1);
  out.background.assign(pixels, 0.0f);
  out.surface.assign(pixels, -1);
  std::vector<float> object_depth(pixels, 0.0f);
  const float farthest = static_cast<float>(kFarthest) * *std::max_element(frame.depth.begin(), frame.depth.end());

  const auto ray_at = [&](std::size_t i) {
    return ray_of_pixel(frame.camera, scene.T_world_camera, static_cast<double>(i % width), static_cast<double>(i / width));
  };
  parallel_blocks(context, pixels, kRowsAtOnce * width, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Ray ray = ray_at(i);
      const double depth = frame.depth[i];
      const int owner = depth > 0.0 ? seen.cuboid_at(ray.at(depth), depth) : seen.cuboid_along(ray);
      out.owner[i] = owner;
      if (owner < 0 || !out.edited[owner]) continue;
      const auto hit = hit_box(ray, scene.cuboids[owner].box);
      object_depth[i] = static_cast<float>(depth > 0.0 || !hit ? depth : hit->enter);
    }
  });
  out.hole = hole_of(frame, object_depth, std::max(2, frame.camera.width / kRimShare));
  parallel_blocks(context, pixels, kRowsAtOnce * width, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Ray ray = ray_at(i);
      const double depth = frame.depth[i];
      if (!out.hole[i] && depth > 0.0) {
        const int support = seen.support_at(ray.at(depth), seen.tolerance(depth));
        out.background[i] = frame.depth[i];
        out.surface[i] = out.owner[i] >= 0 ? scene.cuboids[out.owner[i]].id : support >= 0 ? scene.supports[support].id : -2;
        continue;
      }
      const auto hit = nearest_surface(ray, scene, out.edited);
      const bool known = hit && hit->depth < farthest;
      out.background[i] = known ? static_cast<float>(hit->depth) : std::numeric_limits<float>::infinity();
      out.surface[i] = known ? hit->id : -1;
    }
  });
  return out;
}

}  // namespace unseen::cuboids
