// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/tints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kBlackL = 16.0, kMiddleL = 50.0, kDarkestL = 15.0;  // of CIELAB: L + 16 falls with the light as a and b do
constexpr double kOtherTint = 10.0;
constexpr double kPaler = 0.5;
constexpr double kPlain = 0.8;  // of the points, that have the tint of a plain thing

/// Light of each sRGB value, 0…1 (IEC 61966-2-1).
std::array<float, 256> light_of_srgb() {
  std::array<float, 256> light{};
  for (int k = 0; k < 256; ++k) {
    const double value = k / 255.0;
    light[k] = static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
  }
  return light;
}

float lightness(float light) { return light > 0.008856F ? std::cbrt(light) : 7.787F * light + 16.0F / 116.0F; }

/// CIELAB of linear RGB with sRGB's primaries, white D65 (OpenCV's conversion takes a tenth of a second for its tables, once a program).
Eigen::Vector3f lab_of(float red, float green, float blue) {
  const float x = lightness(0.433953F * red + 0.376219F * green + 0.189828F * blue), y = lightness(0.212671F * red + 0.715160F * green + 0.072169F * blue),
              z = lightness(0.017758F * red + 0.109477F * green + 0.872766F * blue);
  return {116.0F * y - 16.0F, 500.0F * (x - y), 200.0F * (y - z)};
}

}  // namespace

std::vector<Tint> tints_of(const RgbdFrame& frame) {
  std::vector<Tint> tints;
  if (frame.color.empty() || frame.is_fused()) return tints;
  cv::Mat rgb(frame.camera.height, frame.camera.width, CV_8UC3), even;
  std::copy(frame.color.front().data(), frame.color.front().data() + 3 * frame.color.size(), rgb.ptr());
  cv::medianBlur(rgb, even, 3);
  const std::array<float, 256> light = light_of_srgb();
  tints.reserve(frame.color.size());
  for (std::size_t i = 0; i < frame.color.size(); ++i) {
    const std::uint8_t* p = even.ptr() + 3 * i;
    const Eigen::Vector3f lab = lab_of(light[p[0]], light[p[1]], light[p[2]]);
    tints.push_back((kMiddleL + kBlackL) / (std::max<double>(lab[0], kDarkestL) + kBlackL) * lab.tail<2>().cast<double>());
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
