// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "collision/orientations/silhouette.h"
#include "collision/orientations/symmetry.h"
#include "collision/solve/contact.h"

namespace unseen::collision {

/// A body as its silhouettes and its motion need it, in its principal frame.
struct SpinBody {
  Solid solid;
  Eigen::Matrix3Xd corners;  ///< of its convex hull, one a column
  Symmetry symmetry;
  std::vector<Quat> nearly_alike;  ///< rotations after which it looks nearly as before, beside those of `symmetry`
};

/// Throws InputError as solid_of does.
SpinBody spin_body(const Body& body, const std::string& source);

/// A body in one frame that is looked at: where it is and what its silhouette reaches.
struct Look {
  std::size_t point = 0;  ///< index into Tracks::points
  int frame = 0;
  double time = 0;        ///< s
  Vec3 center = Vec3::Zero();   ///< camera coordinates, m
  Vec2 pixel = Vec2::Zero();    ///< its projection, px
  double radius = 0;            ///< projected reach of the body, px
  Support seen = Support::Zero();  ///< of the region about `pixel`, px
  Eigen::Matrix<double, kDirections, kDirections> whitening;  ///< turns differences of `seen` into independent ones of unit variance
  cv::Mat picture;              ///< 8-bit BGR, kPictureSize square, about `pixel`; empty if not read
  double step = 1;              ///< pixels of the video to one of `picture`
};

inline constexpr int kPictureSize = 72;

/// Fills in `whitening`: noise of the outline, and what else may be slightly off: the place, the size (the depth is known to about
/// 1 %), a border all around, and a smear along `motion` (px a frame).
void set_whitening(Look& look, const Vec2& motion);

/// Differences of the body's silhouette, turned by `q` (principal axes to camera), from the one seen. Unit variance.
Support silhouette_residual(const SpinBody& body, const Camera& camera, const Look& look, const Quat& q);

/// Weight that a frame with this sum of squares has, for a frame may be spoiled (Cauchy's robust loss), and the loss itself.
double frame_weight(double square);
double frame_loss(double square);

}  // namespace unseen::collision
