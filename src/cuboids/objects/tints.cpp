// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/tints.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kBlackL = 16.0, kMiddleL = 50.0, kDarkestL = 15.0;  // of CIELAB: L + 16 falls with the light as a and b do
constexpr double kOtherTint = 10.0;
constexpr double kPaler = 0.5;
constexpr double kPlain = 0.8;  // of the points, that have the tint of a plain thing

}  // namespace

std::vector<Tint> tints_of(const RgbdFrame& frame) {
  std::vector<Tint> tints;
  if (frame.color.empty() || frame.is_fused()) return tints;
  cv::Mat rgb(frame.camera.height, frame.camera.width, CV_8UC3), even, lab;
  std::copy(frame.color.front().data(), frame.color.front().data() + 3 * frame.color.size(), rgb.ptr());
  cv::medianBlur(rgb, even, 3);
  even.convertTo(even, CV_32F, 1.0 / 255.0);
  cv::cvtColor(even, lab, cv::COLOR_RGB2Lab);
  tints.reserve(frame.color.size());
  for (std::size_t i = 0; i < frame.color.size(); ++i) {
    const float* p = lab.ptr<float>() + 3 * i;
    tints.push_back((kMiddleL + kBlackL) / (std::max<double>(p[0], kDarkestL) + kBlackL) * Tint(p[1], p[2]));
  }
  return tints;
}

double difference(const Tint& a, const Tint& b) {
  const Tint &stronger = a.norm() > b.norm() ? a : b, &paler = a.norm() > b.norm() ? b : a;
  const double strength = stronger.norm();
  if (strength == 0.0) return 0.0;
  const Tint hue = stronger / strength, step = stronger - paler;
  const double along = step.dot(hue), across = (step - along * hue).norm();
  return std::hypot(across, kPaler * std::min(along, strength) + std::max(along - strength, 0.0));
}

bool are_other_tints(const Tint& a, const Tint& b) { return difference(a, b) > kOtherTint; }

std::optional<Tint> plain_tint(const Observation& seen, std::span<const int> points) {
  if (seen.tints.empty() || points.empty()) return std::nullopt;
  Tint middle;
  for (int k = 0; k < 2; ++k) {
    std::vector<double> values;
    for (const int i : points) values.push_back(seen.tints[seen.pixel_of_point[i]][k]);
    middle[k] = median(std::move(values));
  }
  const auto same = std::count_if(points.begin(), points.end(), [&](int i) { return (seen.tints[seen.pixel_of_point[i]] - middle).norm() < kSameTint; });
  return static_cast<double>(same) > kPlain * static_cast<double>(points.size()) ? std::optional(middle) : std::nullopt;
}

}  // namespace unseen::cuboids
