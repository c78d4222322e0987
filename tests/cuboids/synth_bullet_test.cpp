// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A second engine on the generated families: a label counts only where both agree.
#include <gtest/gtest.h>

#include <numeric>

#include "engines.h"
#include "unseen/cuboids/synth.h"

namespace unseen::test {
namespace {

RigidScene rigid_scene(const cuboids::Truth& truth) {
  RigidScene scene;
  scene.planes.clear();
  for (const cuboids::Support& support : truth.supports) scene.planes.push_back(support.plane);
  const int first = static_cast<int>(truth.supports.size());
  for (const cuboids::TrueCuboid& cuboid : truth.cuboids) scene.boxes.push_back({*cuboid.box, cuboid.density, cuboid.id, false});
  for (const cuboids::Contact& contact : truth.contacts) {
    if (contact.kind != cuboids::ContactKind::fixed) continue;
    if (contact.a < first) {
      scene.boxes[contact.b - first].is_static = true;
      continue;
    }
    const int from = scene.boxes[contact.b - first].group, to = scene.boxes[contact.a - first].group;
    for (RigidBox& box : scene.boxes)
      if (box.group == from) box.group = to;
  }
  return scene;
}

class SynthBullet : public testing::TestWithParam<std::string> {};

TEST_P(SynthBullet, StandsOrFallsAsItsTruthSays) {
  cuboids::SynthOptions options;
  options.scene = GetParam();
  options.view = 0;
  Context context;
  const cuboids::Truth truth = make_scene(options, context).views.front().truth;
  const double moved = settle_bullet(rigid_scene(truth)).largest_move;
  if (truth.stands)
    EXPECT_LT(moved, 0.05);
  else
    EXPECT_GT(moved, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Families, SynthBullet, testing::ValuesIn(cuboids::synth_families()), [](const auto& family) {
  std::string name = family.param;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace unseen::test
