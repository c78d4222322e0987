// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/interactions.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>

#include "interactions/method_samples.h"
#include "unseen/core/error.h"
#include "unseen/interactions/evaluate.h"
#include "unseen/report/scenelets_file.h"

namespace unseen::interactions {
namespace {

Reconstruction run(const std::vector<Take>& takes, int threads = 2) {
  Context context;
  context.threads = threads;
  return reconstruct(takes, report::shipped_database(), {}, context);
}

const SynthTake& generated(int seed, double seconds = 40) {
  static std::map<std::pair<int, double>, SynthTake> known;
  auto& synth = known[{seed, seconds}];
  if (synth.take.detections.empty()) synth = simulate(test::synth_options(seed, seconds));
  return synth;
}

/// What holds of any result, whatever the take.
void expect_sound(const Reconstruction& r, const Take& take) {
  EXPECT_TRUE(r.T_world_camera.is_rigid(1e-9));
  EXPECT_EQ(r.people.size(), static_cast<std::size_t>(take.people));
  for (const Person& person : r.people) {
    ASSERT_EQ(person.likelihood.size(), person.frames.size());
    for (std::size_t i = 0; i < person.frames.size(); ++i) {
      EXPECT_TRUE(person.frames[i].pose.allFinite());
      EXPECT_TRUE(i == 0 || person.frames[i - 1].frame < person.frames[i].frame);
      EXPECT_GE(person.likelihood[i], 0);
      EXPECT_LE(person.likelihood[i], 1 + 1e-9);
    }
  }
  for (const Window& w : r.windows) {
    EXPECT_LE(w.first, w.last);
    EXPECT_LT(w.person, take.people);
  }
  for (std::size_t i = 0; i < r.objects.size(); ++i) {
    const FoundObject& found = r.objects[i];
    EXPECT_EQ(found.object.id, static_cast<int>(i));
    EXPECT_GT(found.confidence, 0);
    EXPECT_LE(found.confidence, 1);
    EXPECT_FALSE(found.object.parts.empty());
    for (const Part& part : found.object.parts) EXPECT_TRUE(part.box.center.allFinite() && part.box.half_size.allFinite());
    for (const int window : found.windows) {
      ASSERT_GE(window, 0);
      ASSERT_LT(window, static_cast<int>(r.windows.size()));
    }
  }
  EXPECT_EQ(r.summary.status == Status::infeasible, r.objects.empty());
  std::map<std::string, std::size_t> counts(r.summary.counts.begin(), r.summary.counts.end());
  EXPECT_EQ(counts.size(), 5u);
  EXPECT_EQ(counts["people"], r.people.size());
  EXPECT_EQ(counts["objects"], r.objects.size());
  EXPECT_EQ(counts["windows"], r.windows.size());
  EXPECT_LE(counts["frames"], counts["detections"]);
  ASSERT_EQ(r.summary.energy.size(), 1u);
  double energy = 0;
  for (const Window& window : r.windows) energy += window.energy;
  EXPECT_NEAR(r.summary.energy[0].second, energy, 1e-12);
}

/// All numbers and names of a result but times.
struct Flat {
  std::vector<double> numbers;
  std::vector<std::string> names;

  template <class Matrix>
  void add(const Matrix& m) {
    for (Eigen::Index c = 0; c < m.cols(); ++c)
      for (Eigen::Index r = 0; r < m.rows(); ++r) numbers.push_back(m(r, c));
  }
};

Flat flat(const Reconstruction& r) {
  Flat f;
  f.add(r.T_world_camera.rotation);
  f.add(r.T_world_camera.translation);
  f.numbers.insert(f.numbers.end(), {r.ground.camera_height, r.ground.pitch, r.ground.roll, static_cast<double>(r.summary.status)});
  f.names.push_back(r.ground.source);
  for (const FoundObject& found : r.objects) {
    f.names.push_back(found.object.category);
    f.numbers.insert(f.numbers.end(), {static_cast<double>(found.object.id), found.confidence});
    for (const int window : found.windows) f.numbers.push_back(window);
    for (const Part& part : found.object.parts) {
      f.names.push_back(part.name);
      f.add(part.box.center);
      f.add(part.box.axes);
      f.add(part.box.half_size);
    }
  }
  for (const Person& person : r.people) {
    f.numbers.insert(f.numbers.end(), person.likelihood.begin(), person.likelihood.end());
    for (const PersonFrame& frame : person.frames) {
      f.numbers.insert(f.numbers.end(), {static_cast<double>(frame.frame), static_cast<double>(frame.source), static_cast<double>(frame.action)});
      f.add(frame.pose);
      f.add(frame.confidence);
    }
  }
  for (const Window& w : r.windows) {
    f.names.push_back(w.scenelet);
    for (const int number : {w.person, w.first, w.last}) f.numbers.push_back(number);
    f.numbers.insert(f.numbers.end(), {w.likelihood, w.energy, w.placement.angle});
    f.add(w.placement.position);
  }
  f.add(r.evidence.origin);
  f.numbers.insert(f.numbers.end(), {r.evidence.cell, static_cast<double>(r.evidence.columns), static_cast<double>(r.evidence.rows)});
  f.numbers.insert(f.numbers.end(), r.evidence.probability.begin(), r.evidence.probability.end());
  for (const std::string& warning : r.summary.warnings) f.names.push_back(warning);
  return f;
}

void expect_same_bytes(const Reconstruction& a, const Reconstruction& b) {
  const Flat x = flat(a), y = flat(b);
  EXPECT_EQ(x.names, y.names);
  ASSERT_EQ(x.numbers.size(), y.numbers.size());
  EXPECT_EQ(std::memcmp(x.numbers.data(), y.numbers.data(), x.numbers.size() * sizeof(double)), 0);
}

TEST(Reconstruct, FindsTheObjectsOfGeneratedTakes) {
  int interacted = 0, found = 0, false_objects = 0;
  double distance = 0;
  for (const int seed : {6001, 6002, 6003, 6004})
    for (const int people : {1, 2}) {
      const SynthTake synth = people == 1 ? generated(seed) : simulate(test::synth_options(seed, 40, people));
      const Reconstruction r = run({synth.take});
      EXPECT_EQ(r.summary.status, Status::solved);
      if (people == 1) {
        expect_sound(r, synth.take);
        EXPECT_EQ(r.people[0].frames.size(), synth.take.detections.size()) << "a pose in every frame with a detection";
      }
      const Evaluation e = evaluate(r, synth.truth);
      interacted += e.interacted, found += e.found, false_objects += e.false_objects;
      distance += e.found * e.mean_distance.value_or(0);
      EXPECT_LT(e.all->local, 0.08) << seed;
      EXPECT_LT(e.occluded->local, people == 1 ? 0.15 : 0.2) << seed;
      EXPECT_GT(e.action_accuracy, 0.7) << seed;
      EXPECT_LT(e.inside_objects, 0.05) << seed;
    }
  EXPECT_GE(interacted, 20);
  EXPECT_GE(5 * found, 4 * interacted);
  EXPECT_LE(false_objects, 2);
  EXPECT_LT(distance / found, 0.5);
}

TEST(Reconstruct, IsTheSameWithAnyNumberOfThreads) {
  const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);  // also where there are fewer cores
  const SynthTake synth = simulate(test::synth_options(6003, 8, 2));
  const Reconstruction one = run({synth.take}, 1);
  EXPECT_FALSE(one.windows.empty());
  expect_same_bytes(one, run({synth.take}, 2));
  expect_same_bytes(one, run({synth.take}, 4));
}

TEST(Reconstruct, EndsWhenAskedToStop) {
  const SynthTake& synth = generated(6001, 15);
  for (const char* stage : {"ground", "match", "scene", "motion"}) {
    std::stop_source source;
    Context context;
    context.stop = source.get_token();
    std::vector<std::string> stages;
    context.on_progress = [&](std::string_view name, double) {
      stages.emplace_back(name);
      if (name == stage) source.request_stop();
    };
    Take take = synth.take;
    take.camera_height = 1.2;  // with these there is little to do before
    take.up = -Vec3::UnitY();
    const Reconstruction r = reconstruct({take}, report::shipped_database(), {}, context);
    // Motion takes no time worth a check.
    EXPECT_TRUE(r.summary.status == Status::cancelled || stage == std::string("motion")) << stage;
    EXPECT_EQ(stages.back(), stage) << "nothing more is begun";
    EXPECT_EQ(r.fps, take.fps);
    EXPECT_EQ(r.camera.width, take.camera.width);
  }
}

TEST(Reconstruct, FindsLittleWhereNobodyTouchesAnything) {
  std::size_t objects = 0;
  for (const int seed : {6011, 6012, 6013, 7017}) {  // in the last somebody holds a hand to the head for long
    SynthOptions options = test::synth_options(seed, seed == 7017 ? 40 : 20, seed == 7017 ? 2 : 1);
    options.still = true;
    const SynthTake synth = simulate(options);
    const Reconstruction r = run({synth.take});
    expect_sound(r, synth.take);
    EXPECT_LE(r.objects.size(), 2u) << seed;
    objects += r.objects.size();
    for (const FoundObject& found : r.objects) EXPECT_LT(found.confidence, 0.5) << seed << " " << found.object.category;
  }
  EXPECT_LE(objects, 4u);
}

TEST(Reconstruct, StandsPeopleWhoLeaveAndComeBack) {
  SynthTake synth = simulate(test::synth_options(6021, 20, 2));
  std::erase_if(synth.take.detections, [](const Detection& d) { return d.frame >= 60 && d.frame < 120; });
  const Reconstruction r = run({synth.take});
  expect_sound(r, synth.take);
  std::size_t frames = 0;
  for (const Person& person : r.people)
    for (const PersonFrame& f : person.frames) {
      EXPECT_TRUE(f.frame < 60 || f.frame >= 120);
      ++frames;
    }
  EXPECT_GT(frames, synth.take.detections.size() * 9 / 10);
}

TEST(Reconstruct, StandsSomebodyWhoIsNeverThere) {
  SynthTake synth = simulate(test::synth_options(6001, 10));
  synth.take.people = 2;
  const Reconstruction r = run({synth.take});
  expect_sound(r, synth.take);
  EXPECT_TRUE(r.people[0].frames.empty() || r.people[1].frames.empty());
}

/// Share of the true poses' joints that a result has within 0.5 m.
double near_truth(const Reconstruction& r, const Recording& truth) {
  int near = 0, all = 0;
  for (const PersonFrame& f : r.people.at(0).frames)
    for (const RecordedFrame& t : truth.people.at(0)) {
      if (t.frame != f.frame) continue;
      near += static_cast<int>(((f.pose - t.pose).colwise().norm().array() < 0.5).count());
      all += kJoints;
    }
  return all > 0 ? static_cast<double>(near) / all : 0;
}

TEST(Reconstruct, WorksAtAnyFrameRate) {
  for (const double fps : {10.0, 30.0}) {
    SynthOptions options = test::synth_options(6002, 20);
    options.fps = fps;
    const SynthTake synth = simulate(options);
    const Reconstruction r = run({synth.take});
    expect_sound(r, synth.take);
    EXPECT_EQ(r.fps, fps);
    EXPECT_FALSE(r.objects.empty()) << fps;
    EXPECT_GT(near_truth(r, synth.truth), 0.6) << fps;
  }
}

TEST(Reconstruct, NeedsNoLiftedPoses) {
  SynthOptions options = test::synth_options(6002, 20);
  options.lifted = false;
  const SynthTake synth = simulate(options);
  const Reconstruction r = run({synth.take});
  expect_sound(r, synth.take);
  EXPECT_FALSE(r.objects.empty());
  EXPECT_GT(r.people[0].frames.size(), synth.take.detections.size() * 8 / 10);
  EXPECT_GT(near_truth(r, synth.truth), 0.6);
}

TEST(Reconstruct, StandsFramesInWhichNoJointIsSeen) {
  SynthTake synth = simulate(test::synth_options(6002, 20));
  for (Detection& d : synth.take.detections) {
    if (d.frame % 3 == 0) continue;
    d.confidence.setZero();
    d.pixels.setConstant(std::numeric_limits<double>::quiet_NaN());  // "then the pixel says nothing"
  }
  const Reconstruction r = run({synth.take});
  expect_sound(r, synth.take);
  EXPECT_GT(near_truth(r, synth.truth), 0.5);
  for (Detection& d : synth.take.detections) d.confidence.setZero();
  const Reconstruction blind = run({synth.take});
  expect_sound(blind, synth.take);
  EXPECT_EQ(blind.summary.status, Status::infeasible);
}

TEST(Reconstruct, StandsTakesOfAFewFrames) {
  for (const std::size_t frames : {1u, 2u, 3u, 7u}) {
    SynthTake synth = simulate(test::synth_options(6001, 5));
    synth.take.detections.resize(frames);
    const Reconstruction r = run({synth.take});
    expect_sound(r, synth.take);
    EXPECT_LE(r.people[0].frames.size(), frames);
  }
}

TEST(Reconstruct, FindsNothingWithoutScenelets) {
  const SynthTake& synth = generated(6001, 5);
  Context context;
  const Reconstruction r = reconstruct({synth.take}, {}, {}, context);
  expect_sound(r, synth.take);
  EXPECT_TRUE(r.objects.empty());
}

TEST(Reconstruct, SaysThatACameraIsAssumed) {
  Take take = generated(6001, 5).take;
  take.camera_assumed = true;
  Context context;
  const std::vector<std::string> warnings = reconstruct({take}, {}, {}, context).summary.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) { return w.find("field of view") != std::string::npos; }));
}

TEST(Reconstruct, SaysWhyNoMotionIsFound) {
  Take turned = generated(6001, 5).take, faint = turned;
  turned.up = Vec3::UnitY();  // down, in the camera's axes
  turned.camera_height = 100.0;
  for (Detection& d : turned.detections) d.local.reset();
  for (Detection& d : faint.detections) d.confidence.setConstant(0.1);
  const auto says = [](const Take& take, const std::string& why) {
    const std::vector<std::string> warnings = run({take}).summary.warnings;
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& w) { return w.find(why) != std::string::npos; });
  };
  EXPECT_TRUE(says(turned, "may be wrong: up points away from the floor"));
  EXPECT_FALSE(says(turned, "too few joints"));
  EXPECT_TRUE(says(faint, "too few joints"));
}

TEST(Reconstruct, RefusesTakesWithoutDetectionsAndOtherCameras) {
  SynthTake synth = simulate(test::synth_options(6001, 5));
  Take empty = synth.take, other = synth.take;
  empty.detections.clear();
  other.camera.fx *= 2;
  EXPECT_THROW(run({}), InputError);
  EXPECT_THROW(run({empty}), InputError);
  EXPECT_THROW(run({synth.take, other}), InputError);
}

TEST(Reconstruct, EveryTermCanBeOff) {
  const SynthTake& synth = generated(6002, 12);
  for (int off = 0; off < 5; ++off) {
    Options options;
    bool* const terms[] = {&options.occlusion, &options.smoothness, &options.intersection, &options.saliency, &options.evidence};
    *terms[off] = false;
    Context context;
    Take take = synth.take;
    take.camera_height = 1.2;
    take.up = -Vec3::UnitY();
    expect_sound(reconstruct({take}, report::shipped_database(), options, context), take);
  }
}

/// The halves of a take, as two takes.
std::vector<Take> halves(const Take& take, int frames) {
  Take first = take, second = take;
  std::erase_if(first.detections, [&](const Detection& d) { return d.frame >= frames / 2; });
  std::erase_if(second.detections, [&](const Detection& d) { return d.frame < frames / 2; });
  for (Detection& d : second.detections) d.frame -= frames / 2;
  return {first, second};
}

TEST(Reconstruct, TwoTakesOfARoomShowAtLeastWhatEachShows) {
  int objects = 0;
  for (const int seed : {6031, 6032}) {
    SynthTake synth = simulate(test::synth_options(seed, 50));
    synth.take.camera_height = synth.truth.T_world_camera.translation.z();  // so that all three have one floor
    synth.take.up = synth.truth.T_world_camera.rotation.transpose() * Vec3::UnitZ();
    const std::vector<Take> parts = halves(synth.take, 500);
    const Reconstruction whole = run(parts);
    EXPECT_EQ(whole.people.size(), 2u);
    for (const Take& part : parts)
      for (const FoundObject& found : run({part}).objects) {
        ++objects;
        EXPECT_TRUE(std::any_of(whole.objects.begin(), whole.objects.end(), [&](const FoundObject& other) {
          return other.object.superclass() == found.object.superclass() && (other.object.center() - found.object.center()).head<2>().norm() < 1.0;
        })) << seed << ": " << found.object.category << " at " << found.object.center().transpose() << ", " << found.confidence;
      }
  }
  EXPECT_GE(objects, 4);
}

}  // namespace
}  // namespace unseen::interactions
