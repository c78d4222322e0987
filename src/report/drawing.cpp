// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "report/html.h"
#include "report/palette.h"
#include "report/surfaces.h"
#include "unseen/report/planes_files.h"

namespace unseen::report {
namespace {

constexpr double kWidth = 800, kTallest = 640, kMargin = 12;  ///< pixels of the picture

/// Maps world points to the picture.
class Canvas {
 public:
  explicit Canvas(const View& view) : view_(view) {}

  /// From above in metres, `offset` at the picture's origin.
  static Canvas in_metres(const Vec3& offset) {
    Canvas canvas(top_view());
    canvas.origin_ = {-offset.x(), offset.y()};
    canvas.decimals_ = 6;
    return canvas;
  }

  void cover(const Vec3& p) { box_.extend(flat(p)); }
  /// To pixels, so that everything covered fits.
  void fit() {
    if (box_.isEmpty()) box_.extend(Vec2::Zero());
    const Vec2 size = box_.sizes().cwiseMax(1e-9 + 1e-6 * box_.sizes().maxCoeff());
    pixels_ = std::min((kWidth - 2 * kMargin) / size.x(), (kTallest - 2 * kMargin) / size.y());
    height_ = std::max(60.0, pixels_ * size.y() + 2 * kMargin);
    origin_ = {kWidth / 2 - pixels_ * box_.center().x(), height_ / 2 + pixels_ * box_.center().y()};
  }
  Vec2 pixel(const Vec3& p) const {
    const Vec2 f = flat(p);
    return {origin_.x() + pixels_ * f.x(), origin_.y() - pixels_ * f.y()};
  }
  /// "x y"
  std::string at(const Vec3& p) const {
    const Vec2 q = pixel(p);
    return fmt::format("{:.{}f} {:.{}f}", q.x(), decimals_, q.y(), decimals_);
  }
  double depth(const Vec3& p) const { return view_.toward.dot(p); }
  std::string wrap(const std::string& body, const std::string& label) const {
    return fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">{}</svg>\n", kWidth,
                       height_, escape(label), body);
  }

 private:
  Vec2 flat(const Vec3& p) const { return {view_.right.dot(p), view_.up.dot(p)}; }

  View view_;
  Eigen::AlignedBox2d box_;
  double pixels_ = 1, height_ = kTallest;
  Vec2 origin_ = Vec2::Zero();
  int decimals_ = 1;  ///< of coordinates in paths
};

/// A closed path; vertices that fall on the same tenth of a pixel are drawn once.
std::string path_of(const Canvas& canvas, const planes::Polygon& polygon) {
  std::string path;
  for (const auto& ring : polygon) {
    std::string last;
    for (const Vec3& p : ring) {
      std::string at = canvas.at(p);
      if (at == last) continue;
      path += (last.empty() ? "M" : "L") + at;
      last = std::move(at);
    }
    path += "Z";
  }
  return path;
}

Vec3 middle_of(const std::vector<Vec3>& ring) {
  return std::accumulate(ring.begin(), ring.end(), Vec3(Vec3::Zero())) / static_cast<double>(ring.size());
}

/// The frame's colour, towards white the more the plane faces the light.
std::string shaded(const planes::ArrangedPlane& plane, const View& view) {
  const Vec3 light = (view.toward + 0.6 * view.up - 0.5 * view.right).normalized();
  const double white = 0.55 * std::abs(plane.plane.normal.dot(light));
  Rgb color = frame_color(plane.frame);
  for (auto& c : color) c = static_cast<std::uint8_t>(std::lround(c + white * (255 - c)));
  return hex(color);
}

/// Dots of one colour as a single path, drawn by its round line caps.
std::string dots(const Canvas& canvas, const PointSample& points, std::size_t limit,
                 const std::function<std::string(int plane)>& color_of) {
  std::map<std::string, std::string> paths;
  const std::size_t step =
      std::max<std::size_t>(1, (points.positions.size() + limit - 1) / std::max<std::size_t>(limit, 1));
  for (std::size_t i = 0; i < points.positions.size(); i += step) {
    paths[color_of(points.plane_of_point[i])].append("M").append(canvas.at(points.positions[i])).append("h0");
  }
  std::string body;
  for (const auto& [color, path] : paths)
    body += fmt::format("<path class=\"dots\" stroke=\"{}\" d=\"{}\"/>", color, path);
  return body;
}

/// A group a frame with the segments that have it.
std::string segments(const Canvas& canvas, const planes::Arrangement& a) {
  std::string body;
  for (std::size_t f = 0; f < a.frames.size(); ++f) {
    body += fmt::format("<g id=\"frame_{}\" stroke=\"{}\">\n", f, hex(frame_color(static_cast<int>(f))));
    for (const int p : a.frames[f].planes)
      if (const auto& segment = a.planes[static_cast<std::size_t>(p)].segment)
        body += fmt::format("<path id=\"plane_{}\" class=\"segment\" d=\"M{}L{}\"/>\n", p,
                            canvas.at((*segment)[0]), canvas.at((*segment)[1]));
    body += "</g>\n";
  }
  return body;
}

/// What hides a room from above: ceilings, if there is a floor below them to be seen.
bool is_lid(const planes::ArrangedPlane& plane, const planes::Arrangement& a) {
  return plane.tag == "ceiling" && std::any_of(a.planes.begin(), a.planes.end(),
                                               [](const auto& other) { return other.tag == "floor"; });
}

}  // namespace

View top_view() {
  return {};
}

View oblique_view() {
  const Vec3 toward = Vec3(0.5, -1.0, std::tan(radians(30.0)) * std::hypot(0.5, 1.0)).normalized();
  const Vec3 right = Vec3::UnitZ().cross(toward).normalized();
  return {right, toward.cross(right), toward};
}

std::string svg_of_planes(const planes::Arrangement& a, const View& view, const std::string& label) {
  Canvas canvas(view);
  std::vector<std::size_t> order;
  std::vector<double> depth(a.planes.size());
  double total_area = 0;
  for (std::size_t p = 0; p < a.planes.size(); ++p) {
    const planes::ArrangedPlane& plane = a.planes[p];
    if (plane.polygon.empty() || plane.polygon[0].empty() || is_lid(plane, a)) continue;
    for (const Vec3& v : plane.polygon[0]) canvas.cover(v);
    depth[p] = canvas.depth(middle_of(plane.polygon[0]));
    total_area += plane.area;
    order.push_back(p);
  }
  canvas.fit();
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t x, std::size_t y) { return depth[x] < depth[y]; });
  std::string body, numbers;
  for (const std::size_t p : order) {
    const planes::ArrangedPlane& plane = a.planes[p];
    body += fmt::format("<path class=\"plane\" fill=\"{}\" d=\"{}\"/>", shaded(plane, view),
                        path_of(canvas, plane.polygon));
    if (plane.area < 0.02 * total_area) continue;
    const Vec2 at = canvas.pixel(middle_of(plane.polygon[0]));
    numbers += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", at.x(), at.y(), p);
  }
  return canvas.wrap(body + numbers, label);
}

std::string svg_of_points(const planes::Arrangement& a, const PointSample& points, const View& view,
                          std::size_t limit, const std::string& label) {
  Canvas canvas(view);
  for (const Vec3& p : points.positions) canvas.cover(p);
  canvas.fit();
  return canvas.wrap(
      dots(canvas, points, limit,
           [&](int plane) {
             return hex(plane_color(plane, plane < 0 ? -1 : a.planes[static_cast<std::size_t>(plane)].frame));
           }),
      label);
}

std::string svg_of_segments(const planes::Arrangement& a, const PointSample& points, std::size_t limit,
                            const std::string& label) {
  Canvas canvas(top_view());
  for (const Vec3& p : points.positions) canvas.cover(p);
  for (const planes::ArrangedPlane& plane : a.planes)
    if (plane.segment)
      for (const Vec3& end : *plane.segment) canvas.cover(end);
  canvas.fit();
  std::string body = dots(canvas, points, limit, [](int) { return hex(kUnassigned); });
  return canvas.wrap(body + segments(canvas, a), label);
}

std::string drawing_svg(const planes::Arrangement& a) {
  const Vec3 offset = storage_offset(surfaces_of(a), {});
  const Canvas canvas = Canvas::in_metres(offset);
  Eigen::AlignedBox2d box;
  for (const planes::ArrangedPlane& plane : a.planes)
    if (plane.segment)
      for (const Vec3& end : *plane.segment) box.extend(canvas.pixel(end));
  if (box.isEmpty()) box.extend(Vec2::Zero());
  const double longest = std::max(box.sizes().maxCoeff(), 1e-3), margin = 0.02 * longest;
  const Vec2 corner = box.min().array() - margin, size = box.sizes().array() + 2 * margin;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" "
      "viewBox=\"{2:.6f} {3:.6f} {4:.6f} {5:.6f}\"\n"
      "  style=\"max-width:100%;max-height:100vh\" fill=\"none\" stroke-linecap=\"round\" "
      "stroke-width=\"{6:.6f}\">\n"
      "<desc>lines of unseen, metres; world x = x + {7}, world y = {8} - y</desc>\n{9}</svg>\n",
      1e3 * size.x(), 1e3 * size.y(), corner.x(), corner.y(), size.x(), size.y(), 0.003 * longest, offset.x(),
      offset.y(), segments(canvas, a));
}

}  // namespace unseen::report
