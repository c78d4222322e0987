// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "unseen/collision/types.h"

namespace unseen::collision {

/// Draws what a solution says of a frame into its picture or, without one, what was seen to move.
class OverlayPen {
 public:
  OverlayPen(const Shot& shot, const Reconstruction& r);
  void draw(int frame, cv::Mat& picture) const;

 private:
  std::optional<cv::Point2d> pixel(const Vec3& world) const;
  void circle(const Sighted& seen, cv::Mat& picture) const;
  void outline(std::size_t body, const BodyState& state, cv::Mat& picture) const;
  void trail(std::size_t body, int frame, cv::Mat& picture) const;

  const Shot& shot_;
  const Reconstruction& r_;
  RigidTransform T_camera_world_;
  std::array<std::vector<Vec3>, 2> surface_;  ///< points of each body, about its centre
};

}  // namespace unseen::collision
