// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// From frame to contact graph: what is the same scene, mirrored or in other units, gets the same decisions.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cuboids/surfaces/depth_noise.h"
#include "synth_frame.h"
#include "unseen/cuboids/cuboids.h"

namespace unseen::cuboids {
namespace {

RgbdFrame mirrored(RgbdFrame frame) {
  const auto flip = [&](auto& image) {
    for (int row = 0; row < frame.camera.height; ++row)
      std::reverse(image.begin() + row * frame.camera.width, image.begin() + (row + 1) * frame.camera.width);
  };
  flip(frame.depth);
  flip(frame.masks);
  flip(frame.color);
  frame.camera.cx = frame.camera.width - 1 - frame.camera.cx;
  return frame;
}

RgbdFrame scaled(RgbdFrame frame, double factor) {
  for (float& d : frame.depth) d *= static_cast<float>(factor);
  return frame;
}

using Graph = std::set<std::tuple<std::string, std::string, ContactKind>>;

/// Contacts between masks, and whether all of it stands.
std::pair<Graph, bool> decisions(const RgbdFrame& frame, const Options& options) {
  Context context;
  const Completion result = complete_cuboids(frame, options, context);
  const auto name = [&](int id) {
    const auto is_it = [&](const auto& body) { return body.id == id; };
    const auto cuboid = std::find_if(result.cuboids.begin(), result.cuboids.end(), is_it);
    return cuboid == result.cuboids.end() ? "support " + std::to_string(id) : cuboid->label + (cuboid->by_symmetry ? "'" : "");
  };
  Graph graph;
  for (const Contact& c : result.contacts) {
    const std::string a = name(c.a), b = name(c.b);
    graph.insert({std::min(a, b), std::max(a, b), c.kind});
  }
  return {graph, result.stability.stable && result.unsupported.empty()};
}

class Invariance : public testing::TestWithParam<const char*> {};

TEST_P(Invariance, OfTheContactGraph) {
  const RgbdFrame frame = frame_of(view_of(GetParam(), 1));
  const auto usual = decisions(frame, {});
  EXPECT_FALSE(usual.first.empty());
  EXPECT_EQ(decisions(mirrored(frame), {}), usual) << "mirrored";
  for (const double factor : {0.8, 1.25}) {
    Options scaled_noise;
    scaled_noise.noise = depth_noise(frame, {}) / factor;  // σ = noise · z² scales like z
    EXPECT_EQ(decisions(scaled(frame, factor), scaled_noise), usual) << factor;
  }
}
INSTANTIATE_TEST_SUITE_P(Families, Invariance, testing::Values("tower", "twisted", "bridge", "cyclic", "shelf", "chair-2"));

}  // namespace
}  // namespace unseen::cuboids
