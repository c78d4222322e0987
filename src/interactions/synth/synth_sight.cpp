// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/synth/synth_sight.h"

#include <algorithm>

namespace unseen::interactions {
namespace {

/// Does the segment meet the box? By slabs.
bool meets(const OrientedBox& box, const Vec3& from, const Vec3& to) {
  const Vec3 start = box.axes.transpose() * (from - box.center), line = box.axes.transpose() * (to - from);
  double first = 0, last = 1;
  for (int k = 0; k < 3; ++k) {
    const double half = box.half_size[k];
    if (std::abs(line[k]) < 1e-12) {
      if (std::abs(start[k]) > half) return false;
      continue;
    }
    const double a = (-half - start[k]) / line[k], b = (half - start[k]) / line[k];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

/// Smallest distance of two segments (Ericson, Real-Time Collision Detection, Section 5.1.9).
double segment_distance(const Vec3& p, const Vec3& p_end, const Vec3& q, const Vec3& q_end) {
  const Vec3 d = p_end - p, e = q_end - q, r = p - q;
  const double a = d.squaredNorm(), b = d.dot(e), c = d.dot(r), f = e.squaredNorm(), g = e.dot(r), det = a * f - b * b;
  double s = det > 1e-12 ? std::clamp((b * g - c * f) / det, 0.0, 1.0) : 0.0, t = f > 1e-12 ? (b * s + g) / f : 0.0;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = a > 1e-12 ? std::clamp((b * t - c) / a, 0.0, 1.0) : 0.0;
  }
  return (r + s * d - t * e).norm();
}

bool behind_figure(const Figure& figure, const Vec3& eye, const Vec3& joint) {
  const auto bone = [&](Joint a, Joint b, double radius) { return segment_distance(eye, joint, figure.pose.col(a), figure.pose.col(b)) < radius; };
  if (bone(pelvis, thorax, figure.trunk_radius) || bone(neck, head, 0.09)) return true;
  for (const auto& [a, b] : kBones) {
    const bool limb = a == right_hip || a == right_knee || a == left_hip || a == left_knee || a == right_shoulder || a == right_elbow ||
                      a == left_shoulder || a == left_elbow;
    if (limb && bone(a, b, figure.limb_radius)) return true;
  }
  return false;
}

}  // namespace

std::array<bool, kJoints> hidden_joints(const Vec3& eye, const std::vector<Figure>& figures, std::size_t who, const std::vector<Object>& objects) {
  std::array<bool, kJoints> hidden = {};
  for (int j = 0; j < kJoints; ++j) {
    const Vec3 joint = figures[who].pose.col(j);
    bool& is = hidden[static_cast<std::size_t>(j)];
    for (const Object& object : objects)
      for (const Part& part : object.parts) is = is || meets(part.box, eye, joint);
    for (std::size_t other = 0; other < figures.size(); ++other) is = is || (other != who && behind_figure(figures[other], eye, joint));
  }
  return hidden;
}

}  // namespace unseen::interactions
