// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/synth/synth_look.h"
#include "collision/synth/synth_plan.h"

namespace unseen::collision {

/// Rows and columns [from, to) of a picture.
struct SynthPatch {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool holds(int u, int v) const { return u >= left && u < right && v >= top && v < bottom; }
};

inline SynthPatch patch_around(const Vec2& center, double radius, const Camera& camera) {
  const auto column = [&](double u) { return std::clamp(static_cast<int>(u), 0, camera.width); };
  const auto row = [&](double v) { return std::clamp(static_cast<int>(v), 0, camera.height); };
  return {column(center.x() - radius), row(center.y() - radius), column(center.x() + radius + 2), row(center.y() + radius + 2)};
}

inline SynthPatch united(const SynthPatch& a, const SynthPatch& b) {
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

/// A body at one instant, seen from the camera's centre; everything in the body's axes.
class SynthSight {
 public:
  SynthSight(const SynthBody& body, const Paint& paint, const SynthPose& pose, const Mat3& R_world_camera)
      : body_(&body), paint_(&paint), rotation_(pose.q.toRotationMatrix()), to_body_(rotation_.transpose() * R_world_camera),
        eye_(-(rotation_.transpose() * pose.p)) {
    for (const auto& f : body.faces) planes_.push_back({to_body_.transpose() * f.normal, f.offset - f.normal.dot(eye_)});
  }

  /// Distance along the ray (camera coordinates, z = 1), infinite for a miss; the face by which it enters.
  double hit(const Vec3& ray, int& face) const {
    return body_->sphere() ? hit_ball(ray) : hit_faces(ray, face);
  }

  Vec3 color(const Vec3& ray, double distance, int face) const {
    const Vec3 place = eye_ + distance * (to_body_ * ray);
    const Vec3 normal = body_->sphere() ? Vec3(place / body_->radius) : body_->faces[static_cast<std::size_t>(face)].normal;
    return lit(rotation_ * normal) * paint_->at(face, place);
  }

 private:
  static constexpr double kMiss = std::numeric_limits<double>::infinity();

  double hit_ball(const Vec3& ray) const {
    const Vec3 d = to_body_ * ray;
    const double a = d.squaredNorm(), b = eye_.dot(d), c = eye_.squaredNorm() - body_->radius * body_->radius, root = b * b - a * c;
    return root < 0 ? kMiss : (-b - std::sqrt(root)) / a;
  }

  double hit_faces(const Vec3& ray, int& face) const {
    double enter = 0, leave = kMiss;
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      const double slope = planes_[i].first.dot(ray), at = planes_[i].second / slope;
      if (slope < 0 && at > enter) {
        enter = at;
        face = static_cast<int>(i);
      } else if (slope > 0 && at < leave) {
        leave = at;
      }
      if (enter > leave) return kMiss;
    }
    return enter > 0 ? enter : kMiss;
  }

  const SynthBody* body_;
  const Paint* paint_;
  Mat3 rotation_, to_body_;
  Vec3 eye_;
  std::vector<std::pair<Vec3, double>> planes_;  ///< normal in camera axes, distance from the eye
};

}  // namespace unseen::collision
