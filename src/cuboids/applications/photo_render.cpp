// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/applications/photo_render.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unseen::cuboids {
namespace {

constexpr double kSnap = 0.012;     // m: measured points so near to their box are taken as on it
constexpr double kDepthSigmas = 3.0;
constexpr double kLargestStep = 0.03;  // of the depth: neighbours farther apart in depth are not one surface
constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr std::size_t kRenderedRows = 16;

/// The photograph between its pixels.
Color sampled(const RgbdFrame& frame, double u, double v) {
  const int w = frame.camera.width, h = frame.camera.height;
  const double x = std::clamp(u, 0.0, w - 1.0), y = std::clamp(v, 0.0, h - 1.0);
  const int x0 = std::min(static_cast<int>(x), std::max(0, w - 2)), y0 = std::min(static_cast<int>(y), std::max(0, h - 2));
  const int x1 = std::min(x0 + 1, w - 1), y1 = std::min(y0 + 1, h - 1);
  const double s = x - x0, t = y - y0;
  Color out;
  for (int k = 0; k < 3; ++k) {
    const double top = (1 - s) * frame.color[y0 * w + x0][k] + s * frame.color[y0 * w + x1][k];
    const double bottom = (1 - s) * frame.color[y1 * w + x0][k] + s * frame.color[y1 * w + x1][k];
    out[k] = static_cast<std::uint8_t>(std::lround((1 - t) * top + t * bottom));
  }
  return out;
}

/// Everything that the rendering of one cuboid needs.
struct Painter {
  const RgbdFrame& frame;
  const Completion& scene;
  const PhotoScene& photo;
  const PhotoEditOptions& options;
  int cuboid;
  RigidTransform motion;
  Foreground& out;

  const OrientedBox& box() const { return scene.cuboids[cuboid].box; }
  double tolerance(double depth) const { return kSnap + kDepthSigmas * options.noise * depth * depth; }

  void put(int pixel, double depth, const Color& color) {
    if (!(depth < out.depth[pixel])) return;
    out.depth[pixel] = static_cast<float>(depth);
    out.color[pixel] = color;
    out.cuboid[pixel] = cuboid;
  }

  /// Depth at which the photograph shows the cuboid: on its box if the measurement is near it; 0 = not measured.
  double relief(int pixel) const {
    const double depth = frame.depth[pixel];
    if (photo.owner[pixel] != cuboid || !(depth > 0.0)) return 0.0;
    const auto hit = hit_box(ray_of_pixel(frame.camera, scene.T_world_camera, pixel % frame.camera.width, pixel / frame.camera.width), box());
    return hit && std::abs(hit->enter - depth) < tolerance(depth) ? hit->enter : depth;
  }

  struct Corner {
    Vec2 from, to;  ///< pixels before and after
    double depth;   ///< after
  };

  void triangle(const Corner& a, const Corner& b, const Corner& c) {
    if (a.depth <= 0.0 || b.depth <= 0.0 || c.depth <= 0.0) return;
    const auto doubled = [](const Vec2& p, const Vec2& q, const Vec2& r) {
      return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
    };
    const double area = doubled(a.to, b.to, c.to);
    if (std::abs(area) < 1e-9 || area * doubled(a.from, b.from, c.from) < 0.0) return;  // seen from its back now
    const int w = frame.camera.width, h = frame.camera.height;
    const auto [left, right] = std::minmax({a.to.x(), b.to.x(), c.to.x()});
    const auto [top, bottom] = std::minmax({a.to.y(), b.to.y(), c.to.y()});
    if (right < 0.0 || bottom < 0.0 || left > w - 1.0 || top > h - 1.0) return;
    const int x0 = static_cast<int>(std::max(0.0, std::ceil(left))), x1 = static_cast<int>(std::min(w - 1.0, right));
    const int y0 = static_cast<int>(std::max(0.0, std::ceil(top))), y1 = static_cast<int>(std::min(h - 1.0, bottom));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const Vec2 p(x, y);
        const double wa = doubled(p, b.to, c.to) / area, wb = doubled(p, c.to, a.to) / area, wc = 1.0 - wa - wb;
        if (wa < -1e-9 || wb < -1e-9 || wc < -1e-9) continue;
        const double depth = 1.0 / (wa / a.depth + wb / b.depth + wc / c.depth);
        const Vec2 from = depth * (wa / a.depth * a.from + wb / b.depth * b.from + wc / c.depth * c.from);
        put(y * w + x, depth, sampled(frame, from.x(), from.y()));
      }
  }

  void paint_relief() {
    const int w = frame.camera.width, h = frame.camera.height;
    const RigidTransform T_camera_world = scene.T_world_camera.inverse();
    std::vector<double> depth(frame.depth.size());
    for (int i = 0; i < w * h; ++i) depth[i] = relief(i);
    const auto corner = [&](int x, int y) {
      const Vec3 p = motion * ray_of_pixel(frame.camera, scene.T_world_camera, x, y).at(depth[y * w + x]);
      const Vec3 seen = T_camera_world * p;
      return Corner{Vec2(x, y), seen.z() > 0.0 ? frame.camera.project(seen) : Vec2(0, 0), seen.z()};
    };
    for (int y = 0; y + 1 < h; ++y)
      for (int x = 0; x + 1 < w; ++x) {
        const std::array<double, 4> d = {depth[y * w + x], depth[y * w + x + 1], depth[(y + 1) * w + x], depth[(y + 1) * w + x + 1]};
        const auto [low, high] = std::minmax_element(d.begin(), d.end());
        if (*low <= 0.0 || *high - *low > kLargestStep * *low) continue;
        const Corner a = corner(x, y), b = corner(x + 1, y), c = corner(x, y + 1), e = corner(x + 1, y + 1);
        triangle(a, b, c);
        triangle(b, e, c);
      }
  }

  /// The mean colour of what was seen of it.
  Vec3 mean_color() const {
    Vec3 sum = Vec3::Zero();
    double count = 0;
    for (std::size_t i = 0; i < photo.owner.size(); ++i)
      if (photo.owner[i] == cuboid) {
        for (int k = 0; k < 3; ++k) sum[k] += frame.color[i][k];
        ++count;
      }
    return count > 0 ? Vec3(sum / count) : Vec3::Constant(128.0);
  }

  /// The colour of a point of the box before its motion; none if the photograph shows that nothing is there.
  std::optional<Color> box_color(const Vec3& p, const Vec3& normal, const Vec3& plain) const {
    const double light = 0.7 + 0.3 * (motion.rotation * normal).z();  // from above
    Color unseen;
    for (int k = 0; k < 3; ++k) unseen[k] = static_cast<std::uint8_t>(std::clamp(light * plain[k], 0.0, 255.0));
    if (normal.dot(scene.T_world_camera.translation - p) <= 0.0) return unseen;
    const Vec3 seen = scene.T_world_camera.inverse() * p;
    if (seen.z() <= 0.0) return unseen;
    const Vec2 place = frame.camera.project(seen);
    const int u = static_cast<int>(std::lround(place.x())), v = static_cast<int>(std::lround(place.y()));
    if (u < 0 || v < 0 || u >= frame.camera.width || v >= frame.camera.height) return unseen;
    // The rim of its face may round to a pixel of the background; then the neighbour that is its own counts.
    const double within = tolerance(seen.z());
    double least = kInfinite;
    int own = -1;
    for (int y = std::max(0, v - 1); y <= std::min(frame.camera.height - 1, v + 1); ++y)
      for (int x = std::max(0, u - 1); x <= std::min(frame.camera.width - 1, u + 1); ++x) {
        const int i = y * frame.camera.width + x;
        const double away = (place - Vec2(x, y)).squaredNorm(), depth = frame.depth[i];
        const bool fits = photo.owner[i] == cuboid && (!(depth > 0.0) || std::abs(depth - seen.z()) < within);
        if (!fits || away >= least) continue;
        least = away;
        own = i;
      }
    if (own >= 0) return frame.color[own];
    const int pixel = v * frame.camera.width + u;
    const double measured = frame.depth[pixel];
    if (photo.owner[pixel] != cuboid && measured > 0.0 && measured < seen.z() - within) return unseen;
    return std::nullopt;
  }

  void paint_box() {
    const Vec3 plain = mean_color();
    const RigidTransform back = motion.inverse();
    const int w = frame.camera.width;
    for (int i = 0; i < static_cast<int>(out.cuboid.size()); ++i) {
      if (out.cuboid[i] == cuboid) continue;  // its relief is there
      const Ray now = ray_of_pixel(frame.camera, scene.T_world_camera, i % w, i / w);
      const Ray before = {back * now.origin, back.rotation * now.direction};
      const auto hit = hit_box(before, box());
      if (!hit || hit->enter >= out.depth[i]) continue;
      if (const auto color = box_color(before.at(hit->enter), hit->normal, plain)) put(i, hit->enter, *color);
    }
  }
};

/// Directions to a round light overhead that is seen under 60°, evenly spread (a sunflower's spiral).
std::vector<Vec3> light_directions() {
  constexpr int kDirections = 64;
  const double golden = kPi * (3.0 - std::sqrt(5.0)), widest = std::tan(radians(30.0));
  std::vector<Vec3> out;
  for (int i = 0; i < kDirections; ++i) {
    const double radius = widest * std::sqrt((i + 0.5) / kDirections);
    out.push_back(Vec3(radius * std::cos(golden * i), radius * std::sin(golden * i), 1.0).normalized());
  }
  return out;
}

}  // namespace

Foreground render_moved(const RgbdFrame& frame, const Completion& scene, const std::vector<EditedBody>& bodies,
                        const PhotoScene& photo, const PhotoEditOptions& options, const Context& context) {
  const std::size_t pixels = frame.depth.size();
  Foreground out{std::vector<float>(pixels, kInfinite), std::vector<Color>(pixels), std::vector<int>(pixels, -1)};
  for (const EditedBody& body : bodies) {
    if (body.removed) continue;
    for (const int cuboid : body.cuboids) {
      context.check();
      Painter painter{frame, scene, photo, options, cuboid, body.motion, out};
      painter.paint_relief();
      painter.paint_box();
    }
  }
  return out;
}

std::vector<float> shadow_of_moved(const RgbdFrame& frame, const Completion& scene, const std::vector<EditedBody>& bodies,
                                   const PhotoScene& photo, const Context& context) {
  const std::size_t pixels = frame.depth.size();
  const int w = frame.camera.width;
  std::vector<OrientedBox> boxes;
  for (const EditedBody& body : bodies)
    for (const int c : body.cuboids) {
      if (body.removed) continue;
      const OrientedBox& box = scene.cuboids[c].box;
      boxes.push_back({body.motion * box.center, body.motion.rotation * box.axes, box.half_size});
    }
  std::vector<float> out(pixels, 0.0f);
  if (boxes.empty()) return out;
  const std::vector<Vec3> lights = light_directions();
  parallel_blocks(context, pixels, kRenderedRows * static_cast<std::size_t>(w), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double depth = photo.background[i];
      if (!std::isfinite(depth)) continue;
      const int pixel = static_cast<int>(i);
      const Vec3 p = ray_of_pixel(frame.camera, scene.T_world_camera, pixel % w, pixel / w).at(depth);
      std::vector<OrientedBox> above;  // that can come between p and the light
      for (const OrientedBox& box : boxes) {
        const double rise = box.center.z() + box.axes.row(2).cwiseAbs().dot(box.half_size) - p.z();
        const double across = (box.center - p).head<2>().norm() - box.half_size.norm();
        if (rise > 0.0 && across < rise * std::tan(radians(30.0))) above.push_back(box);
      }
      int kept_off = 0;
      for (const Vec3& light : above.empty() ? std::vector<Vec3>() : lights)
        kept_off += std::any_of(above.begin(), above.end(), [&](const OrientedBox& box) {
          return box.contains(p) || hit_box({p, light}, box).has_value();
        });
      out[i] = static_cast<float>(kept_off) / static_cast<float>(lights.size());
    }
  });
  return out;
}

}  // namespace unseen::cuboids
