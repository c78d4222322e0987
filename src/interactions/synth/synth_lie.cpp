// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/synth/synth_acts.h"

namespace unseen::interactions {

void lie(Motion& motion, const Body& body, const Manner& manner, const Piece& bed, const SitPlan& plan, double seconds, Random& random) {
  const int id = bed.object.id;
  const std::array<int, 2> touched = {id, -1};
  const std::array<Vec3, 2> feet = motion.back().posture.feet;
  const Posture seat = seated(body, bed, plan, feet, 0.0);
  sit_down(motion, seat, manner, id);
  hold(motion, random.uniform(0.3, 2.0), manner, Action::sit, touched);

  // on the back, head towards −x of the bed: the body's up is the bed's −x, its front is up
  const Turn own = about_z(bed.placement.angle - kPi / 2) * about_x(kPi / 2);
  const double x = -bed.half.x() + 0.12 + body.trunk + 0.27 * body.height / 1.7, y = std::max(-0.2, bed.edge - std::max(0.32, plan.into));
  const double skin = bed.surface + 0.10;
  Posture flat;
  flat.pelvis = bed.placement * Vec3(x, y, skin);
  flat.hips = own;
  flat.chest = own * about_x(-random.uniform(0.02, 0.15));
  flat.head = own * about_x(-random.uniform(0.1, 0.4));
  const double knees_up = random.uniform() < 0.3 ? random.uniform(0.65, 0.8) : random.uniform(0.96, 0.985), wide = random.uniform(0.06, 0.14);
  for (const int side : {kRight, kLeft}) {
    const double across = outward(side) * wide;  // the body's right is the bed's −y
    flat.feet[side] = bed.placement * Vec3(std::min(bed.half.x() + 0.1, x + knees_up * body.leg()), y - across, skin - 0.03);
    flat.hands[side] = random.uniform() < 0.5 ? Vec3(bed.placement * Vec3(x + 0.02, y - outward(side) * (body.hip + 0.14), skin))
                                              : Vec3(bed.placement * Vec3(x - 0.15, y - outward(side) * 0.06, skin + body.trunk_radius + 0.05));
  }
  Posture half = between(seat, flat, 0.5);  // leans on an elbow while the legs come up
  half.pelvis.z() += 0.03;
  for (Vec3& foot : half.feet) foot.z() = skin + 0.08;
  move_to(motion, half, {1.4 / manner.lively, Action::lie, touched});
  move_to(motion, flat, {1.4 / manner.lively, Action::lie, touched});
  hold(motion, seconds, manner, Action::lie, touched);
  move_to(motion, half, {1.4 / manner.lively, Action::lie, touched});
  move_to(motion, seat, {1.3 / manner.lively, Action::sit, touched});
  hold(motion, random.uniform(0.3, 1.5), manner, Action::sit, touched);
  stand_up(motion, body, seat, approach_to(bed, plan.along, plan.off, true), manner, id);
}

}  // namespace unseen::interactions
