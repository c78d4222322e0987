// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/interactions.h"

#include "interactions/ground.h"
#include "interactions/ground_fit.h"
#include "interactions/motion.h"
#include "interactions/use.h"
#include "interactions/votes.h"

namespace unseen::interactions {
namespace {
std::vector<std::vector<bool>> used_everywhere(const Database& database) {
  std::vector<std::vector<bool>> used;
  for (const Scenelet& scenelet : database.scenelets) used.push_back(used_objects(scenelet));
  return used;
}
}  // namespace

Reconstruction reconstruct(const std::vector<Take>& takes, const Database& database, const Options& options, Context& context) {
  Reconstruction r;
  const Take& take = takes.front();
  std::vector<int> persons;
  for (const Detection& d : take.detections) persons.push_back(std::max(0, d.person));
  const GroundStart start = find_ground(take, context);
  r.ground = fit_ground(take, persons, database, start, context);
  const View view = view_of(take.camera, r.ground);
  r.T_world_camera = view.T_world_camera;
  r.camera = take.camera;
  r.fps = take.fps;
  const auto used = used_everywhere(database);
  std::vector<Vote> votes;
  for (int person = 0; person < take.people; ++person) {
    const std::vector<Sight> sights = sights_of(take, persons, person, view);
    const std::vector<Reading> readings = read_motion(sights, database, view, take.fps, options.occlusion, context);
    const Path path = find_path(readings, database, view, take.fps, sights.front().frame, sights.back().frame, options.smoothness);
    for (Vote& vote : votes_of(person, readings, path, database, used, 0.2)) votes.push_back(std::move(vote));
    std::vector<Choice> windows = find_windows(readings, database, take.fps, options.saliency);
    choose_scenelets(windows, readings, database, path, take.fps, options.smoothness);
    r.people.push_back({person, find_motion(sights, readings, windows, database, path, view, take.fps), {}});
  }
  r.objects = gather_objects(votes, view).objects;
  return r;
}

}  // namespace unseen::interactions
