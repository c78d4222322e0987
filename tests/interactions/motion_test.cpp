// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "interactions/method_samples.h"
#include "interactions/scene.h"
#include "interactions/scenelets_sample.h"
#include "unseen/report/scenelets_file.h"

namespace unseen::interactions {
namespace {

/// A generated take, read from where its camera really is.
struct Told {
  explicit Told(int seed, const SynthOptions& options) : synth(simulate(options)), view(test::true_view(synth)) {
    Context context;
    story = read_story(sights_of(test::with_persons(synth.take), 0, view), 0, report::shipped_database(), view, synth.take.fps, {}, context);
    EXPECT_FALSE(story.windows.empty()) << "seed " << seed;
  }
  std::vector<PersonFrame> motion() const {
    return find_motion(story.sights, story.readings, story.windows, report::shipped_database(), story.path, view, synth.take.fps);
  }
  SynthTake synth;
  View view;
  Story story;
};

const Told& told(int seed) {
  static std::map<int, std::unique_ptr<Told>> known;
  auto& one = known[seed];
  if (!one) one = std::make_unique<Told>(seed, test::synth_options(seed));
  return *one;
}

constexpr int kSeeds[] = {4001, 4002, 4003};

/// Readings every two frames at 10 fps with one match each and these likelihoods.
std::vector<Reading> readings_of(const std::vector<double>& likelihoods) {
  std::vector<Reading> readings;
  for (const double likelihood : likelihoods) {
    Reading r;
    r.frame = 2 * static_cast<int>(readings.size());
    r.likelihood = likelihood;
    r.matches = {{0, {}, 0.001}};
    r.weights = {1.0};
    readings.push_back(r);
  }
  return readings;
}

TEST(Windows, DoNotOverlapAndAreInOrder) {
  for (const int seed : kSeeds) {
    const Story& story = told(seed).story;
    for (std::size_t w = 0; w < story.windows.size(); ++w) {
      const Choice& window = story.windows[w];
      ASSERT_LT(window.reading, story.readings.size());
      ASSERT_LT(window.match, story.readings[window.reading].matches.size());
      const int frame = story.readings[window.reading].frame;
      EXPECT_LE(window.first, frame);
      EXPECT_GE(window.last, frame);
      EXPECT_GE(window.first, story.sights.front().frame);
      EXPECT_LE(window.last, story.sights.back().frame);
      EXPECT_TRUE(w == 0 || story.windows[w - 1].last < window.first) << seed << ", window " << w;
      const Scenelet& scenelet = report::shipped_database().scenelets[static_cast<std::size_t>(story.readings[window.reading].matches[window.match].scenelet)];
      for (const int end : {window.first, window.last}) EXPECT_TRUE(pose_at(scenelet, (end - frame) / told(seed).synth.take.fps));
    }
  }
}

TEST(Windows, AreWhereAnInteractionIsLikely) {
  const Database database{{}, {test::moving_scenelet(simple_pose(1), 0)}};
  const std::vector<double> likelihoods = {0, 0, 0, 0.9, 0.9, 0.9, 0, 0, 0, 0, 0, 0, 0, 0.7, 0.8, 0.6, 0.6, 0.6, 0.6, 0.6, 0, 0.9, 0, 0, 0};
  const auto windows = find_windows(readings_of(likelihoods), database, 10, true);
  std::vector<std::size_t> centers;
  for (const Choice& w : windows) centers.push_back(w.reading);
  // Means over three readings: 0.9 at 4; 0.7 at 14; 0.6 at 16 to 18, of which 16 is too near; 0.5 at 20; the lone 0.9 at 21 is but 0.3.
  EXPECT_EQ(centers, (std::vector<std::size_t>{4, 14, 17, 20}));
  EXPECT_TRUE(find_windows(readings_of(std::vector<double>(20, 0.3)), database, 10, true).empty());
  EXPECT_FALSE(find_windows(readings_of(std::vector<double>(20, 0.3)), database, 10, false).empty()) << "all of them match well";
  EXPECT_TRUE(find_windows({}, database, 10, true).empty());
}

TEST(Windows, TakeTheBestSequenceOfScenelets) {
  for (const int seed : kSeeds) {
    const Told& t = told(seed);
    const auto& readings = t.story.readings;
    const Database& database = report::shipped_database();
    const double fps = t.synth.take.fps;
    std::vector<Choice> windows = t.story.windows;
    windows.resize(std::min<std::size_t>(4, windows.size()));
    const auto body = [&](const Choice& w, std::size_t match, double frame) -> std::optional<Pose> {
      const Reading& r = readings[w.reading];
      const Match& m = r.matches[match];
      auto pose = pose_at(database.scenelets[static_cast<std::size_t>(m.scenelet)], (frame - r.frame) / fps);
      if (!pose) return std::nullopt;
      Placement there = m.placement;
      there.position.head<2>() = t.story.path.at(r.frame);
      return there * *pose;
    };
    const auto cost = [&](const std::vector<std::size_t>& choice) {
      double sum = 0;
      for (std::size_t w = 0; w < windows.size(); ++w) {
        sum += readings[windows[w].reading].matches[choice[w]].error;
        if (w == 0) continue;
        const int a = readings[windows[w - 1].reading].frame, b = readings[windows[w].reading].frame;
        if (b - a >= 3 * fps) continue;
        const auto from = body(windows[w - 1], choice[w - 1], 0.5 * (a + b)), to = body(windows[w], choice[w], 0.5 * (a + b));
        double jump = 0;
        for (int k = 0; from && to && k < kJoints; ++k) jump += (from->col(k) - to->col(k)).squaredNorm() / kJoints;
        sum += 0.1 * (from && to ? jump : 0.05);
      }
      return sum;
    };
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> counts, choice(windows.size(), 0);
    for (const Choice& w : windows) counts.push_back(std::min<std::size_t>(5, readings[w.reading].matches.size()));
    for (bool more = true; more;) {  // all sequences
      least = std::min(least, cost(choice));
      more = false;
      for (std::size_t w = 0; w < choice.size() && !more; ++w) {
        if (++choice[w] < counts[w]) more = true;
        else choice[w] = 0;
      }
    }
    choose_scenelets(windows, readings, database, t.story.path, fps, true);
    std::vector<std::size_t> chosen;
    for (const Choice& w : windows) chosen.push_back(w.match);
    EXPECT_NEAR(cost(chosen), least, 1e-12) << seed;
  }
}

TEST(Motion, HasOnePoseAFrameWithADetection) {
  for (const int seed : kSeeds) {
    const Told& t = told(seed);
    const auto frames = t.motion();
    ASSERT_EQ(frames.size(), t.story.sights.size());
    int in_windows = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(frames[i].frame, t.story.sights[i].frame);
      EXPECT_TRUE(frames[i].pose.allFinite());
      const auto covers = [&](const Choice& w) { return w.first <= frames[i].frame && frames[i].frame <= w.last; };
      const bool window = std::any_of(t.story.windows.begin(), t.story.windows.end(), covers);
      EXPECT_EQ(frames[i].source, window ? PoseSource::scenelet : PoseSource::pose) << frames[i].frame;
      in_windows += window;
    }
    EXPECT_GT(in_windows, 0);
  }
}

/// Every other frame alone, so that nothing is smoothed.
std::vector<Sight> every_other(const std::vector<Sight>& sights) {
  std::vector<Sight> some;
  for (std::size_t i = 0; i < sights.size(); i += 2) some.push_back(sights[i]);
  return some;
}

TEST(Motion, BendsButDoesNotStretch) {
  for (const int seed : kSeeds) {
    const Told& t = told(seed);
    const Database& database = report::shipped_database();
    const auto sights = every_other(t.story.sights);
    const auto frames = find_motion(sights, t.story.readings, t.story.windows, database, t.story.path, t.view, t.synth.take.fps);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      std::optional<Pose> lent;
      for (const Choice& w : t.story.windows)
        if (w.first <= frames[i].frame && frames[i].frame <= w.last) {
          const Reading& r = t.story.readings[w.reading];
          lent = pose_at(database.scenelets[static_cast<std::size_t>(r.matches[w.match].scenelet)], (frames[i].frame - r.frame) / t.synth.take.fps);
        }
      if (!lent) lent = sights[i].local;
      ASSERT_TRUE(lent);
      for (const auto& [a, b] : kBones)
        EXPECT_NEAR((frames[i].pose.col(a) - frames[i].pose.col(b)).norm(), (lent->col(a) - lent->col(b)).norm(), 1e-9)
            << seed << ", frame " << frames[i].frame;
    }
  }
}

TEST(Motion, SmoothingHardlyShortensLimbs) {
  for (const int seed : kSeeds) {
    const Told& t = told(seed);
    const auto sights = every_other(t.story.sights);
    const auto frames = t.motion(),
               single = find_motion(sights, t.story.readings, t.story.windows, report::shipped_database(), t.story.path, t.view, t.synth.take.fps);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < single.size(); ++i)
      for (const auto& [a, b] : kBones)
        ratios.push_back((frames[2 * i].pose.col(a) - frames[2 * i].pose.col(b)).norm() / (single[i].pose.col(a) - single[i].pose.col(b)).norm());
    std::sort(ratios.begin(), ratios.end());
    EXPECT_GT(ratios[ratios.size() / 20], 0.93) << seed;
    EXPECT_LT(ratios[ratios.size() * 19 / 20], 1.07) << seed;
  }
}

TEST(Motion, IsNearTheTruthAndContinuous) {
  for (const int seed : kSeeds) {
    const Told& t = told(seed);
    const auto frames = t.motion();
    double local = 0, step = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto& people = t.synth.truth.people[0];
      const auto truth = std::find_if(people.begin(), people.end(), [&](const RecordedFrame& f) { return f.frame == frames[i].frame; });
      ASSERT_NE(truth, people.end());
      const Vec3 off = frames[i].pose.col(pelvis) - truth->pose.col(pelvis);
      local += (frames[i].pose - truth->pose).colwise().operator-(off).colwise().norm().mean();
      if (i > 0 && frames[i].frame == frames[i - 1].frame + 1)
        step = std::max(step, (frames[i].pose.col(pelvis) - frames[i - 1].pose.col(pelvis)).norm());
    }
    EXPECT_LT(local / static_cast<double>(frames.size()), 0.10) << seed;
    EXPECT_LT(step, 0.45) << seed << ": m in 0.1 s";
  }
}

/// m/s²: mean acceleration of joints where three frames follow each other.
double acceleration(const std::vector<std::pair<int, Pose>>& poses, double fps) {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
    if (poses[i + 1].first - poses[i - 1].first != 2) continue;
    sum += (poses[i - 1].second - 2.0 * poses[i].second + poses[i + 1].second).colwise().norm().mean() * fps * fps;
    ++count;
  }
  return sum / count;
}

TEST(Motion, DoesNotShakeAtAnyFrameRate) {  // where scenelets and the detector's noise change from frame to frame
  for (const double fps : {10.0, 50.0}) {
    SynthOptions options = test::synth_options(4002, 12);
    options.fps = fps;
    const Told t(4002, options);
    std::vector<std::pair<int, Pose>> found, truth;
    for (const PersonFrame& f : t.motion()) found.emplace_back(f.frame, f.pose);
    for (const RecordedFrame& f : t.synth.truth.people[0]) truth.emplace_back(f.frame, f.pose);
    EXPECT_LT(acceleration(found, fps), 2.0 * acceleration(truth, fps)) << fps;
  }
}

TEST(Motion, WithoutLiftedPosesIsThatOfScenelets) {
  SynthOptions options = test::synth_options(4001, 20);
  options.lifted = false;
  const Told t(4001, options);
  const auto frames = t.motion();
  EXPECT_GT(frames.size(), t.story.sights.size() * 8 / 10) << "but where no scenelet reaches";
  for (const PersonFrame& f : frames) EXPECT_TRUE(f.pose.allFinite());
}

}  // namespace
}  // namespace unseen::interactions
