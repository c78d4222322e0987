// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/synth.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "interactions/synth/synth_person.h"
#include "interactions/synth/synth_sight.h"

namespace unseen::interactions {
namespace {

using Cast = std::vector<std::pair<Body, Motion>>;

/// People one after the other, each among those before; fewer if there is no room for more.
Cast draw_cast(const Room& room, const SynthOptions& options, Random& random) {
  const FloorPlan plan = plan_floor(room);
  Cast cast;
  for (int i = 0; i < options.people; ++i) {
    const Body body = draw_body(random);
    Motion motion = live(room, plan, body, cast, options.seconds, options.still, random);
    if (motion.empty()) break;
    cast.emplace_back(body, std::move(motion));
  }
  return cast;
}

/// Does the body rest on the object, or has it a hand there? Who is about to sit down has not touched the seat yet. The hips of tall people are
/// 0.13 m above what they sit on.
bool touches(const Pose& pose, const Object& object) {
  constexpr std::array<std::pair<Joint, double>, 3> kNear = {{{pelvis, 0.15}, {right_wrist, 0.12}, {left_wrist, 0.12}}};  // m
  for (const Part& part : object.parts)
    for (const auto& [joint, near] : kNear) {
      const Vec3 outside = (part.box.axes.transpose() * (pose.col(joint) - part.box.center)).cwiseAbs() - part.box.half_size;
      if (outside.cwiseMax(0.0).norm() < near) return true;
    }
  return false;
}

/// Poses at the frames, and which pieces are touched in them.
void record(Recording& truth, const Cast& cast, const View& view, int frames, const Context& context) {
  std::set<int> touched;
  truth.people.resize(cast.size());
  for (int f = 0; f < frames; ++f) {
    context.progress(static_cast<double>(f) / frames);
    std::vector<Figure> figures;
    std::vector<Action> actions;
    for (const auto& [body, motion] : cast) {
      const Moment moment = at_time(motion, f / truth.fps);
      figures.push_back({pose_of(body, moment.posture), body.trunk_radius, body.limb_radius});
      actions.push_back(moment.action);
      for (const int id : moment.touched)
        if (id >= 0 && touches(figures.back().pose, truth.objects[static_cast<std::size_t>(id)])) touched.insert(id);
    }
    for (std::size_t p = 0; p < figures.size(); ++p)
      truth.people[p].push_back({f, figures[p].pose, hidden_joints(view.T_world_camera.translation, figures, p, truth.objects), actions[p], true});
  }
  truth.interacted.assign(touched.begin(), touched.end());
  truth.uses_known = true;
}

/// A detector does not know who is who: people come in any order.
std::vector<Detection> by_frame(std::vector<std::vector<Detection>> people, Random& random) {
  std::vector<Detection> all;
  for (auto& detections : people) all.insert(all.end(), detections.begin(), detections.end());
  for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random.index(i)]);
  std::stable_sort(all.begin(), all.end(), [](const Detection& a, const Detection& b) { return a.frame < b.frame; });
  return all;
}

}  // namespace

OptionTable describe(SynthOptions& o) {
  OptionTable t;
  t.add({"people", &o.people, "", "how many people there are", 1, 4, {}});
  t.add({"objects", &o.objects, "", "pieces of furniture", 2, 6, {}});
  t.add({"seconds", &o.seconds, "s", "length", 1, 600, {}});
  t.add({"fps", &o.fps, "1/s", "frames a second", 1, 60, {}});
  t.add({"noise", &o.noise, "px", "standard deviation of the joints that are seen", 0, 100, {}});
  t.add({"width", &o.width, "px", "of the picture", 64, 8192, {}});
  t.add({"height", &o.height, "px", "of the picture", 64, 8192, {}});
  t.add({"still", &o.still, "", "nobody touches anything", 0, 1, {}});
  t.add({"lifted", &o.lifted, "", "3D poses come with the detections, as a lifting network gives them", 0, 1, {}});
  t.add({"seed", &o.seed, "", "of all random choices", 0, 2147483647, {}});
  return t;
}

SynthTake simulate(const SynthOptions& options, const Context& context) {
  check_options(options, "synth");
  Random random(static_cast<std::uint64_t>(options.seed));
  const View view = draw_view(options.width, options.height, random);
  Room room;
  Cast cast;
  for (int attempt = 0; attempt < 20 && static_cast<int>(cast.size()) < options.people; ++attempt) {
    room = draw_room(view, options.objects, random);
    cast = draw_cast(room, options, random);
  }

  SynthTake synth;
  Recording& truth = synth.truth;
  truth.name = fmt::format("synth-{}", options.seed);
  truth.room = truth.name;
  truth.licence = "MIT";
  truth.fps = options.fps;
  truth.T_world_camera = view.T_world_camera;
  for (const Piece& piece : room.pieces) truth.objects.push_back(piece.object);
  record(truth, cast, view, std::max(1, static_cast<int>(std::lround(options.seconds * options.fps))), context);

  Take& take = synth.take;
  take.name = truth.name;
  take.camera = view.camera;
  take.fps = options.fps;
  take.people = static_cast<int>(truth.people.size());
  std::vector<std::vector<Detection>> detections;
  for (const auto& frames : truth.people) detections.push_back(detect(view, frames, {options.noise, options.fps, options.lifted}, random));
  take.detections = by_frame(std::move(detections), random);
  return synth;
}

}  // namespace unseen::interactions
