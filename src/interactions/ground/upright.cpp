// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground/upright.h"

namespace unseen::interactions {
namespace {

/// The lower leg in the picture if it stands upright: its length and the row of its ankle, px.
std::optional<Vec2> upright_leg(const Detection& d, Joint hip, Joint knee, Joint ankle, double torso) {
  constexpr double kThigh = 0.7, kShin = 0.55;  // of the torso; a thigh that is seen shorter is bent
  for (const Joint joint : {hip, knee, ankle})
    if (d.confidence[joint] < kSeen) return std::nullopt;
  if (d.pixels(1, knee) - d.pixels(1, hip) < kThigh * torso || d.pixels(1, ankle) - d.pixels(1, knee) < kShin * torso) return std::nullopt;
  const double length = (d.pixels.col(hip) - d.pixels.col(knee)).norm() + (d.pixels.col(knee) - d.pixels.col(ankle)).norm();
  return Vec2(length, d.pixels(1, ankle));
}

}  // namespace

std::optional<Upright> upright_body(const Detection& d) {
  for (const Joint joint : {right_shoulder, left_shoulder, right_hip, left_hip})
    if (d.confidence[joint] < kSeen) return std::nullopt;
  const double torso = 0.5 * (d.pixels.col(right_shoulder) + d.pixels.col(left_shoulder) - d.pixels.col(right_hip) - d.pixels.col(left_hip)).norm();
  if (!(torso > 1)) return std::nullopt;
  std::optional<Vec2> leg = upright_leg(d, right_hip, right_knee, right_ankle, torso);
  if (const auto other = upright_leg(d, left_hip, left_knee, left_ankle, torso); other && (!leg || other->y() > leg->y())) leg = other;
  if (!leg) return std::nullopt;
  return Upright{torso, leg->x(), leg->y()};
}

}  // namespace unseen::interactions
