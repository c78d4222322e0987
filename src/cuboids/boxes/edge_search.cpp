// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/boxes/edge_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace unseen::cuboids {
namespace {

constexpr double kWeakEdge = 30, kStrongEdge = 80;  // gradient of Canny's 3 × 3 operator, of 8-bit grey
constexpr double kSameDirection = 0.45;              // rad
constexpr double kFewestVotes = 0.4;                 // of the samples of an edge
constexpr double kFarCost = 0.03;                    // a pixel
constexpr double kAgree = 2.5;                       // pixels
constexpr double kSamplePixels = 6.0;
constexpr int kMostSamples = 24;                     // an edge
constexpr double kSlant = 3.0;
constexpr double kAside = 4.0;                       // pixels, where it is asked what is beside an edge

}  // namespace

ImageEdges::ImageEdges(const RgbdFrame& frame) : width_(frame.camera.width), height_(frame.camera.height) {
  cv::Mat grey(height_, width_, CV_8UC1);
  for (std::size_t i = 0; i < frame.color.size(); ++i) {
    const auto& c = frame.color[i];
    grey.data[i] = static_cast<std::uint8_t>((299 * c[0] + 587 * c[1] + 114 * c[2] + 500) / 1000);
  }
  cv::GaussianBlur(grey, grey, {5, 5}, 1.2);
  cv::Mat gx, gy, edges, distance;
  cv::Sobel(grey, gx, CV_16S, 1, 0);
  cv::Sobel(grey, gy, CV_16S, 0, 1);
  cv::Canny(gx, gy, edges, kWeakEdge, kStrongEdge, true);
  cv::distanceTransform(255 - edges, distance, cv::DIST_L2, 3);
  const std::size_t count = frame.color.size();
  edge_.assign(edges.data, edges.data + count);
  distance_.assign(distance.ptr<float>(), distance.ptr<float>() + count);
  direction_.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    if (edge_[i]) direction_[i] = std::atan2(static_cast<float>(gy.ptr<short>()[i]), static_cast<float>(gx.ptr<short>()[i]));
}

double ImageEdges::distance(const Vec2& p) const {
  const int x = static_cast<int>(std::lround(p.x())), y = static_cast<int>(std::lround(p.y()));
  return x < 0 || y < 0 || x >= width_ || y >= height_ ? 255.0 : distance_[static_cast<std::size_t>(y) * width_ + x];
}

std::vector<double> ImageEdges::offsets(const Vec2& p, const Vec2& across, double reach) const {
  const double wanted = std::atan2(across.y(), across.x());
  std::vector<double> found;
  int last = -1;
  for (double d = -reach; d <= reach; d += 0.5) {
    const int x = static_cast<int>(std::lround(p.x() + d * across.x())), y = static_cast<int>(std::lround(p.y() + d * across.y()));
    if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
    const int i = y * width_ + x;
    if (!edge_[i] || i == last || std::abs(std::remainder(direction_[i] - wanted, kPi)) > kSameDirection) continue;
    found.push_back((Vec2(x, y) - p).dot(across));
    last = i;
  }
  return found;
}

std::vector<double> agreed_offsets(const ImageEdges& edges, const std::vector<Vec2>& points, const std::vector<Vec2>& across,
                                   double reach) {
  const int half = static_cast<int>(reach) + 1;
  std::vector<std::vector<double>> found;
  std::vector<double> votes(2 * half + 1, 0.0);
  for (std::size_t n = 0; n < points.size(); ++n) {
    found.push_back(edges.offsets(points[n], across[n], reach));
    for (const double d : found.back()) votes[static_cast<int>(std::lround(d)) + half] += 1.0;
  }
  int best = -1;
  double best_score = kFewestVotes * static_cast<double>(points.size());
  for (int b = 1; b + 1 < static_cast<int>(votes.size()); ++b) {
    const double score = (votes[b - 1] + votes[b] + votes[b + 1]) * (1.0 - kFarCost * std::abs(b - half));
    if (score > best_score) best_score = score, best = b;
  }
  std::vector<double> offsets(points.size(), std::numeric_limits<double>::quiet_NaN());
  if (best < 0) return offsets;
  for (std::size_t n = 0; n < points.size(); ++n)
    for (const double d : found[n]) {
      const double off = std::abs(d - (best - half));
      if (off < kAgree && !(std::abs(offsets[n] - (best - half)) <= off)) offsets[n] = d;
    }
  return offsets;
}

Vec3 local_point(const EdgeSample& s, const Vec3& low, const Vec3& high) {
  Vec3 p;
  p[s.i] = s.side_i < 0 ? low[s.i] : high[s.i];
  p[s.j] = s.side_j < 0 ? low[s.j] : high[s.j];
  p[s.k] = low[s.k] + s.share * (high[s.k] - low[s.k]);
  return p;
}

std::vector<EdgeSample> visible_edge_samples(const OrientedBox& box, const RgbdFrame& frame,
                                             const RigidTransform& T_world_camera, const DepthView& view) {
  std::vector<EdgeSample> samples;
  const RigidTransform T_camera_world = T_world_camera.inverse();
  const Vec3 eye = box.axes.transpose() * (T_world_camera.translation - box.center);
  const auto faces_camera = [&](int axis, double side) { return side * eye[axis] > box.half_size[axis]; };
  for (int k = 0; k < 3; ++k)
    for (const double side_i : {-1.0, 1.0})
      for (const double side_j : {-1.0, 1.0}) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        if (!faces_camera(i, side_i) && !faces_camera(j, side_j)) continue;
        EdgeSample sample{i, j, k, side_i, side_j, 0, faces_camera(i, side_i) && faces_camera(j, side_j)};
        const auto world = [&](double share) {
          sample.share = share;
          return Vec3(box.center + box.axes * local_point(sample, -box.half_size, box.half_size));
        };
        const Vec3 from = T_camera_world * world(0.0), to = T_camera_world * world(1.0);
        if (from.z() < 0.05 || to.z() < 0.05) continue;
        const double length = (frame.camera.project(to) - frame.camera.project(from)).norm();
        const int count = std::min(kMostSamples, static_cast<int>(length / kSamplePixels));
        for (int n = 0; n < count; ++n) {
          const Vec3 p = world((n + 0.5) / count);
          const Vec3 ray = (p - T_world_camera.translation).normalized(), along = box.axes.col(k);
          // Away from the box, across the ray and across the edge.
          Vec3 outward = ray.cross(along).normalized();
          if (outward.dot(p - box.center) < 0.0) outward = -outward;
          const Vec3 step = kAside * view.spacing(p) * outward;
          // The box's own surface beside its edge lies nearer by some steps where it is seen at a slant.
          const Vec3 before = p - kSlant * step.norm() * ray;
          if (view.at(before - step) == DepthView::Space::hidden || view.at(before + step) == DepthView::Space::hidden) continue;
          samples.push_back(sample);
        }
      }
  return samples;
}

}  // namespace unseen::cuboids
