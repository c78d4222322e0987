// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "interactions/synth/synth_acts.h"

namespace unseen::interactions {
namespace {

/// A point in the frame of who sits: x to the right, y forward from the front edge, z up from the floor.
Vec3 from_edge(const Piece& piece, const SitPlan& plan, double right, double forward, double up) {
  return piece.placement * Vec3(plan.along + right, piece.edge + forward, up);
}

/// Hands on the thighs, further out or in.
void hands_on_lap(Posture& p, const Body& body, const Piece& piece, const SitPlan& plan, double far, double wide) {
  for (const int side : {kRight, kLeft})
    p.hands[side] = from_edge(piece, plan, outward(side) * wide, -plan.into + far * body.thigh, piece.surface + 0.20);
}

enum class Way { upright, reclined, forward, stretched, crossed, turned, at_table, to_table };

Way draw_way(const Piece& piece, const Piece* table, Random& random) {
  const double u = random.uniform();
  if (table != nullptr && table->surface > 0.6) return u < 0.75 ? Way::at_table : u < 0.9 ? Way::upright : Way::turned;
  if (table != nullptr && u < 0.35) return Way::to_table;
  const double v = random.uniform();
  if (v < 0.18) return Way::upright;
  if (v < 0.42) return piece.rest ? Way::reclined : Way::forward;
  return v < 0.60 ? Way::forward : v < 0.72 ? Way::stretched : v < 0.84 ? Way::crossed : Way::turned;
}

/// One way of sitting; feet stand where they stood unless legs are crossed or stretched.
Posture sitting(Way way, const Body& body, const Piece& piece, const Piece* table, const SitPlan& plan, const std::array<Vec3, 2>& feet, Random& random) {
  const double back = piece.soft ? random.uniform(0.15, 0.38) : random.uniform(0.05, 0.2);
  double recline = random.uniform(-0.12, 0.06);
  if (way == Way::reclined || way == Way::stretched) recline = piece.rest ? back : 0.0;
  if (way == Way::forward) recline = -random.uniform(0.35, 0.7);
  if (way == Way::at_table) recline = -random.uniform(0.12, 0.35);
  Posture p = seated(body, piece, plan, feet, recline);
  const double far = random.uniform(0.4, 0.7), wide = random.uniform(0.05, 0.16);
  hands_on_lap(p, body, piece, plan, far - 0.6 * std::max(0.0, recline), wide);
  const double facing = piece.placement.angle;
  switch (way) {
    case Way::forward:
      hands_on_lap(p, body, piece, plan, 1.1, 0.06);
      break;
    case Way::stretched:
      for (const int side : {kRight, kLeft}) {
        const double down = p.pelvis.z() - body.ankle, leg = random.uniform(0.88, 0.94) * body.leg();
        const double out = std::min(std::sqrt(leg * leg - down * down) - plan.into, plan.off + 0.35);
        p.feet[side] = from_edge(piece, plan, outward(side) * random.uniform(0.05, 0.15), out, body.ankle);
      }
      break;
    case Way::crossed: {
      const int over = random.uniform() < 0.5 ? kRight : kLeft;
      p.feet[over] = from_edge(piece, plan, -outward(over) * (body.hip + 0.05), body.thigh - plan.into + 0.14, piece.surface - 0.04);
      break;
    }
    case Way::turned: {
      const int way_round = random.uniform() < 0.5 ? -1 : 1;
      const double turn = way_round * random.uniform(0.3, 0.75);
      p.hips = about_z(facing + 0.3 * turn) * about_x(0.1);
      p.chest = about_z(facing + turn) * about_x(0.05);
      p.head = about_z(facing + 1.6 * turn);
      break;
    }
    case Way::at_table: case Way::to_table: {
      const bool both = way == Way::at_table;
      const int one = random.uniform() < 0.7 ? kRight : kLeft;
      if (!both) hands_on_lap(p, body, piece, plan, 1.0, 0.14);
      const double y = (table->placement.inverse() * p.pelvis).y() > 0 ? table->half.y() : -table->half.y();
      const double inner = y > 0 ? -1.0 : 1.0;
      for (const int side : {kRight, kLeft}) {
        if (!both && side != one) continue;
        const Vec3 shoulder = table->placement.inverse() * shoulder_of(body, p, side);
        p.hands[side] = table->placement * Vec3(shoulder.x() * 0.97, y + inner * random.uniform(0.05, 0.2), table->surface + 0.05);
      }
      // as far forward as the arms need
      const auto short_of = [&](int side) { return (shoulder_of(body, p, side) - p.hands[side]).norm() > 0.93 * body.arm(); };
      for (double more = 0; more < 0.9 && ((both && (short_of(kRight) || short_of(kLeft))) || (!both && short_of(one))); more += 0.04)
        p.chest = p.chest * about_x(-0.04);
      p.head = looking_at(body, p, p.hands[one]);
      break;
    }
    default: break;
  }
  return p;
}

}  // namespace

SitPlan plan_sit(const Piece& piece, const Body& body, Random& random) {
  SitPlan plan;
  plan.along = piece.room * random.uniform(-1.0, 1.0);
  const double most = piece.rest ? piece.depth - 0.14 : 0.6 * piece.depth;
  plan.into = std::min({random.uniform(0.22, 0.42), most, body.thigh});
  plan.off = std::clamp(0.93 * body.thigh - plan.into + random.uniform(-0.08, 0.06), 0.11, 0.28);
  if (piece.table >= 0) plan.off = std::min(plan.off, 0.15);
  return plan;
}

Posture seated(const Body& body, const Piece& piece, const SitPlan& plan, const std::array<Vec3, 2>& feet, double recline) {
  Posture p;
  p.pelvis = from_edge(piece, plan, 0, -plan.into, piece.surface + (piece.soft ? 0.053 : 0.064) * body.height);  // hip joints above the skin
  const double facing = piece.placement.angle;
  p.hips = about_z(facing) * about_x(0.15);
  p.chest = about_z(facing) * about_x(recline);
  p.head = about_z(facing) * about_x(0.35 * recline);
  p.feet = feet;
  hands_on_lap(p, body, piece, plan, 0.7, 0.12);
  return p;
}

void sit_down(Motion& motion, const Posture& seat, const Manner& manner, int piece) {
  move_to(motion, seat, {1.55 / manner.lively, Action::sit, {piece, -1}, 0.55, 0.12});
}

void stand_up(Motion& motion, const Body& body, const Posture& seat, const Approach& approach, const Manner& manner, int piece) {
  Posture ready = seat;
  ready.chest = ready.chest * about_x(-0.3);
  for (Vec3& hand : ready.hands) hand += 0.13 * ahead(approach.heading);  // to the knees
  move_to(motion, ready, {0.6 / manner.lively, Action::stand_up, {piece, -1}});
  Posture up = standing(body, approach.at, approach.heading);
  up.feet = seat.feet;
  move_to(motion, up, {1.35 / manner.lively, Action::stand_up, {piece, -1}, 0.4, 0.14});
}

void sit(Motion& motion, const Body& body, const Manner& manner, const Piece& piece, const Piece* table, const SitPlan& plan, double seconds, Random& random) {
  const int id = piece.object.id;
  const std::array<Vec3, 2> feet = motion.back().posture.feet;
  const Posture first = seated(body, piece, plan, feet, random.uniform(-0.15, 0.05));
  sit_down(motion, first, manner, id);
  for (double left = seconds; left > 0;) {
    const Way way = draw_way(piece, table, random);
    const bool at_table = way == Way::at_table || way == Way::to_table;
    const std::array<int, 2> touched = {id, at_table ? table->object.id : -1};
    const double change = random.uniform(0.8, 1.5) / manner.lively, still = std::min(left, random.uniform(0.6, 4.0));
    move_to(motion, sitting(way, body, piece, table, plan, feet, random), {change, Action::sit, touched});
    hold(motion, still, manner, Action::sit, touched);
    left -= change + still;
  }
  move_to(motion, first, {random.uniform(0.6, 1.0) / manner.lively, Action::sit, {id, -1}});
  stand_up(motion, body, first, approach_to(piece, plan.along, plan.off, true), manner, id);
}

}  // namespace unseen::interactions
