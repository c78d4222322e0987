// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "interactions/database/cut.h"
#include "interactions/database/footprint.h"
#include "interactions/database/saliency.h"
#include "unseen/core/error.h"

namespace unseen::interactions {
namespace {

/// Distance on the ground of the pelvis' path to what an object covers. m
double path_distance(const std::vector<Pose>& poses, const std::vector<Polygon>& pieces) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vec2 from = poses[i].col(pelvis).head<2>(), to = poses[std::min(i + 1, poses.size() - 1)].col(pelvis).head<2>();
    for (const Polygon& piece : pieces) least = std::min(least, distance(from, to, piece));
  }
  return least;
}

Scenelet scenelet_of(const Recording& recording, const std::vector<std::vector<Polygon>>& footprints, const Track& track, const Clip& clip, double reach) {
  Scenelet s;
  s.center = track.first_frame + clip.middle;
  s.fps = recording.fps;
  s.middle = clip.middle - clip.first;
  s.poses.assign(track.poses.begin() + clip.first, track.poses.begin() + clip.last + 1);
  s.valid.assign(track.valid.begin() + clip.first, track.valid.begin() + clip.last + 1);
  s.actions.assign(track.actions.begin() + clip.first, track.actions.begin() + clip.last + 1);
  s.origin = frame_of(track.poses[static_cast<std::size_t>(clip.middle)]);
  const Placement to_local = s.origin.inverse();
  for (std::size_t i = 0; i < recording.objects.size(); ++i)
    if (path_distance(s.poses, footprints[i]) <= reach) s.objects.push_back(to_local * recording.objects[i]);
  for (Pose& pose : s.poses) pose = to_local * pose;
  s.layout = layout_descriptor(s.objects);
  return s;
}

void check(const Recording& recording) {
  if (!(recording.fps > 0) || recording.fps > 1000) throw InputError(recording.name, "fps", fmt::format("{}", recording.fps), "above 0, at most 1000");
  for (const Object& object : recording.objects)
    for (const Part& part : object.parts)
      if (!RigidTransform{part.box.axes, part.box.center}.is_rigid() || !(part.box.half_size.minCoeff() >= 0) || !(part.box.half_size.maxCoeff() <= kFarthest) ||
          !(part.box.center.norm() <= kFarthest))
        throw InputError(recording.name, fmt::format("object {}, {}", object.id, part.name), "not a box", "one in metres, within 1 km, its axes at right angles");
}

bool same(const Scenelet& a, const Scenelet& b) {
  return a.person == b.person && a.center == b.center && a.origin.position == b.origin.position && a.origin.angle == b.origin.angle;
}

std::vector<const Scenelet*> of_recording(const Database& database, int recording) {
  std::vector<const Scenelet*> members;
  for (const Scenelet& s : database.scenelets)
    if (s.recording == recording) members.push_back(&s);
  return members;
}

/// Whether `database` has this recording of another one already: same names, same scenelets.
bool has(const Database& database, const Source& source, const std::vector<const Scenelet*>& scenelets) {
  for (std::size_t i = 0; i < database.recordings.size(); ++i) {
    const Source& known = database.recordings[i];
    if (known.name != source.name || known.room != source.room) continue;
    const std::vector<const Scenelet*> mine = of_recording(database, static_cast<int>(i));
    if (std::equal(mine.begin(), mine.end(), scenelets.begin(), scenelets.end(), [](auto* a, auto* b) { return same(*a, *b); })) return true;
  }
  return false;
}

}  // namespace

Database build_database(const std::vector<Recording>& recordings, const SceneletOptions& options, Context& context) {
  check_options(options, "scenelets");
  Database database;
  for (const Recording& recording : recordings) {
    context.progress(static_cast<double>(database.recordings.size()) / static_cast<double>(recordings.size()));
    check(recording);
    std::vector<std::vector<Polygon>> footprints;
    for (const Object& object : recording.objects) footprints.push_back(footprint(object));
    for (std::size_t person = 0; person < recording.people.size(); ++person)
      for (const Track& track : tracks_of(recording.people[person], recording.fps, recording.name))
        for (const Clip& clip : cut(track, recording.fps, options)) {
          Scenelet& s = database.scenelets.emplace_back(scenelet_of(recording, footprints, track, clip, options.reach));
          s.recording = static_cast<int>(database.recordings.size());
          s.person = static_cast<int>(person);
        }
    database.recordings.push_back({recording.name, recording.room, recording.licence});
  }
  database.scenelets = with_saliency(std::move(database.scenelets), options.motion_sigma, context);
  return database;
}

Database join(const std::vector<Database>& databases, const SceneletOptions& options, const Context& context) {
  check_options(options, "scenelets");
  Database all;
  for (const Database& database : databases)
    for (std::size_t i = 0; i < database.recordings.size(); ++i) {
      const std::vector<const Scenelet*> members = of_recording(database, static_cast<int>(i));
      if (has(all, database.recordings[i], members)) continue;
      for (const Scenelet* s : members) {
        all.scenelets.push_back(*s);
        all.scenelets.back().recording = static_cast<int>(all.recordings.size());
      }
      all.recordings.push_back(database.recordings[i]);
    }
  all.scenelets = with_saliency(std::move(all.scenelets), options.motion_sigma, context);
  return all;
}

}  // namespace unseen::interactions
