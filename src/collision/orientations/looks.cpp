// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/looks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "collision/orientations/views.h"
#include "core/linear.h"
#include "io/clip.h"

namespace unseen::collision {
namespace {

constexpr double kSpacing = 0.02;    // s: no body turns by more than a third of a turn from look to look
constexpr std::size_t kLeast = 10, kMost = 28;
constexpr double kSpur = 0.06;       // of the radius
constexpr int kViews = 200;
constexpr double kPart = 0.8, kExcess = 1.35;  // of the least and the largest area that the body can show
constexpr double kAround = 1.15;     // of the radius: half the picture

bool distorted(const ShotCamera& camera) {
  return std::any_of(camera.distortion.begin(), camera.distortion.end(), [](double k) { return k != 0.0; });
}

cv::Matx33d intrinsics(const Camera& c) { return {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1}; }

/// Pixels of a decoded frame as pixels of the tracks: without distortion, then moved to the first frame's place.
void to_track_pixels(std::vector<cv::Point2d>& pixels, int frame, const ShotCamera& camera, const Footage& footage) {
  if (distorted(camera)) {
    const cv::Matx33d k = intrinsics(camera.camera);
    const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
    cv::undistortPoints(pixels, pixels, k, distortion, cv::noArray(), k);
  }
  if (!footage.shift.empty()) cv::transform(pixels, pixels, footage.shift[static_cast<std::size_t>(frame)]);
}

/// The way back.
void to_frame_pixels(std::vector<cv::Point2d>& pixels, int frame, const ShotCamera& camera, const Footage& footage) {
  if (!footage.shift.empty()) {
    cv::Mat back;
    cv::invertAffineTransform(footage.shift[static_cast<std::size_t>(frame)], back);
    cv::transform(pixels, pixels, back);
  }
  if (!distorted(camera)) return;
  std::vector<cv::Point3d> rays;
  const Camera& c = camera.camera;
  for (const cv::Point2d& p : pixels) rays.emplace_back((p.x - c.cx) / c.fx, (p.y - c.cy) / c.fy, 1.0);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  cv::projectPoints(rays, cv::Vec3d::all(0), cv::Vec3d::all(0), intrinsics(c), distortion, pixels);
}

const Region* region_of(const TrackPoint& point, const Footage& footage) {
  const auto frame = static_cast<std::size_t>(point.frame);
  if (point.region < 0 || frame >= footage.regions.size() || static_cast<std::size_t>(point.region) >= footage.regions[frame].size())
    return nullptr;
  if (frame < footage.doubled.size() && footage.doubled[frame]) return nullptr;
  return &footage.regions[frame][static_cast<std::size_t>(point.region)];
}

/// Whether two points of the tracks share a region: the bodies are seen as one.
bool shared(const Tracks& tracks, std::size_t at) {
  const TrackPoint& p = tracks.points[at];
  for (std::size_t i = 0; i < tracks.points.size(); ++i)
    if (i != at && tracks.points[i].frame == p.frame && tracks.points[i].region == p.region) return true;
  return false;
}

std::vector<std::size_t> usable_points(const Footage& footage, const Tracks& tracks, const FlightSpan& span) {
  std::vector<std::size_t> usable;
  for (std::size_t i = span.begin; i < span.end; ++i) {
    const Region* region = region_of(tracks.points[i], footage);
    if (region != nullptr && !region->at_border && !region->clipped && !region->mask.empty() && !shared(tracks, i)) usable.push_back(i);
  }
  return usable;
}

/// How fast the body's picture moves, px a frame.
Vec2 motion_at(const Tracks& tracks, const FlightSpan& span, std::size_t at) {
  const TrackPoint& before = tracks.points[std::max(span.begin + 1, at) - 1];
  const TrackPoint& after = tracks.points[std::min(span.end - 1, at + 1)];
  return after.frame == before.frame ? Vec2(Vec2::Zero()) : Vec2((after.pixel - before.pixel) / (after.frame - before.frame));
}

/// Least and largest area of the body's projections, over the square of its reach. Orthographic.
std::pair<double, double> area_range(const SpinBody& body) {
  const Camera flat{1, 1, 0, 0, 1, 1};
  constexpr double kFar = 1e3;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const Vec3& view : sphere_directions(kViews)) {
    const Vec3 center(0, 0, kFar * body.solid.mass.reach);
    const Eigen::Matrix2Xd pixels = kFar * projected(body.corners, turn_between(view, Vec3::UnitZ()), center, flat);
    std::vector<cv::Point2f> points, hull;
    for (const auto& p : pixels.colwise()) points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
    cv::convexHull(points, hull);
    const double area = cv::contourArea(hull);
    least = std::min(least, area);
    most = std::max(most, area);
  }
  return {least, most};
}

/// Fills in what the body's region says; false if it says nothing, or shows only a part of the body or more than it.
bool see(const Region& region, const ShotCamera& camera, const Footage& footage, const std::pair<double, double>& areas, Look& look) {
  std::vector<cv::Point2d> pixels;
  for (const Vec2& p : mask_outline(region.mask, kSpur * look.radius)) pixels.emplace_back(p.x() + region.box.x, p.y() + region.box.y);
  if (pixels.size() < 3) return false;
  to_track_pixels(pixels, look.frame, camera, footage);
  Eigen::Matrix2Xd outline(2, static_cast<Eigen::Index>(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i) outline.col(static_cast<Eigen::Index>(i)) << pixels[i].x, pixels[i].y;
  look.seen = support_of(outline, look.pixel);
  std::vector<Vec2> corners;
  for (const cv::Point2d& p : pixels) corners.push_back({p.x, p.y});
  const double area = polygon_area(corners) / (look.radius * look.radius);
  return area > kPart * areas.first && area < kExcess * areas.second;
}

cv::Mat cut_out(const cv::Mat& frame, const ShotCamera& camera, const Footage& footage, Look& look) {
  look.step = 2.0 * kAround * look.radius / kPictureSize;
  std::vector<cv::Point2d> pixels;
  const Vec2 corner = look.pixel - Vec2::Constant(0.5 * (kPictureSize - 1) * look.step);
  for (int v = 0; v < kPictureSize; ++v)
    for (int u = 0; u < kPictureSize; ++u) pixels.emplace_back(corner.x() + u * look.step, corner.y() + v * look.step);
  to_frame_pixels(pixels, look.frame, camera, footage);
  const int reach = static_cast<int>(std::ceil(1.6 * kAround * look.radius)) + 4;
  const cv::Point2d middle = pixels[pixels.size() / 2 + kPictureSize / 2];
  const cv::Rect box = cv::Rect(static_cast<int>(middle.x) - reach, static_cast<int>(middle.y) - reach, 2 * reach, 2 * reach) &
                       cv::Rect(0, 0, frame.cols, frame.rows);
  if (box.empty()) return {};
  cv::Mat part = frame(box), smooth, picture;
  const double blur = 0.5 * std::max(look.step, 1.0);
  cv::GaussianBlur(part, smooth, {}, blur);
  cv::Mat map(kPictureSize, kPictureSize, CV_32FC2);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    map.at<cv::Vec2f>(static_cast<int>(i) / kPictureSize, static_cast<int>(i) % kPictureSize) =
        cv::Vec2f(static_cast<float>(pixels[i].x - box.x), static_cast<float>(pixels[i].y - box.y));
  cv::remap(smooth, picture, map, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return picture;
}

}  // namespace

std::vector<Look> choose_looks(const SpinBody& body, const ShotCamera& camera, const Footage& footage, const Tracks& tracks,
                               const std::vector<Vec3>& centers, const FlightSpan& span) {
  const std::vector<std::size_t> usable = usable_points(footage, tracks, span);
  const auto areas = area_range(body);
  std::vector<Look> looks;
  if (usable.size() < 2) return looks;
  const double duration = tracks.points[usable.back()].time - tracks.points[usable.front()].time;
  const std::size_t wanted = std::clamp(static_cast<std::size_t>(duration / kSpacing) + 1, kLeast, kMost);
  const std::size_t count = std::min(wanted, usable.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = usable[(i * (usable.size() - 1) + (count - 1) / 2) / (count - 1)];
    const TrackPoint& point = tracks.points[at];
    Look look;
    look.point = at;
    look.frame = point.frame;
    look.time = point.time;
    look.center = centers[at];
    if (!(look.center.z() > 1.2 * body.solid.mass.reach)) continue;
    look.pixel = camera.camera.project(look.center);
    look.radius = std::sqrt(camera.camera.fx * camera.camera.fy) * body.solid.mass.reach / look.center.z();
    if (!see(*region_of(point, footage), camera, footage, areas, look)) continue;
    set_whitening(look, motion_at(tracks, span, at));
    looks.push_back(look);
  }
  return looks;
}

void read_pictures(const Shot& shot, const ShotCamera& camera, const Footage& footage, const std::vector<std::vector<Look>*>& flights,
                   Context& context) {
  std::multimap<int, Look*> wanted;
  for (std::vector<Look>* looks : flights)
    for (Look& look : *looks) wanted.emplace(look.frame, &look);
  if (wanted.empty() || shot.video.empty()) return;
  io::Clip clip(shot.video);
  cv::Mat frame;
  for (int k = 0; k <= wanted.rbegin()->first && clip.next(frame); ++k) {
    context.check();
    const auto [begin, end] = wanted.equal_range(k);
    for (auto it = begin; it != end; ++it) it->second->picture = cut_out(frame, camera, footage, *it->second);
  }
}

}  // namespace unseen::collision
