// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/interactions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "interactions/ground/ground_fit.h"
#include "interactions/layout/masks.h"
#include "interactions/layout/settle_objects.h"
#include "interactions/people/merge_takes.h"
#include "interactions/scene.h"
#include "unseen/core/error.h"

namespace unseen::interactions {
namespace {

constexpr double kLeastConfidence = 0.05;  // of an object that is worth a word

/// Everybody's frames, with the objects whose windows these frames are in.
std::vector<Passing> passings(const Reconstruction& r) {
  std::vector<Passing> all;
  for (const Person& person : r.people)
    for (const PersonFrame& frame : person.frames) {
      Passing passing{{frame.pose.col(pelvis), frame.pose.col(right_knee), frame.pose.col(left_knee)}, {}};
      for (const FoundObject& found : r.objects)
        if (std::any_of(found.windows.begin(), found.windows.end(), [&](int w) {
              const Window& window = r.windows[static_cast<std::size_t>(w)];
              return window.person == person.id && window.first <= frame.frame && frame.frame <= window.last;
            }))
          passing.uses.push_back(found.object.id);
      all.push_back(std::move(passing));
    }
  return all;
}

/// Of all windows' matches, m².
double energy_of(const std::vector<Window>& windows) {
  double sum = 0;
  for (const Window& window : windows) sum += window.energy;
  return sum;
}

/// In which somebody is detected.
std::size_t frames_of(const Take& take) {
  std::set<int> frames;
  for (const Detection& detection : take.detections) frames.insert(detection.frame);
  return frames.size();
}

/// Why no motion was found for a person who was detected.
std::string why_unread(const Take& take, int person, const Story& story) {
  const bool seen = std::any_of(story.sights.begin(), story.sights.end(), [](const Sight& s) { return 2 * (s.confidence >= kSeen).count() > kJoints; });
  if (!seen) return fmt::format("person {}: too few joints have a confidence of {} or more for any motion", person, kSeen);
  const bool given = take.up || take.camera_height;
  return fmt::format("person {}: no motion of the database fits what is seen{}", person, given ? "; \"up\" and \"camera_height\" may be wrong: up points away from the floor, heights are in metres" : "");
}

void solve(const std::vector<Take>& takes, const Database& database, const Options& options, Reconstruction& r, Context& context) {
  const Take take = merge_takes(takes);
  if (take.camera_assumed)
    context.warn(fmt::format("the camera's intrinsics are assumed: focal length {:.0f} px, a field of view of {:.0f}°; distances along the view scale with it", take.camera.fx,
                             degrees(2 * std::atan2(0.5 * take.camera.width, take.camera.fx))));
  for (const std::string& remark : take.remarks) context.warn(remark);
  {
    const Stage stage(context, r.summary, "ground");
    r.ground = fit_ground(take, database, find_ground(take, context), context);
  }
  const View view = view_of(take.camera, r.ground);
  r.T_world_camera = view.T_world_camera;
  std::vector<Story> stories;
  {
    const Stage stage(context, r.summary, "match");
    for (int person = 0; person < take.people; ++person) {
      stories.push_back(read_story(sights_of(take, person, view), person, database, view, take.fps, options, context));
      if (!stories.back().sights.empty() && stories.back().readings.empty()) context.warn(why_unread(take, person, stories.back()));
      context.progress((person + 1.0) / take.people);
    }
  }
  {
    const Stage stage(context, r.summary, "scene");
    r.evidence = evidence_of(stories, database);
    r.objects = find_objects(stories, database, r.evidence, view, options);
    r.windows = windows_of(stories, database);
    heed_masks(r.objects, take.masks, view);
    std::erase_if(r.objects, [](const FoundObject& found) { return found.confidence < kLeastConfidence; });
  }
  const Stage stage(context, r.summary, "motion");
  for (const Story& story : stories) r.people.push_back(person_of(story, database, view, take.fps));
  if (options.intersection) settle_objects(r.objects, passings(r));
  for (std::size_t i = 0; i < r.objects.size(); ++i) r.objects[i].object.id = static_cast<int>(i);
  r.summary.energy = {{"windows", energy_of(r.windows)}};
  r.summary.counts = {{"frames", frames_of(take)}, {"people", static_cast<std::size_t>(take.people)}, {"detections", take.detections.size()},
                      {"objects", r.objects.size()}, {"windows", r.windows.size()}};
}

}  // namespace

Reconstruction reconstruct(const std::vector<Take>& takes, const Database& database, const Options& options, Context& context) {
  check_options(options);
  Reconstruction r;
  if (!takes.empty()) {
    r.camera = takes.front().camera;
    r.fps = takes.front().fps;
  }
  try {
    solve(takes, database, options, r, context);
    if (r.objects.empty()) r.summary.status = Status::infeasible;
  } catch (const Cancelled&) {
    r.summary.status = Status::cancelled;
  }
  r.summary.warnings = context.take_warnings();
  return r;
}

}  // namespace unseen::interactions
