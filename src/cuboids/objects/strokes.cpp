// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/strokes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <queue>

#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

constexpr int kHalf = 2;             // the cut works on pictures of half the size
constexpr int kRounds = 3;
constexpr double kCrease = 60.0;      // pixels a radian, of a step over a concave crease
constexpr double kColorChange = 0.3;  // pixels a level of 255
constexpr double kDepthStep = 0.6;   // m of depth that count as much as black and white

/// Two channels of colour (light and one opponent pair) and one of depth, so that the cut sees both.
cv::Mat features(const RgbdFrame& frame, const Observation& seen) {
  const int width = frame.camera.width / kHalf, height = frame.camera.height / kHalf;
  cv::Mat picture(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * kHalf) * frame.camera.width + x * kHalf;
      const auto c = frame.color.empty() ? std::array<std::uint8_t, 3>{128, 128, 128} : frame.color[i];
      const int p = seen.point_of_pixel[i];
      const double depth = p < 0 ? 0.0 : std::fmod(frame.depth[i] / kDepthStep, 2.0);
      picture.at<cv::Vec3b>(y, x) = {
          static_cast<std::uint8_t>((c[0] + 2 * c[1] + c[2]) / 4),
          static_cast<std::uint8_t>(std::clamp(128 + (int(c[0]) - int(c[2])) / 2, 0, 255)),
          static_cast<std::uint8_t>(255.0 * (depth < 1.0 ? depth : 2.0 - depth))};
    }
  return picture;
}

/// Onto a picture of a `part`th of the size.
void draw(cv::Mat& seeds, const Stroke& stroke, int value, int part) {
  for (std::size_t k = 0; k < stroke.points.size(); ++k) {
    const Vec2 a = stroke.points[k] / part, b = stroke.points[std::min(k + 1, stroke.points.size() - 1)] / part;
    cv::line(seeds, {static_cast<int>(a.x()), static_cast<int>(a.y())}, {static_cast<int>(b.x()), static_cast<int>(b.y())},
             cv::Scalar(value), 2);
  }
}

void check_inside(const RgbdFrame& frame, const cv::Mat& seeds, int value, const std::string& label) {
  if (cv::countNonZero(seeds == value) == 0) throw InputError(frame.name, "strokes", label + " outside the picture", "points within it, in pixels");
}

/// How long a step between two neighbours is, in pixels. Things meet in concave creases, and often have another colour.
double step_length(const RgbdFrame& frame, const Observation& seen, int i, int j) {
  double length = 1.0;
  const Vec3 &n = seen.graph.normals[i], &m = seen.graph.normals[j];
  if ((m - n).dot(seen.points[j] - seen.points[i]) < 0.0) length += kCrease * std::atan2(n.cross(m).norm(), n.dot(m));
  if (frame.color.empty()) return length;
  const auto &a = frame.color[seen.pixel_of_point[i]], &b = frame.color[seen.pixel_of_point[j]];
  int most = 0;
  for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(int(a[k]) - int(b[k])));
  return length + kColorChange * most;
}

}  // namespace

std::vector<std::string> stroke_labels(const RgbdFrame& frame) {
  std::vector<std::string> labels;
  for (const Stroke& stroke : frame.strokes)
    if (std::find(labels.begin(), labels.end(), stroke.label) == labels.end()) labels.push_back(stroke.label);
  return labels;
}

std::vector<int> cut_by_strokes(const RgbdFrame& frame, const Observation& seen) {
  const cv::Mat picture = features(frame, seen);
  const std::vector<std::string> labels = stroke_labels(frame);
  std::vector<int> object(frame.depth.size(), -1);
  for (std::size_t l = 0; l < labels.size(); ++l) {
    cv::Mat cut(picture.size(), CV_8UC1, cv::Scalar(cv::GC_PR_FGD));
    for (int y = 0; y < cut.rows; ++y)
      for (int x = 0; x < cut.cols; ++x) {
        const int p = seen.point_of_pixel[static_cast<std::size_t>(y * kHalf) * frame.camera.width + x * kHalf];
        if (p < 0 || seen.support_of_point[p] >= 0) cut.at<std::uint8_t>(y, x) = cv::GC_BGD;
      }
    for (const Stroke& stroke : frame.strokes)
      if (stroke.label != labels[l]) draw(cut, stroke, cv::GC_BGD, kHalf);
    for (const Stroke& stroke : frame.strokes)
      if (stroke.label == labels[l]) draw(cut, stroke, cv::GC_FGD, kHalf);
    check_inside(frame, cut, cv::GC_FGD, labels[l]);
    if (cv::countNonZero(cut == cv::GC_PR_FGD) > 0 && cv::countNonZero(cut == cv::GC_BGD) > 0) {
      cv::setRNGSeed(1);
      cv::Mat background, foreground;
      cv::grabCut(picture, cut, {}, background, foreground, kRounds, cv::GC_INIT_WITH_MASK);
    }
    for (std::size_t i = 0; i < object.size(); ++i) {
      const int y = static_cast<int>(i) / frame.camera.width / kHalf, x = static_cast<int>(i) % frame.camera.width / kHalf;
      if (y >= cut.rows || x >= cut.cols || object[i] >= 0) continue;
      const std::uint8_t c = cut.at<std::uint8_t>(y, x);
      if (c == cv::GC_FGD || c == cv::GC_PR_FGD) object[i] = static_cast<int>(l);
    }
  }
  std::vector<int> of_point;
  for (const int pixel : seen.pixel_of_point) of_point.push_back(object[pixel]);
  return of_point;
}

std::vector<int> spread_strokes(const RgbdFrame& frame, const Observation& seen, const std::vector<int>& part_of_point) {
  const std::vector<std::string> labels = stroke_labels(frame);
  cv::Mat seeds(frame.camera.height, frame.camera.width, CV_16SC1, cv::Scalar(-1));
  for (std::size_t l = 0; l < labels.size(); ++l) {
    cv::Mat own = cv::Mat::zeros(seeds.size(), CV_8UC1);
    for (const Stroke& stroke : frame.strokes)
      if (stroke.label == labels[l]) draw(own, stroke, 1, 1);
    check_inside(frame, own, 1, labels[l]);
    seeds.setTo(static_cast<double>(l), own);
  }
  std::vector<int> label(seen.points.size(), -1);
  std::vector<double> way(seen.points.size(), std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  for (std::size_t i = 0; i < label.size(); ++i) {
    if (part_of_point[i] < 0) continue;
    label[i] = seeds.ptr<short>()[seen.pixel_of_point[i]];
    if (label[i] >= 0) open.emplace(way[i] = 0.0, static_cast<int>(i));
  }
  while (!open.empty()) {
    const auto [length, i] = open.top();
    open.pop();
    if (length > way[i]) continue;
    for (const int j : seen.graph.neighbours(i)) {
      if (part_of_point[j] != part_of_point[i]) continue;
      const double longer = length + step_length(frame, seen, i, j);
      if (longer >= way[j]) continue;
      way[j] = longer;
      label[j] = label[i];
      open.emplace(longer, j);
    }
  }
  return label;
}

}  // namespace unseen::cuboids
