// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/overlay_draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "unseen/collision/body_mesh.h"

namespace unseen::collision {
namespace {

constexpr int kShift = 4;  // drawing to a sixteenth of a pixel
constexpr double kFarthest = 1e4;  // px: what lies beyond is not drawn

cv::Scalar color_of(std::size_t body) { return body == 0 ? cv::Scalar(178, 114, 0) : cv::Scalar(0, 159, 230); }  // as on the page (BGR)

cv::Point fine(const cv::Point2d& p) { return {cvRound(p.x * (1 << kShift)), cvRound(p.y * (1 << kShift))}; }

/// A line with a light rim, to be seen on any ground.
void stroke(cv::Mat& picture, const std::vector<cv::Point>& points, bool closed, const cv::Scalar& color, int width) {
  cv::polylines(picture, points, closed, cv::Scalar::all(255), width + 2, cv::LINE_AA, kShift);
  cv::polylines(picture, points, closed, color, width, cv::LINE_AA, kShift);
}

int width_for(const cv::Mat& picture) { return std::max(1, picture.cols / 640); }

}  // namespace

OverlayPen::OverlayPen(const Shot& shot, const Reconstruction& r) : shot_(shot), r_(r), T_camera_world_(r.T_world_camera.inverse()) {
  for (std::size_t b = 0; b < 2 && b < shot.bodies.size(); ++b) surface_[b] = body_mesh(shot.bodies[b], shot.name).vertices;
}

/// The picture has the lens's distortion, which the solution has not (Brown's model, as OpenCV's calib3d has it).
std::optional<cv::Point2d> OverlayPen::pixel(const Vec3& world) const {
  const Vec3 p = T_camera_world_ * world;
  if (!(p.z() > 1e-6)) return std::nullopt;
  const auto& [k1, k2, p1, p2, k3] = shot_.camera.distortion;
  const double x = p.x() / p.z(), y = p.y() / p.z(), r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const Camera& c = r_.camera;
  const cv::Point2d at(c.fx * (x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x)) + c.cx,
                       c.fy * (y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y) + c.cy);
  if (!(std::abs(at.x) < kFarthest && std::abs(at.y) < kFarthest)) return std::nullopt;
  return at;
}

void OverlayPen::outline(std::size_t body, const BodyState& state, cv::Mat& picture) const {
  std::vector<cv::Point> points, hull;
  for (const Vec3& v : surface_[body])
    if (const auto p = pixel(state.q * v + state.p)) points.push_back(fine(*p));
  if (points.size() < 3) return;
  cv::convexHull(points, hull);
  stroke(picture, hull, true, color_of(body), width_for(picture));
}

void OverlayPen::trail(std::size_t body, int frame, cv::Mat& picture) const {
  std::vector<cv::Point> points;
  for (const FramePose& f : r_.frames) {
    if (f.frame > frame || !f.bodies[body]) continue;
    if (const auto p = pixel(f.bodies[body]->p)) points.push_back(fine(*p));
  }
  if (points.size() > 1) stroke(picture, points, false, color_of(body), width_for(picture));
}

void OverlayPen::circle(const Sighted& seen, cv::Mat& picture) const {
  if (!(seen.center.cwiseAbs().maxCoeff() < kFarthest && seen.diameter < kFarthest)) return;
  const cv::Scalar color = seen.body ? color_of(static_cast<std::size_t>(*seen.body)) : cv::Scalar::all(110);
  const int radius = cvRound(std::max(0.5 * seen.diameter, 3.0) * (1 << kShift)), width = width_for(picture);
  for (const bool rim : {true, false})
    cv::circle(picture, fine({seen.center.x(), seen.center.y()}), radius, rim ? cv::Scalar::all(255) : color, rim ? width + 2 : width, cv::LINE_AA, kShift);
}

void OverlayPen::draw(int frame, cv::Mat& picture) const {
  const auto first = std::lower_bound(r_.sighted.begin(), r_.sighted.end(), frame, [](const Sighted& seen, int value) { return seen.frame < value; });
  for (auto seen = first; seen != r_.sighted.end() && seen->frame == frame; ++seen) circle(*seen, picture);
  const FramePose* pose = nullptr;
  for (const FramePose& f : r_.frames)
    if (f.frame == frame) pose = &f;
  for (std::size_t b = 0; b < 2; ++b) {
    trail(b, frame, picture);
    if (pose != nullptr && pose->bodies[b]) outline(b, *pose->bodies[b], picture);
  }
  const int width = width_for(picture);
  for (const Impact& impact : r_.impacts) {
    const auto at = pixel(impact.contact_point);
    if (!at || frame + 1 < impact.frame) continue;
    const bool now = std::abs(frame - impact.frame) <= 1.0;
    cv::drawMarker(picture, *at, cv::Scalar::all(255), cv::MARKER_TILTED_CROSS, (now ? 24 : 12) * width, 2 + width, cv::LINE_AA);
    cv::drawMarker(picture, *at, cv::Scalar(40, 30, 200), cv::MARKER_TILTED_CROSS, (now ? 24 : 12) * width, width, cv::LINE_AA);
  }
  const std::string text = fmt::format("{}   {:.3f} s", frame, frame / r_.fps);
  const double size = 0.5 * width;
  const cv::Point corner(8 * width, picture.rows - 8 * width);
  cv::putText(picture, text, corner, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(255), 2 + width, cv::LINE_AA);
  cv::putText(picture, text, corner, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(0), width, cv::LINE_AA);
}

}  // namespace unseen::collision
