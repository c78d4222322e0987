// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <iostream>
#include <map>

#include "interactions/real_scenes.h"
#include "unseen/interactions/evaluate.h"
#include "unseen/interactions/interactions.h"
#include "unseen/report/interactions_recording.h"
#include "unseen/report/interactions_take.h"
#include "unseen/report/scenelets_file.h"

namespace unseen::report {
namespace {

using namespace interactions;
using interactions::test::has_real_scenes, interactions::test::kRealScenes, interactions::test::kRealScenesFolder, interactions::test::RealScene;

/// The shipped scenelets and those of the scenes in other rooms.
Database database_without(const std::string& room, const std::vector<Recording>& recordings) {
  std::vector<Recording> others;
  for (std::size_t s = 0; s < recordings.size(); ++s)
    if (kRealScenes[s].room != room) others.push_back(recordings[s]);
  Context context;
  return join({shipped_database(), build_database(others, {}, context)}, {}, context);
}

TEST(RealReconstructions, FindMostOfWhatIsUsed) {
  if (!has_real_scenes()) GTEST_SKIP() << "shared/data/interactions is not here";
  std::vector<Recording> recordings;
  for (const RealScene& scene : kRealScenes) recordings.push_back(read_recording(kRealScenesFolder / scene.name));
  int interacted = 0, found = 0, false_objects = 0, frames = 0;
  double local = 0;
  std::map<std::string, Database> databases;
  for (std::size_t s = 0; s < std::size(kRealScenes); ++s) {
    const std::string room = kRealScenes[s].room;
    if (!databases.contains(room)) databases[room] = database_without(room, recordings);
    const Take take = read_take(kRealScenesFolder / kRealScenes[s].name / "take.json");
    Context context;
    const Reconstruction r = reconstruct({take}, databases[room], {}, context);
    Recording truth = recordings[s];
    truth.interacted = kRealScenes[s].interacted;
    const Evaluation e = evaluate(r, truth);
    std::cout << kRealScenes[s].name << ": found " << e.found << " of " << e.interacted << ", false " << e.false_objects << ", occluded joints "
              << 100 * e.occluded->local << " cm\n";
    interacted += e.interacted, found += e.found, false_objects += e.false_objects;
    frames += e.occluded->frames, local += e.occluded->local * e.occluded->frames;
  }
  EXPECT_EQ(interacted, 15);
  EXPECT_GE(found, 13);
  EXPECT_LE(false_objects, 6);
  EXPECT_LE(100 * local / frames, 16.5) << "cm";
}

}  // namespace
}  // namespace unseen::report
