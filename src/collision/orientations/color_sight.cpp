// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/color_sight.h"

#include <array>
#include <cmath>

namespace unseen::collision {
namespace {

constexpr double kFacing = 0.3;  // least cosine between normal and view ray
constexpr double kDark = 12.0;   // grey levels: below, the logarithm is of noise

/// Logarithms of the levels, by a table.
const std::array<double, 256>& log_levels() {
  static const auto kTable = [] {
    std::array<double, 256> t;
    for (int i = 0; i < 256; ++i) t[static_cast<std::size_t>(i)] = std::log(i + kDark);
    return t;
  }();
  return kTable;
}

}  // namespace

Light light_basis(const Vec3& n) {
  Light b;
  b << n.x(), n.y(), n.z(), n.x() * n.y(), n.y() * n.z(), n.z() * n.x(), n.x() * n.x() - n.y() * n.y(), 3.0 * n.z() * n.z() - 1.0;
  return b;
}

bool faces_camera(const Vec3& place, const Vec3& normal) { return normal.dot(place) < -kFacing * place.norm(); }

bool color_at(const Look& look, const Vec2& pixel, Color& color) {
  const double x = (pixel.x() - look.pixel.x()) / look.step + 0.5 * (kPictureSize - 1);
  const double y = (pixel.y() - look.pixel.y()) / look.step + 0.5 * (kPictureSize - 1);
  if (!(x >= 0.0 && y >= 0.0 && x < kPictureSize - 1 && y < kPictureSize - 1)) return false;
  const auto u = static_cast<int>(x), v = static_cast<int>(y);
  const double a = x - u, b = y - v;
  const auto* top = look.picture.ptr<cv::Vec3b>(v) + u;
  const auto* low = look.picture.ptr<cv::Vec3b>(v + 1) + u;
  const auto& table = log_levels();
  for (int c = 0; c < 3; ++c)
    color[c] = (table[top[0][c]] * (1 - a) + table[top[1][c]] * a) * (1 - b) + (table[low[0][c]] * (1 - a) + table[low[1][c]] * a) * b;
  return true;
}

}  // namespace unseen::collision
