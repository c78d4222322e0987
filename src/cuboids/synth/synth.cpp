// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/synth.h"

#include <algorithm>
#include <limits>

#include "cuboids/synth/synth_builder.h"
#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

/// Five azimuths: around the scene, or within the room before the wall. None looks along an axis of the boxes.
constexpr double kAround[] = {28, 62, 150, 212, 322}, kInFront[] = {-46, -24, 7, 26, 44};  // deg

constexpr int kMostBoxes[] = {8, 8, 56};
const std::vector<std::string> kCounted = {"tower", "twisted", "running-bond"};

void check(const SynthOptions& options) {
  check_options(options, "synth");
  const auto counted = std::find(kCounted.begin(), kCounted.end(), options.scene);
  if (options.boxes > 0 && counted == kCounted.end())
    throw InputError("synth", "boxes", std::to_string(options.boxes) + " of a " + options.scene,
                     "0, for this family has its own number");
  const int most = counted == kCounted.end() ? 0 : kMostBoxes[counted - kCounted.begin()];
  if (options.boxes > most)
    throw InputError("synth", "boxes", std::to_string(options.boxes), "at most " + std::to_string(most));
  if (options.removed > 0 && counted == kCounted.end() && options.scene != "desk")
    throw InputError("synth", "removed", std::to_string(options.removed) + " of a " + options.scene,
                     "0, for the rest of this family might not stand");
  if (options.removed > 4 && options.scene == "desk")
    throw InputError("synth", "removed", std::to_string(options.removed), "at most 4 of a desk");
}

SynthFrame build(const SynthOptions& options, SynthBuilder& builder) {
  Random random(static_cast<std::uint64_t>(options.seed) * 3);
  const std::string& scene = options.scene;
  if (scene == "tower") return build_tower(builder, options.boxes, random);
  if (scene == "twisted") return build_twisted(builder, options.boxes, random);
  if (scene == "running-bond") return build_running_bond(builder, options.boxes, random);
  if (scene == "bridge") return build_bridge(builder, true);
  if (scene == "leaning") return build_leaning(builder);
  if (scene == "cyclic") return build_cyclic(builder);
  if (scene == "bookshelf") return build_bookshelf(builder, random);
  if (scene == "desk") return build_desk(builder);
  if (scene == "chair-1") return build_four_legged_chair(builder);
  if (scene == "chair-2") return build_pedestal_chair(builder);
  if (scene == "table") return build_table(builder);
  if (scene == "shelf") return build_shelf(builder);
  if (scene == "jam") return build_jam(builder);
  return build_bridge(builder, false);
}

}  // namespace

const std::vector<std::string>& synth_families() {
  static const std::vector<std::string> kFamilies = {"tower",     "twisted", "running-bond", "bridge",  "leaning",
                                                     "cyclic",    "bookshelf", "desk",       "chair-1", "chair-2",
                                                     "table",     "shelf",   "jam",          "bridge-without"};
  return kFamilies;
}

OptionTable describe(SynthOptions& o) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  OptionTable table;
  // clang-format off
  table.add({"scene", &o.scene, "", "what is built; jam and bridge-without fall", -kInf, kInf, synth_families()});
  table.add({"boxes", &o.boxes, "", "how many (tower, twisted, running-bond); 0 = as the family has it", 0, 56, {}});
  table.add({"removed", &o.removed, "", "boxes taken away again, the last ones first (tower, twisted, running-bond, desk)", 0, 55, {}});
  table.add({"wall", &o.wall, "", "put a wall behind the scene", -kInf, kInf, {}});
  table.add({"view", &o.view, "", "only this one of the five views; -1 = all", -1, 4, {}});
  table.add({"azimuth", &o.azimuth, "deg", "one view from there instead; 0 = from the front", -360, 360, {}});
  table.add({"noise", &o.noise, "m", "standard deviation of the depth at 1 m; it grows with the square of the depth", 0, 0.1, {}});
  table.add({"dropout", &o.dropout, "1", "chance that a pixel at a depth edge has no depth", 0, 1, {}});
  table.add({"masks", &o.masks, "", "name the true masks in frame.json", -kInf, kInf, {}});
  table.add({"seed", &o.seed, "", "seed of everything random", 0, 2147483647, {}});
  // clang-format on
  return table;
}

SynthScene make_scene(const SynthOptions& options, Context& context) {
  check(options);
  SynthBuilder builder;
  const SynthFrame frame = build(options, builder);
  if (options.wall && !builder.has_wall()) builder.set_wall(builder.back() + 0.15);
  SynthModel model = builder.take();
  model.stands = frame.stands;
  model.camera_height = frame.camera_height;
  model.ground_margin = frame.ground_margin;
  const auto count = static_cast<int>(model.boxes.size());
  if (options.removed >= count)
    throw InputError("synth", "removed", std::to_string(options.removed), "less than all " + std::to_string(count));
  std::vector<bool> shown(model.boxes.size(), true);
  std::fill(shown.end() - options.removed, shown.end(), false);

  SynthScene scene;
  if (options.azimuth) {
    scene.views.push_back(photograph(model, shown, radians(*options.azimuth), options, context));
    scene.views.back().number = std::max(options.view, 0);
    return scene;
  }
  for (int v = 0; v < 5; ++v) {
    if (options.view >= 0 && v != options.view) continue;
    const double azimuth = builder.has_wall() ? kInFront[v] : kAround[v];
    scene.views.push_back(photograph(model, shown, radians(azimuth), options, context));
    scene.views.back().number = v;
  }
  return scene;
}

}  // namespace unseen::cuboids
