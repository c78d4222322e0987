// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/positions.h"

#include <utility>

#include "collision/doubts/focal_doubt.h"
#include "collision/remarks.h"

namespace unseen::collision {
namespace {

/// All impacts by the bodies' positions.
std::vector<SolvedImpact> solve_all_positions(const Shot& shot, const Options& options, const ShotCamera& camera, const std::array<Solid, 2>& solids, Tracks& tracks,
                                              double fps, Context& context) {
  std::vector<SolvedImpact> impacts = solve_positions(shot, options, camera, solids, tracks, fps, context);
  share_gravity(impacts);
  share_floor(impacts);
  return impacts;
}

/// The same through a camera of the focal length that these impacts tell, where it was a guess and they tell it. False where nothing changes.
bool solve_with_told_camera(const Shot& shot, const Options& options, const std::array<Solid, 2>& solids, Evidence& evidence, std::vector<SolvedImpact>& impacts, Context& context) {
  constexpr int kRounds = 6;  // at a wrong focal length the noise seems large and the vertical is off
  double step = likelier_focal_length(impacts, 1.0, context);
  if (step == 1.0) return false;
  Context quiet = context;  // the last of these solutions is the one to speak of
  quiet.on_message = nullptr;
  quiet.on_progress = nullptr;
  ShotCamera camera = evidence.camera;
  Tracks tracks;
  std::vector<SolvedImpact> told;
  const auto solve_again = [&] {
    told = solve_all_positions(shot, options, camera, solids, tracks, evidence.fps, quiet);
    return told.size() >= impacts.size();
  };
  for (int round = 0; round < kRounds && step != 1.0; ++round) {
    camera.camera.fx *= step;
    camera.camera.fy *= step;
    tracks = evidence.tracks;
    if (!solve_again()) return false;
    step = likelier_focal_length(told, camera.camera.fx / evidence.camera.camera.fx, context);
  }
  tracks = follow(shot, evidence.footage, camera, evidence.fps, quiet);
  if (!solve_again()) return false;
  evidence.camera = camera;
  evidence.tracks = std::move(tracks);
  impacts = std::move(told);
  return true;
}

/// The same with two spheres exchanged that were taken for each other, as their sizes say once gravity tells how far away each is.
void exchange_by_size(const Shot& shot, const Options& options, const std::array<Solid, 2>& solids, Evidence& evidence, std::vector<SolvedImpact>& impacts, Context& context) {
  if (evidence.tracks.told_apart || impacts.empty() || !look_exchanged(impacts.front().solution)) return;
  Context quiet = context;
  quiet.on_message = nullptr;
  quiet.on_progress = nullptr;
  Tracks tracks = evidence.tracks;
  exchange_bodies(tracks);
  std::vector<SolvedImpact> exchanged = solve_all_positions(shot, options, evidence.camera, solids, tracks, evidence.fps, quiet);
  if (exchanged.size() < impacts.size() || look_exchanged(exchanged.front().solution)) return;
  evidence.tracks = std::move(tracks);
  impacts = std::move(exchanged);
}

}  // namespace

std::vector<SolvedImpact> explain_positions(const Shot& shot, const Options& options, const std::array<Solid, 2>& solids, Evidence& evidence, Context& context) {
  std::vector<SolvedImpact> impacts = solve_all_positions(shot, options, evidence.camera, solids, evidence.tracks, evidence.fps, context);
  const bool told = solve_with_told_camera(shot, options, solids, evidence, impacts, context);
  exchange_by_size(shot, options, solids, evidence, impacts, context);
  warn_of_camera(evidence.camera, told, context);
  return impacts;
}

}  // namespace unseen::collision
