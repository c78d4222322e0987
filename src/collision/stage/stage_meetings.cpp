// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "collision/solve/touching.h"
#include "collision/stage/stage_world.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

constexpr double kTurnStep = 20.0;   // deg: a collision is turned by that much at a time until nothing is in its way
constexpr double kSlowest = 0.05;    // m/s
constexpr double kFramesAfter = 2.0;  // simulated beyond a meeting

/// Where a body is at `time`, flown on from the last frame before it.
StageState state_at(const Cast& cast, const StageRun& run, int actor, double time) {
  const CastActor& a = cast.actors[static_cast<std::size_t>(actor)];
  const StagedFrame* last = &run.frames.front();
  for (const StagedFrame& f : run.frames)
    if (f.time <= time) last = &f;
  const BodyState& s = last->bodies[static_cast<std::size_t>(actor)];
  return flown(a, {last->time, s.p, s.v, s.k / a.actor.mass, s.q * a.solid.file_to_principal.conjugate()}, cast.gravity, time);
}

class Arrangement {
 public:
  Arrangement(Cast& cast, const StagePlan& plan, Context& context) : cast_(cast), plan_(plan), context_(context) {}

  void arrange(std::size_t m) {
    const StagedMeeting& meeting = plan_.meetings[m];
    std::array<int, 2> who = {actor_of(cast_, meeting.bodies[0]), actor_of(cast_, meeting.bodies[1])};
    check(m, who);
    if (placed_.contains(collision(who[1]))) std::swap(who[0], who[1]);
    if (placed_.contains(collision(who[1]))) fail(m, "two collisions that earlier meetings hold in their places", "one that can be moved");
    placed_.insert(collision(who[0]));
    placed_.insert(collision(who[1]));
    CastPair pair = material(meeting, who);
    pair.meeting = static_cast<int>(m);
    cast_.pairs.push_back(pair);
    const double turn = plan_.collisions[static_cast<std::size_t>(collision(who[1]))].turn;
    std::string obstacle;
    for (int i = 0; i * kTurnStep <= 180.0; ++i)
      for (const double sign : {1.0, -1.0}) {
        if ((i == 0 || i * kTurnStep == 180.0) && sign < 0) continue;
        if (meets(who, meeting.time, turn + sign * radians(i * kTurnStep), obstacle)) return;
      }
    fail(m, fmt::format("no place for {}: {}", plan_.collisions[static_cast<std::size_t>(collision(who[1]))].name, obstacle), "another time, or other bodies");
  }

 private:
  int collision(int actor) const { return cast_.actors[static_cast<std::size_t>(actor)].collision; }

  [[noreturn]] void fail(std::size_t m, const std::string& found, const std::string& expected) const {
    throw InputError(plan_.name, fmt::format("meet[{}]", m), found, expected);
  }

  void check(std::size_t m, const std::array<int, 2>& who) const {
    if (who[0] < 0 || who[1] < 0) fail(m, "a body that is fixed", "bodies that move");
    if (collision(who[0]) == collision(who[1])) fail(m, "two bodies of one collision", "bodies of different collisions");
    const double time = plan_.meetings[m].time;
    for (const int i : who) {
      const StagedCollision& own = plan_.collisions[static_cast<std::size_t>(collision(i))];
      if (time <= own.time) fail(m, fmt::format("{} s", time), fmt::format("a time after the impact of {} at {} s", own.name, own.time));
    }
    if (time >= plan_.duration) fail(m, fmt::format("{} s", time), fmt::format("a time before the shot's end at {} s", plan_.duration));
  }

  CastPair material(const StagedMeeting& meeting, const std::array<int, 2>& who) const {
    const Actor &a = cast_.actors[static_cast<std::size_t>(who[0])].actor, &b = cast_.actors[static_cast<std::size_t>(who[1])].actor;
    return {who[0], who[1], meeting.restitution.value_or(a.restitution * b.restitution), a.friction * b.friction, meeting.time, -1, Vec3::Zero()};
  }

  /// Puts the second's collision, turned, to where its body flies straight into the first; true if that happens.
  bool meets(const std::array<int, 2>& who, double time, double turn, std::string& obstacle) {
    const int moved = collision(who[1]);
    const Vec3 aside(0, 0, 1e4);  // while both are simulated for themselves
    place(cast_, plan_, moved, aside, turn);
    const StageRun alone = simulate(cast_, plan_.fps, time, context_);
    const StageState a = state_at(cast_, alone, who[0], time), b = state_at(cast_, alone, who[1], time);
    const Vec3 relative = a.v - b.v;
    if (relative.norm() < kSlowest) {
      obstacle = "the bodies fly side by side";
      return false;
    }
    const Vec3 direction = relative.normalized();
    const Solid &first = cast_.actors[static_cast<std::size_t>(who[0])].solid, &second = cast_.actors[static_cast<std::size_t>(who[1])].solid;
    const std::optional<Touching> touching = Touchings(first, a.q, second, b.q).along(-direction);
    if (!touching) {
      obstacle = "the bodies cannot touch so";
      return false;
    }
    place(cast_, plan_, moved, aside + a.p - touching->offset - b.p, turn);
    const auto failures = missed(cast_, simulate(cast_, plan_.fps, std::min(plan_.duration, time + kFramesAfter / plan_.fps), context_).impacts, 1.0 / plan_.fps, time);
    if (failures.empty()) return true;
    obstacle = failures.front();
    return false;
  }

  Cast& cast_;
  const StagePlan& plan_;
  Context& context_;
  std::set<int> placed_;
};

}  // namespace

void arrange_meetings(Cast& cast, const StagePlan& plan, Context& context) {
  Arrangement arrangement(cast, plan, context);
  for (std::size_t m = 0; m < plan.meetings.size(); ++m) arrangement.arrange(m);
}

std::vector<std::string> missed(const Cast& cast, const std::vector<StagedImpact>& impacts, double tolerance, double until) {
  std::vector<std::string> lines;
  for (const CastPair& wanted : cast.pairs) {
    if (wanted.time > until) continue;
    const auto of_pair = [&](const StagedImpact& i) { return std::minmax(i.between[0], i.between[1]) == std::minmax(wanted.a, wanted.b); };
    const auto touches = [&](const StagedImpact& i) {
      return i.between[0] == wanted.a || i.between[0] == wanted.b || i.between[1] == wanted.a || (wanted.b >= 0 && i.between[1] == wanted.b);
    };
    const bool happens = std::any_of(impacts.begin(), impacts.end(), [&](const StagedImpact& i) { return of_pair(i) && std::abs(i.time - wanted.time) <= tolerance; });
    if (happens) continue;
    std::string line = fmt::format("{} do not collide at {:.3f} s", pair_name(cast, wanted.a, wanted.b), wanted.time);
    for (const StagedImpact& i : impacts)
      if (i.time < wanted.time + tolerance && touches(i)) line += fmt::format("; {} do at {:.3f} s", pair_name(cast, i.between[0], i.between[1]), i.time);
    lines.push_back(line);
  }
  return lines;
}

}  // namespace unseen::collision
