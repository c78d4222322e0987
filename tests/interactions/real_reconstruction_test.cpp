// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <map>

#include "unseen/interactions/evaluate.h"
#include "unseen/interactions/interactions.h"
#include "unseen/report/interactions_recording.h"
#include "unseen/report/interactions_take.h"
#include "unseen/report/scenelets_file.h"

namespace unseen::report {
namespace {

namespace fs = std::filesystem;
using namespace interactions;

const fs::path kData = fs::path(UNSEEN_SOURCE_DIR) / "../shared/data/interactions";

struct Scene {
  const char *name, *room;
  std::vector<int> interacted;
};
const Scene kScenes[] = {{"Scene05", "lobby", {0}},
                         {"Scene07", "lobby", {0, 1, 2}},
                         {"Scene11", "living room", {0, 1, 2, 3, 4}},
                         {"Scene13", "library", {0, 2, 4, 5, 8, 9}}};

/// The shipped scenelets and those of the scenes in other rooms.
Database database_without(const std::string& room, const std::vector<Recording>& recordings) {
  std::vector<Recording> others;
  for (std::size_t s = 0; s < recordings.size(); ++s)
    if (kScenes[s].room != room) others.push_back(recordings[s]);
  Context context;
  return join({shipped_database(), build_database(others, {}, context)}, {}, context);
}

TEST(RealReconstructions, FindMostOfWhatIsUsed) {
  if (!fs::exists(kData / kScenes[0].name)) GTEST_SKIP() << "shared/data/interactions is not here";
  std::vector<Recording> recordings;
  for (const Scene& scene : kScenes) recordings.push_back(read_recording(kData / scene.name));
  int interacted = 0, found = 0, false_objects = 0, frames = 0;
  double local = 0;
  std::map<std::string, Database> databases;
  for (std::size_t s = 0; s < std::size(kScenes); ++s) {
    const std::string room = kScenes[s].room;
    if (!databases.contains(room)) databases[room] = database_without(room, recordings);
    const Take take = read_take(kData / kScenes[s].name / "take.json");
    Context context;
    const Reconstruction r = reconstruct({take}, databases[room], {}, context);
    Recording truth = recordings[s];
    truth.interacted = kScenes[s].interacted;
    const Evaluation e = evaluate(r, truth);
    std::cout << kScenes[s].name << ": found " << e.found << " of " << e.interacted << ", false " << e.false_objects << ", occluded joints "
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
