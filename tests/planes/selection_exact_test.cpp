// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "planes/scenes.h"
#include "planes/selection_problems.h"
#include "unseen/core/error.h"
#include "unseen/planes/synth.h"

namespace unseen::planes {
namespace {

void expect_near_optimum(const SelectionProblem& p, const std::string& what, double seconds) {
  const Labels local = solve_local(p, test::kContext);
  const double energy = energy_of(p, local).total();
  EXPECT_NEAR(energy, test::energy_by_definition(p, local), 1e-9) << what;
  const double bound = lower_bound(p, energy, test::kContext);
  EXPECT_LE(bound, energy + 1e-9) << what;
  const ExactSolution exact = solve_exact(p, local, seconds, test::kContext);
  const double optimum = energy_of(p, exact.labels).total();
  EXPECT_LE(optimum, energy + 1e-9) << what;
  EXPECT_LE(bound, optimum + 1e-6) << what;
  EXPECT_LE(exact.bound, optimum + 1e-6) << what;
  EXPECT_LE(energy, 1.01 * optimum + 1e-9) << what << (exact.proven ? "" : " (CBC did not finish)");
  EXPECT_TRUE(exact.proven) << what;
}

TEST(SolveExact, FindsTheOptimumFromAPoorStart) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SelectionProblem p = test::random_problem(5, 3, 0.5, static_cast<int>(seed % 2), seed);
    if (seed > 2) {  // so much that its cost bends, and yet several frames are worth it
      p.irregularity.transform([](double x) { return 20 * x; });
      p.data.transform([](double x) { return 30 * x; });
    }
    Labels start;
    for (int j = 0; j < p.patches(); ++j) start.push_back(p.frames() - p.patches() + j);
    const ExactSolution exact = solve_exact(p, start, 20, test::kContext);
    ASSERT_TRUE(exact.proven);
    EXPECT_NEAR(energy_of(p, exact.labels).total(), exact.bound, 1e-5);
    double best = std::numeric_limits<double>::infinity();
    Labels labels(p.patches(), 0);
    for (int code = 0; code < std::pow(p.frames(), p.patches()); ++code) {
      bool possible = true;
      for (int j = 0, rest = code; j < p.patches(); ++j, rest /= p.frames()) {
        labels[j] = rest % p.frames();
        possible = possible && std::isfinite(p.data(j, labels[j]));
      }
      if (possible) best = std::min(best, test::energy_by_definition(p, labels));
    }
    EXPECT_NEAR(energy_of(p, exact.labels).total(), best, 1e-5);
  }
}

/// A problem that takes CBC minutes; without an ear for the stop, the search would last as long as its time limit.
TEST(SolveExact, EndsWhenItIsStopped) {
  const SelectionProblem p = test::random_problem(60, 12, 0.5, 0, 1);
  std::stop_source stop;
  Context context;
  context.stop = stop.get_token();
  std::jthread impatient([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    stop.request_stop();
  });
  Labels start;
  for (int j = 0; j < p.patches(); ++j) start.push_back(p.frames() - p.patches() + j);
  EXPECT_THROW(solve_exact(p, start, 60, context), Cancelled);
}

TEST(SolveLocal, IsWithinOnePercentOfCbcOnRandomProblems) {
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    expect_near_optimum(test::random_problem(8 + static_cast<int>(seed), 4 + static_cast<int>(seed % 3),
                                             0.3 + 0.1 * static_cast<double>(seed % 5),
                                             static_cast<int>(seed % 4 == 0), seed),
                        "seed " + std::to_string(seed), 20);
}

struct Realistic {
  std::string name, scene;
  double scale, noise, turn, share;
};

class RealisticProblems : public testing::TestWithParam<Realistic> {};
INSTANTIATE_TEST_SUITE_P(Scenes, RealisticProblems,
                         testing::Values(Realistic{"room", "room", 0.08, 0.005, 12, 0.1},
                                         Realistic{"slight_turn", "room", 0.08, 0.01, 3, 0.1},
                                         Realistic{"lhouse", "lhouse", 0.15, 0.02, 0, 0.0}),
                         [](const auto& info) { return info.param.name; });

TEST_P(RealisticProblems, AreSolvedWithinOnePercentOfCbc) {
  SynthOptions synth;
  synth.scene = GetParam().scene;
  synth.points = 30'000;
  synth.noise = GetParam().noise;
  synth.turn = GetParam().turn;
  if (GetParam().share > 0) synth.share = GetParam().share;
  Context context;
  const SynthScene scene = make_scene(synth, context);
  VoxelGrid grid = test::grid_of(scene.cloud, 0.5 * GetParam().scale);
  const Cells cells = estimate_normals(grid, {}, context);
  const Patches patches = segment(grid, cells, {}, radians(15), context);
  std::vector<int> members;  // few enough for CBC to finish in seconds
  for (int j = 0; j < std::min<int>(30, static_cast<int>(patches.patches.size())); ++j) members.push_back(j);
  ASSERT_GE(members.size(), 6u);

  const AngleSet angles = make_angles({radians(90)});
  const std::vector<Vec3> locals = local_directions(angles, {});
  std::vector<OrientationFrame> frames;
  for (OrientationFrame& f : propose_frames(patches, members, {}, angles, {}, radians(15)))
    if (f.closed && frames.size() < 12) frames.push_back(std::move(f));
  ASSERT_GE(frames.size(), 3u);
  for (const int j : members) frames.push_back(open_frame(patches.patches[j].fit.normal, {}));
  const SelectionProblem p = make_problem(patches, members, frames, 0, angles, locals, 0.5, radians(15));
  ASSERT_EQ(p.patches(), static_cast<int>(members.size()));
  for (int j = 0; j < p.patches(); ++j) EXPECT_LT(p.data(j, p.frames() - p.patches() + j), 1e-9);
  Labels keep;
  for (int j = 0; j < p.patches(); ++j) keep.push_back(p.frames() - p.patches() + j);
  EXPECT_LE(energy_of(p, solve_local(p, test::kContext)).total(), energy_of(p, keep).total() + 1e-9);
  expect_near_optimum(p, GetParam().name + ", " + std::to_string(p.patches()) + " patches", 20);
}

/// The whole selection, coarse to fine, with what it states about itself.
TEST(SelectFrames, StatesItsOwnEnergyAndBound) {
  SynthOptions synth;
  synth.points = 30'000;
  Context context;
  const SynthScene scene = make_scene(synth, context);
  VoxelGrid grid = test::grid_of(scene.cloud, 0.04);
  const Cells cells = estimate_normals(grid, {}, context);
  const Patches patches = segment(grid, cells, {}, radians(15), context);
  const AngleSet angles = make_angles({radians(90)});
  for (const double lambda : {0.0, 0.2, 0.5, 0.8, 1.0}) {
    Options options;
    options.lambda = lambda;
    Selection s = select_frames(patches, angles, {}, options, context);
    state_bound(s, context);
    // Differences of 10⁻⁸ a frame are no reason for the search to go on.
    EXPECT_LE(s.after.total(), s.before.total() + 1e-8 * static_cast<double>(patches.patches.size()))
        << lambda;
    EXPECT_LE(s.bound, s.after.total() + 1e-9) << lambda;
    ASSERT_EQ(s.frame_of_patch.size(), patches.patches.size());
    const std::vector<Vec3> locals = local_directions(angles, {});
    for (std::size_t j = 0; j < patches.patches.size(); ++j) {
      ASSERT_GE(s.frame_of_patch[j], 0);
      const Vec3 n = s.frames[s.frame_of_patch[j]].direction(locals[s.local_of_patch[j]]);
      const double tilt = degrees(line_angle(n, patches.patches[j].fit.normal));
      EXPECT_LT(tilt, 15.0);
      if (lambda == 1.0) {
        EXPECT_LT(data_cost(patches.patches[j], n), 1e-7) << tilt;
      }
    }
  }
}

/// More weight on regularity never asks for more frames; at its extreme they are few.
TEST(SelectFrames, FewerFramesAsLambdaFalls) {
  SynthOptions synth;
  synth.points = 30'000;
  Context context;
  const SynthScene scene = make_scene(synth, context);
  VoxelGrid grid = test::grid_of(scene.cloud, 0.04);
  const Cells cells = estimate_normals(grid, {}, context);
  const Patches patches = segment(grid, cells, {}, radians(15), context);
  std::size_t last = 0;
  for (const double lambda : {0.0, 0.5, 1.0}) {
    Options options;
    options.lambda = lambda;
    const Selection s = select_frames(patches, make_angles({radians(90)}), {}, options, context);
    std::set<int> used(s.frame_of_patch.begin(), s.frame_of_patch.end());
    EXPECT_GE(used.size(), last);
    if (lambda == 0.0) {
      EXPECT_LE(used.size(), 2u);
    }
    last = used.size();
  }
  EXPECT_GE(last,
            patches.patches.size() * 8 / 10);  // patches that share a normal to 10⁻⁸ of cost share a frame
}

}  // namespace
}  // namespace unseen::planes
