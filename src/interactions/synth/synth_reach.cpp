// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <optional>

#include "interactions/synth/synth_acts.h"

namespace unseen::interactions {
namespace {

using Targets = std::array<std::optional<Vec3>, 2>;

/// Bends, twists and goes down as little as the arms need to get there.
Posture reaching(const Body& body, const Posture& stand, const Targets& targets) {
  const double facing = heading(stand.hips);
  const bool both = targets[kRight] && targets[kLeft];
  double lowest = 2.0;
  for (const auto& t : targets)
    if (t) lowest = std::min(lowest, t->z());
  const double squat = std::clamp(0.75 * (0.9 - lowest), 0.0, 0.4);
  Posture p = stand;
  for (double effort = 0; effort <= 1.0; effort += 0.02) {
    const double bend = (lowest > 1.25 ? 0.4 : 1.3) * effort, twist = both ? 0.0 : (targets[kRight] ? 0.5 : -0.5) * std::min(1.0, 1.5 * effort);
    p.pelvis = stand.pelvis + ahead(facing) * (0.06 * effort - 0.28 * body.trunk * std::sin(bend)) - Vec3(0, 0, squat * effort);
    p.hips = about_z(facing + 0.3 * twist) * about_x(-0.4 * bend);
    p.chest = about_z(facing + twist) * about_x(-bend);
    bool there = true;
    for (const int side : {kRight, kLeft})
      if (targets[side]) there = there && (shoulder_of(body, p, side) - *targets[side]).norm() < 0.92 * body.arm();
    if (there) break;
  }
  const Vec3 seen = targets[kRight] ? *targets[kRight] : *targets[kLeft];
  p.head = looking_at(body, p, seen);
  for (const int side : {kRight, kLeft}) {
    const double pitch = std::asin(std::clamp((p.chest * Vec3::UnitZ()).dot(ahead(facing)), -1.0, 1.0));
    p.hands[side] = targets[side] ? *targets[side] : hanging_hand(body, p, side, pitch + 0.05, 0.3);
  }
  return p;
}

/// Where a hand goes: so far right of the piece's middle, as seen by who stands before it, and so far behind its edge.
Vec3 target_at(const Piece& piece, double right, double inside, double height) {
  const double most = piece.half.x() - 0.05;
  return piece.placement * Vec3(std::clamp(-right, -most, most), piece.edge - inside, height);
}

/// Somewhere in a compartment or on top, with one hand or both.
Targets draw_targets(const Piece& piece, const Body& body, const Posture& base, Random& random) {
  double height = piece.surface + random.uniform(0.04, 0.12), inside = random.uniform(0.1, 0.3);
  if (piece.object.superclass() == Superclass::shelf) {
    const auto& level = *std::min_element(piece.levels.begin(), piece.levels.end(), [&, wish = random.uniform(0.5, 1.6)](const auto& a, const auto& b) {
      return std::abs(a[0] - wish) < std::abs(b[0] - wish);
    });
    const bool on_top = piece.height < 1.2 && random.uniform() < 0.4;
    height = on_top ? piece.height + 0.06 : std::min(level[0] + random.uniform(0.08, 0.2), 1.12 * body.height);
    inside = on_top ? random.uniform(0.05, 0.15) : -random.uniform(0.02, 0.08);
  }
  const bool both = random.uniform() < 0.3;
  const int one = random.uniform() < 0.65 ? kRight : kLeft;
  const double middle = -(piece.placement.inverse() * base.pelvis).x();
  Targets targets;
  for (const int side : {kRight, kLeft})
    if (both || side == one) targets[side] = target_at(piece, middle + outward(side) * (both ? 0.14 : random.uniform(0.0, 0.28)), inside, height);
  return targets;
}

bool arrives(const Body& body, const Posture& posture, const Targets& targets) {
  for (const int side : {kRight, kLeft})
    if (targets[side] && (shoulder_of(body, posture, side) - *targets[side]).norm() > 0.99 * body.arm()) return false;
  return true;
}

/// A step along the front of a piece, still facing it.
void step_aside(Motion& motion, const Body& body, const Manner& manner, const Piece& piece, Random& random) {
  const Posture& now = motion.back().posture;
  Vec3 own = piece.placement.inverse() * now.pelvis;
  own.x() = std::clamp(own.x() + random.uniform(-0.24, 0.24), -piece.half.x() + 0.1, piece.half.x() - 0.1);
  const Vec2 from = now.pelvis.head<2>(), to = (piece.placement * own).head<2>();
  const std::size_t first = motion.size();
  if ((to - from).norm() < 0.25) walk(motion, body, manner, {from, to}, heading(now.hips));
  for (std::size_t k = first; k < motion.size(); ++k) motion[k].action = Action::reach;
}

}  // namespace

void reach(Motion& motion, const Body& body, const Manner& manner, const Piece& piece, Random& random) {
  const std::array<int, 2> touched = {-1, piece.object.id};
  const bool shelf = piece.object.superclass() == Superclass::shelf;
  for (int left = 1 + static_cast<int>(random.index(shelf ? 4 : 3)); left > 0; --left) {
    const Posture base = motion.back().posture;
    Targets targets = draw_targets(piece, body, base, random);
    Posture there = reaching(body, base, targets);
    for (int attempt = 0; attempt < 20 && !arrives(body, there, targets); ++attempt) {
      targets = draw_targets(piece, body, base, random);
      there = reaching(body, base, targets);
    }
    if (!arrives(body, there, targets)) continue;
    const double time = random.uniform(0.8, 1.4) / manner.lively;
    move_to(motion, there, {time, Action::reach, touched});
    hold(motion, random.uniform(0.4, 2.2), manner, Action::reach, touched);
    // takes it to look at, or goes on
    Posture look = base;
    for (const int side : {kRight, kLeft})
      if (targets[side]) look.hands[side] = look.pelvis + look.chest * Vec3(outward(side) * 0.1, 0.27, 0.4 * body.trunk);
    look.head = looking_at(body, look, look.hands[targets[kRight] ? kRight : kLeft]);
    const bool looks = random.uniform() < (shelf ? 0.8 : 0.4);
    move_to(motion, looks ? look : base, {time, Action::reach, touched});
    if (looks) hold(motion, random.uniform(0.3, 2.0), manner, Action::reach);
    if (left > 1 && random.uniform() < 0.4) step_aside(motion, body, manner, piece, random);
  }
}

void lean(Motion& motion, const Body& body, const Manner& manner, const Piece& table, double seconds, Random& random) {
  const std::array<int, 2> touched = {-1, table.object.id};
  const Posture base = motion.back().posture;
  Targets targets;
  const double wide = random.uniform(0.15, 0.3), inside = random.uniform(0.06, 0.15), middle = -(table.placement.inverse() * base.pelvis).x();
  for (const int side : {kRight, kLeft}) targets[side] = target_at(table, middle + outward(side) * wide, inside, table.surface + 0.05);
  Posture there = reaching(body, base, targets);
  there.chest = there.chest * about_x(-random.uniform(0.05, 0.2));
  there.head = about_z(heading(base.hips) + random.uniform(-0.6, 0.6));
  there.head = there.head * about_x(random.uniform(-0.5, 0.0));
  move_to(motion, there, {random.uniform(0.9, 1.4) / manner.lively, Action::reach, touched});
  hold(motion, seconds, manner, Action::reach, touched);
  move_to(motion, base, {random.uniform(0.8, 1.2) / manner.lively, Action::reach, touched});
}

}  // namespace unseen::interactions
