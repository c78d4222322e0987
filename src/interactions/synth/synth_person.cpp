// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/synth/synth_person.h"

#include <algorithm>

namespace unseen::interactions {
namespace {

enum class Errand { sit, reach, lean, lie, wander };

struct Visit {
  Errand errand = Errand::wander;
  int piece = -1;
};

/// What people do with a piece, the likelier the less it was used.
Visit draw_visit(const Room& room, const std::vector<int>& used, bool still, Random& random) {
  if (still || room.pieces.empty() || random.uniform() < 0.12) return {};
  std::vector<double> weights;
  double sum = 0;
  for (std::size_t i = 0; i < room.pieces.size(); ++i) {
    const double liked = room.pieces[i].idle ? 0.0 : room.pieces[i].object.superclass() == Superclass::sit ? 2.0 : 1.0;
    weights.push_back(sum += liked / (1.0 + 3.0 * used[i]));
  }
  if (sum == 0) return {};
  const double pick = random.uniform(0.0, sum);
  const int piece = static_cast<int>(std::upper_bound(weights.begin(), weights.end() - 1, pick) - weights.begin());
  const std::string& category = room.pieces[static_cast<std::size_t>(piece)].object.category;
  const double u = random.uniform();
  if (category == "shelf") return {Errand::reach, piece};
  if (category == "table" || category == "desk") return {u < 0.65 ? Errand::reach : Errand::lean, piece};
  if (category == "bed" && u < 0.7) return {Errand::lie, piece};
  return {Errand::sit, piece};
}

bool walk_to(Motion& motion, const FloorPlan& plan, const Body& body, const Manner& manner, const Approach& goal) {
  const auto path = find_path(plan, motion.back().posture.pelvis.head<2>(), goal.at);
  if (path) walk(motion, body, manner, *path, goal.heading);
  return path.has_value();
}

Vec2 free_place(const FloorPlan& plan, double clearance, Random& random) {
  Vec2 place = Vec2::Zero();
  for (int attempt = 0; attempt < 200; ++attempt) {
    place = plan.middle(static_cast<int>(random.index(plan.clearance.size())));
    if (plan.at(place) >= clearance) break;
  }
  return place;
}

const Piece* table_at(const Room& room, const Piece& seat) { return seat.table >= 0 ? &room.pieces[static_cast<std::size_t>(seat.table)] : nullptr; }

/// Goes there and does it; false if there is no way.
bool perform(Motion& motion, const Visit& visit, const Room& room, const FloorPlan& plan, const Body& body, const Manner& manner, Random& random) {
  if (visit.errand == Errand::wander) {
    if (!walk_to(motion, plan, body, manner, {free_place(plan, 0.35, random), random.uniform(-kPi, kPi)})) return false;
    stand_about(motion, body, manner, random.uniform(1.5, 5.0), random);
    return true;
  }
  const Piece& piece = room.pieces[static_cast<std::size_t>(visit.piece)];
  if (visit.errand == Errand::sit || visit.errand == Errand::lie) {
    const SitPlan sitting = plan_sit(piece, body, random);
    if (!walk_to(motion, plan, body, manner, approach_to(piece, sitting.along, sitting.off, true))) return false;
    if (visit.errand == Errand::lie)
      lie(motion, body, manner, piece, sitting, random.uniform(2.0, 7.0), random);
    else
      sit(motion, body, manner, piece, table_at(room, piece), sitting, random.uniform(2.5, 10.0), random);
    return true;
  }
  const bool table = piece.object.superclass() == Superclass::table, leans = visit.errand == Errand::lean;
  const Piece side = table ? from_side(piece, static_cast<int>(random.index(4))) : piece;
  const double off = table ? random.uniform(0.2, 0.3) : piece.height < 1.2 ? random.uniform(0.28, 0.4) : random.uniform(0.30, 0.46);
  if (!walk_to(motion, plan, body, manner, approach_to(side, random.uniform(-1.0, 1.0) * side.room, off, false))) return false;
  if (leans && side.surface > 0.6)
    lean(motion, body, manner, side, random.uniform(1.0, 4.0), random);
  else
    reach(motion, body, manner, side, random);
  return true;
}

double depth_inside(const OrientedBox& box, const Vec3& p) { return (box.half_size - (box.axes.transpose() * (p - box.center)).cwiseAbs()).minCoeff(); }

/// Nobody's joints are in furniture, except for what sinks into the piece in use.
bool clear_of_furniture(const Room& room, const Pose& pose, const Moment& moment) {
  for (const Piece& piece : room.pieces) {
    const bool used = moment.touched[0] == piece.object.id;
    for (const Part& part : piece.object.parts)
      for (int j = 0; j < kJoints; ++j)
        if (depth_inside(part.box, pose.col(j)) > (used ? 0.08 : 0.05)) return false;
  }
  return true;
}

bool clear_of(const Pose& a, const Pose& b) {
  const Vec3 apart = a.col(pelvis) - b.col(pelvis);
  if (apart.norm() > 2.5) return true;
  if (apart.head<2>().norm() < 0.55) return false;
  for (int i = 0; i < kJoints; ++i)
    for (int j = 0; j < kJoints; ++j)
      if ((a.col(i) - b.col(j)).squaredNorm() < 0.16 * 0.16) return false;
  return true;
}

/// Checks the motion from `first` on, ten times a second.
bool possible(const Motion& motion, std::size_t first, const Room& room, const Body& body, const std::vector<std::pair<Body, Motion>>& others) {
  constexpr std::size_t kEvery = 6;
  for (std::size_t k = first / kEvery * kEvery; k < motion.size(); k += kEvery) {
    const Pose pose = pose_of(body, motion[k].posture);
    if (!clear_of_furniture(room, pose, motion[k])) return false;
    for (const auto& [other, theirs] : others)
      if (!clear_of(pose, pose_of(other, theirs[std::min(k, theirs.size() - 1)].posture))) return false;
  }
  return true;
}

void count_use(const Motion& motion, std::size_t first, std::vector<int>& used) {
  std::vector<int> now(used.size(), 0);
  for (std::size_t k = first; k < motion.size(); ++k)
    for (const int piece : motion[k].touched)
      if (piece >= 0) now[static_cast<std::size_t>(piece)] = 1;
  for (std::size_t i = 0; i < used.size(); ++i) used[i] += now[i];
}

}  // namespace

Motion live(const Room& room, const FloorPlan& plan, const Body& body, const std::vector<std::pair<Body, Motion>>& others, double seconds, bool still,
            Random& random) {
  Manner manner = draw_manner(random);
  const auto length = static_cast<std::size_t>(std::ceil(seconds * kRate)) + 1;
  // a start may turn out to be a dead end, e.g. where another person will come by; then another one is tried
  for (int attempt = 0; attempt < 60; ++attempt) {
    const Approach start{free_place(plan, 0.4, random), random.uniform(-kPi, kPi)};
    Motion motion = {{standing(body, start.at, start.heading), Action::stand, {-1, -1}}};
    std::vector<int> used(room.pieces.size(), 0);
    if (random.uniform() < 0.5) stand_about(motion, body, manner, random.uniform(0.5, 2.0), random);
    if (!possible(motion, 0, room, body, others)) continue;
    for (int tries = 0; tries < 40 && motion.size() < length;) {
      const std::size_t mark = motion.size();
      manner.carrying = random.uniform() < 0.15 ? static_cast<int>(random.index(2)) : -1;
      const bool done = perform(motion, draw_visit(room, used, still, random), room, plan, body, manner, random);
      if (done && possible(motion, mark, room, body, others)) {
        count_use(motion, mark, used);
        tries = 0;
        continue;
      }
      motion.resize(mark);
      if (++tries % 8 == 0) hold(motion, 1.0, manner, Action::stand);
      if (!possible(motion, mark, room, body, others)) break;
    }
    if (motion.size() >= length) return motion;
  }
  return {};
}

Moment at_time(const Motion& motion, double time) {
  const double at = std::clamp(time * kRate, 0.0, static_cast<double>(motion.size() - 1));
  const auto k = std::min(static_cast<std::size_t>(at), motion.size() - 1);
  Moment moment = motion[k];
  if (k + 1 < motion.size()) moment.posture = between(motion[k].posture, motion[k + 1].posture, at - static_cast<double>(k));
  return moment;
}

}  // namespace unseen::interactions
