// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What the completion makes of boxes that were fitted badly, and of wrong densities (thesis Section 4.4.1, Table 4.2):
// cuboids_robustness > bench/results/cuboids_robustness.csv
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "cuboids/statics/interface.h"
#include "cuboids/synth_frame.h"
#include "unseen/core/random.h"
#include "unseen/cuboids/cuboids.h"
#include "unseen/cuboids/evaluate.h"

namespace unseen::cuboids {
namespace {

constexpr int kTurns = 10, kDensities = 4;  // runs a view
constexpr int kTries = 20;  // a box
constexpr double kSize = 0.05;         // share by which each side is wrong, at most
constexpr double kClearOverlap = 0.01; // m
constexpr double kWrongDensities = 0.2;  // of the boxes

double overlap(const OrientedBox& a, const OrientedBox& b) {
  const auto meet = interface_of(solid_of(a), solid_of(b), 0.0);
  return meet ? std::max(0.0, -meet->gap) : 0.0;
}

/// Whether a box that took the place of box i cuts into others deeper than that one did.
bool intersects(const std::vector<Cuboid>& cuboids, std::size_t i, const OrientedBox& box) {
  for (std::size_t j = 0; j < cuboids.size(); ++j)
    if (j != i && overlap(box, cuboids[j].initial) > std::max(kClearOverlap, overlap(cuboids[i].initial, cuboids[j].initial))) return true;
  return false;
}

/// Each box turned about its centre by up to `angle` (rad), about up or about any axis, its sides up to 5 % longer or
/// shorter.
std::vector<Cuboid> perturbed(std::vector<Cuboid> cuboids, double angle, bool about_up, Random& random) {
  for (std::size_t i = 0; i < cuboids.size(); ++i)
    for (int t = 0; t < kTries; ++t) {
      OrientedBox box = cuboids[i].initial;
      box.axes = Eigen::AngleAxisd(random.uniform(-angle, angle), about_up ? Vec3(Vec3::UnitZ()) : random.direction()).toRotationMatrix() * box.axes;
      for (int k = 0; k < 3; ++k) box.half_size[k] *= random.uniform(1.0 - kSize, 1.0 + kSize);
      if (intersects(cuboids, i, box)) continue;
      cuboids[i].initial = cuboids[i].box = box;
      break;
    }
  return cuboids;
}

/// A fifth of the boxes, at least one, gets a density that is wrong by up to `factor` either way.
std::vector<Cuboid> misjudged(std::vector<Cuboid> cuboids, double factor, Random& random) {
  const std::size_t wrong = std::max<std::size_t>(1, static_cast<std::size_t>(kWrongDensities * static_cast<double>(cuboids.size())));
  for (std::size_t n = 0; n < wrong; ++n)
    cuboids[random.index(cuboids.size())].density *= std::pow(factor, random.uniform(-1.0, 1.0));
  return cuboids;
}

struct Score {
  double before = 0, after = 0;  ///< mean F1, %
  int runs = 0;
};

/// Runs a view, or all (−1), with boxes that `change` has changed.
template <typename Change>
Score score_of(const std::string& family, int view_number, int runs, const Change& change) {
  SynthOptions synth;
  synth.scene = family;
  synth.view = view_number;
  Context context;
  Score score;
  Random random(1);
  EvaluateOptions evaluation;
  evaluation.referee = false;
  Options options;
  options.image_edges = false;
  for (const SynthView& view : make_scene(synth, context).views) {
    const RgbdFrame frame = frame_of(view);
    const Completion fitted = complete_cuboids(frame, options, context);
    for (int run = 0; run < runs; ++run) {
      Completion start = fitted;
      std::erase_if(start.cuboids, [](const Cuboid& c) { return c.by_symmetry; });
      start.cuboids = change(start.cuboids, random);
      const Evaluation e = evaluate(complete_cuboids(frame, start, options, context), view.truth, evaluation, context);
      score.before += 100.0 * e.contacts_before.f1;
      score.after += 100.0 * e.contacts_after.f1;
      ++score.runs;
    }
  }
  score.before /= score.runs;
  score.after /= score.runs;
  return score;
}

void print(const std::string& what, double amount, const std::string& family, const std::string& view, const Score& score) {
  fmt::print("{},{},{},{},{},{:.1f},{:.1f}\n", what, amount, family, view, score.runs, score.before, score.after);
  std::fflush(stdout);
}

}  // namespace
}  // namespace unseen::cuboids

int main() {
  using namespace unseen::cuboids;
  fmt::print("what,amount,family,view,runs,f1_initial,f1\n");
  for (const bool about_up : {true, false})
    for (const char* family : {"chair-1", "chair-2"})
      for (int view = 0; view < 5; ++view)
        for (const double degrees : {0.0, 5.0, 10.0, 15.0})
          print(about_up ? "turn_about_up_deg" : "turn_about_any_deg", degrees, family, std::to_string(view),
                score_of(family, view, kTurns, [&](const std::vector<Cuboid>& c, unseen::Random& random) {
                  return degrees > 0.0 ? perturbed(c, unseen::radians(degrees), about_up, random) : c;
                }));
  for (const std::string& family : synth_families())
    for (const double factor : {1.0, 2.0, 3.0, 5.0, 7.0})
      print("density_factor", factor, family, "all", score_of(family, -1, kDensities, [&](const std::vector<Cuboid>& c, unseen::Random& random) {
              return misjudged(c, factor, random);
            }));
}
