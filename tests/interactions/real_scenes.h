// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <vector>

namespace unseen::interactions::test {

inline const std::filesystem::path kRealScenesFolder = std::filesystem::path(UNSEEN_SOURCE_DIR) / "../shared/data/interactions";

struct RealScene {
  const char *name, *room;
  std::vector<int> interacted;  // ids of the objects that are used
};
inline const RealScene kRealScenes[] = {{"Scene05", "lobby", {0}},
                                        {"Scene07", "lobby", {0, 1, 2}},
                                        {"Scene11", "living room", {0, 1, 2, 3, 4}},
                                        {"Scene13", "library", {0, 2, 4, 5, 8, 9}}};

inline bool has_real_scenes() { return std::filesystem::exists(kRealScenesFolder / kRealScenes[0].name); }

}  // namespace unseen::interactions::test
