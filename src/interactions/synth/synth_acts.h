// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/synth/synth_furniture.h"
#include "interactions/synth/synth_gait.h"

namespace unseen::interactions {

/// How a body gets from one posture to the next.
struct Transition {
  double seconds = 1;
  Action action = Action::stand;
  std::array<int, 2> touched = {-1, -1};
  double lean = 0;  ///< rad that the trunk bends forward on the way, and comes back
  double lead = 0;  ///< share of the time by which the pelvis goes across before it goes up or down
};
void move_to(Motion& motion, const Posture& target, const Transition& transition);

/// Stays, as still as people are.
void hold(Motion& motion, double seconds, const Manner& manner, Action action, std::array<int, 2> touched = {-1, -1});

/// Looks from the head towards a point, as far as a neck turns.
Turn looking_at(const Body& body, const Posture& posture, const Vec3& target);

/// Stands for a while and may raise a hand to the head, fold the arms or look around; touches nothing.
void stand_about(Motion& motion, const Body& body, const Manner& manner, double seconds, Random& random);

/// Where one stands to use a piece: before point `along` of its front edge, `off` m away, facing it or (`away`) with the back to it.
struct Approach {
  Vec2 at = Vec2::Zero();
  double heading = 0;
};
Approach approach_to(const Piece& piece, double along, double off, bool away);

/// How one sits: chosen before one walks there, so that one stands where the seat is then in reach.
struct SitPlan {
  double along = 0;  ///< of the front edge, m
  double into = 0;   ///< of the pelvis behind the edge, m
  double off = 0;    ///< of the ankles before the edge, m
};
SitPlan plan_sit(const Piece& piece, const Body& body, Random& random);

/// Sits down, sits for about so long in changing ways, and stands up again. The motion ends at approach_to(piece, along, off, true).
/// `table` may be null; then hands stay off it.
void sit(Motion& motion, const Body& body, const Manner& manner, const Piece& piece, const Piece* table, const SitPlan& plan, double seconds, Random& random);

/// Sits down on the bed, lies for so long, and comes back.
void lie(Motion& motion, const Body& body, const Manner& manner, const Piece& bed, const SitPlan& plan, double seconds, Random& random);

/// Reaches once or more for things in a shelf or on a table before which the motion ends.
void reach(Motion& motion, const Body& body, const Manner& manner, const Piece& piece, Random& random);

/// Leans on a table with both hands.
void lean(Motion& motion, const Body& body, const Manner& manner, const Piece& table, double seconds, Random& random);

/// The seated posture that `sit` and `lie` begin with.
Posture seated(const Body& body, const Piece& piece, const SitPlan& plan, const std::array<Vec3, 2>& feet, double recline);
/// From standing before a seat onto it, and back.
void sit_down(Motion& motion, const Posture& seat, const Manner& manner, int piece);
void stand_up(Motion& motion, const Body& body, const Posture& seat, const Approach& approach, const Manner& manner, int piece);

}  // namespace unseen::interactions
