// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/synth/synth_acts.h"

#include <algorithm>

namespace unseen::interactions {

void move_to(Motion& motion, const Posture& target, const Transition& transition) {
  const Posture start = motion.back().posture;
  const int count = std::max(1, static_cast<int>(transition.seconds * kRate));
  for (int k = 1; k <= count; ++k) {
    const double u = static_cast<double>(k) / count, share = ease(u);
    Moment m{between(start, target, share), transition.action, transition.touched};
    Posture& p = m.posture;
    const double lead = transition.lead, span = 1.0 - std::abs(lead);
    const double across = ease((u - std::max(0.0, -lead)) / span), up = ease((u - std::max(0.0, lead)) / span);
    p.pelvis.head<2>() = start.pelvis.head<2>() + across * (target.pelvis - start.pelvis).head<2>();
    p.pelvis.z() = start.pelvis.z() + up * (target.pelvis.z() - start.pelvis.z());
    const double bend = transition.lean * std::pow(std::sin(kPi * u), 2);
    p.chest = p.chest * about_x(-bend);
    p.head = p.head * about_x(-0.5 * bend);
    for (const int side : {kRight, kLeft}) {
      const double moved = (target.feet[side] - start.feet[side]).head<2>().norm();
      if (moved > 0.02 && std::abs(target.feet[side].z() - start.feet[side].z()) < 0.05)
        p.feet[side].z() += std::min(0.06, 0.3 * moved) * std::sin(kPi * u);
    }
    motion.push_back(m);
  }
}

void hold(Motion& motion, double seconds, const Manner& manner, Action action, std::array<int, 2> touched) {
  const Posture still = motion.back().posture;
  const bool upright = action == Action::stand || action == Action::reach;
  const int count = static_cast<int>(seconds * kRate);
  for (int k = 1; k <= count; ++k) {
    const double t = k / kRate, settle = ease(t / 0.7) * ease((seconds - t) / 0.7), a = manner.phase;
    const auto wave = [&](double hertz, double phase) { return settle * std::sin(2.0 * kPi * hertz * t + phase + a) - settle * std::sin(phase + a); };
    Moment m{still, action, touched};
    Posture& p = m.posture;
    const Vec3 shift = upright ? Vec3(0.008 * wave(0.23, 1), 0.006 * wave(0.31, 2), 0) : Vec3::Zero();
    p.pelvis += shift;
    const Turn moved = about_x(0.012 * wave(0.27, 3)) * about_z(0.02 * wave(0.13, 4));
    p.chest = p.chest * moved;
    p.head = p.head * about_x(0.05 * wave(0.17, 5)) * about_z(0.15 * wave(0.09, 6));
    if (touched[1] < 0 && upright)
      for (Vec3& hand : p.hands) hand = p.pelvis + p.chest * (still.chest.inverse() * (hand - still.pelvis));
    motion.push_back(m);
  }
}

Turn looking_at(const Body& body, const Posture& posture, const Vec3& target) {
  const Vec3 line = target - (posture.pelvis + posture.chest * Vec3(0, 0, body.trunk + 0.2));
  const double ahead_of = heading(posture.chest);
  const double yaw = std::clamp(std::remainder(std::atan2(-line.x(), line.y()) - ahead_of, 2.0 * kPi), -1.1, 1.1);
  return about_z(ahead_of + yaw) * about_x(std::clamp(std::atan2(line.z(), line.head<2>().norm()), -0.9, 0.5));
}

void stand_about(Motion& motion, const Body& body, const Manner& manner, double seconds, Random& random) {
  const Posture base = motion.back().posture;
  const double raise = random.uniform(0.6, 1.1) / manner.lively, which = random.uniform();
  Posture p = base;
  const double ahead_of = heading(base.hips);
  p.chest = about_z(ahead_of + random.uniform(-0.25, 0.25)) * about_x(-manner.stoop);
  p.head = about_z(ahead_of + random.uniform(-0.8, 0.8));
  p.head = p.head * about_x(random.uniform(-0.35, 0.1));
  for (const int side : {kRight, kLeft}) p.hands[side] = hanging_hand(body, p, side, 0.05, 0.25);
  const auto before_chest = [&](double x, double y, double z) { return Vec3(p.pelvis + p.chest * Vec3(x, y, body.trunk + z)); };
  const int side = random.uniform() < 0.7 ? kRight : kLeft;
  if (which < 0.2) {  // a hand at the head
    p.hands[side] = before_chest(outward(side) * 0.12, 0.12, random.uniform(0.05, 0.25));
  } else if (which < 0.35) {  // arms folded
    for (const int s : {kRight, kLeft}) p.hands[s] = before_chest(-outward(s) * 0.08, 0.17, -0.22 - 0.03 * s);
  } else if (which < 0.5) {  // hands together before the body
    for (const int s : {kRight, kLeft}) p.hands[s] = before_chest(outward(s) * 0.05, 0.2, -body.trunk + 0.05);
  } else if (which < 0.65) {  // looks at something in a hand
    p.hands[side] = before_chest(outward(side) * 0.05, 0.3, -0.2);
    p.head = looking_at(body, p, p.hands[side]);
  }
  move_to(motion, p, {raise, Action::stand});
  hold(motion, std::max(0.3, seconds - 2.0 * raise), manner, Action::stand);
  move_to(motion, base, {raise, Action::stand});
}

Approach approach_to(const Piece& piece, double along, double off, bool away) {
  const Vec3 at = piece.placement * Vec3(along, piece.edge + off, 0);
  return {at.head<2>(), piece.placement.angle + (away ? 0.0 : kPi)};
}

}  // namespace unseen::interactions
