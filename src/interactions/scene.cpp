// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interactions/layout/use.h"
#include "interactions/matching/evidence.h"
#include "interactions/people/motion.h"

namespace unseen::interactions {
namespace {

const Scenelet& scenelet_of(const Database& database, const Match& match) { return database.scenelets[static_cast<std::size_t>(match.scenelet)]; }

/// The match's placement with its pelvis on the path.
Placement on_path(const Match& match, const Reading& reading, const Path& path) {
  Placement placement = match.placement;
  placement.position.head<2>() = path.at(reading.frame);
  return placement;
}

double interpolated_likelihood(const std::vector<Reading>& readings, int frame) {
  const auto after = std::lower_bound(readings.begin(), readings.end(), frame, [](const Reading& r, int f) { return r.frame < f; });
  if (after == readings.begin()) return readings.front().likelihood;
  if (after == readings.end()) return readings.back().likelihood;
  const Reading& before = *(after - 1);
  const double share = static_cast<double>(frame - before.frame) / (after->frame - before.frame);
  return (1 - share) * before.likelihood + share * after->likelihood;
}

/// The price of an object, by superclass: with less confidence, most objects of generated takes were false. Seats and tables need a window as well.
bool convincing(const FoundObject& found) {
  constexpr std::array<double, 3> kLeast = {0.7, 0.45, 0.4};
  const Superclass superclass = found.object.superclass();
  return found.confidence >= kLeast[static_cast<std::size_t>(superclass)] && (superclass == Superclass::shelf || !found.windows.empty());
}

/// Who gestures holds a hand as one who reaches for a shelf. Where nobody is seen to use anything but shelves, no reach for one is surer than that.
void doubt_shelves_alone(std::vector<FoundObject>& objects) {
  constexpr double kGesture = 0.5;
  const bool alone = std::all_of(objects.begin(), objects.end(), [](const FoundObject& found) { return found.object.superclass() == Superclass::shelf; });
  if (!alone) return;
  for (FoundObject& found : objects) found.confidence *= kGesture;
}

/// How likely the evidence holds that something of this superclass stands at a place: the most over its turns and the cells around.
double evidence_at(const EvidenceMap& map, Superclass superclass, const Vec2& place) {
  const int column = static_cast<int>(std::floor((place.x() - map.origin.x()) / map.cell)), row = static_cast<int>(std::floor((place.y() - map.origin.y()) / map.cell));
  double most = 0;
  for (int r = std::max(0, row - 1); r <= std::min(map.rows - 1, row + 1); ++r)
    for (int c = std::max(0, column - 1); c <= std::min(map.columns - 1, column + 1); ++c)
      for (int turn = 0; turn < EvidenceMap::kTurns; ++turn) {
        const int plane = static_cast<int>(superclass) * EvidenceMap::kTurns + turn;
        most = std::max(most, static_cast<double>(map.probability[static_cast<std::size_t>((plane * map.rows + r) * map.columns + c)]));
      }
  return most;
}

}  // namespace

Story read_story(std::vector<Sight> sights, int person, const Database& database, const View& view, double fps, const Options& options,
                 const Context& context) {
  Story story;
  story.person = person;
  story.sights = std::move(sights);
  if (story.sights.empty()) return story;
  story.readings = read_motion(story.sights, database, view, fps, options.occlusion, context);
  if (story.readings.empty()) return story;
  story.path = find_path(story.readings, database, view, fps, story.sights.front().frame, story.sights.back().frame, options.smoothness);
  story.windows = find_windows(story.readings, database, fps, options.saliency);
  choose_scenelets(story.windows, story.readings, database, story.path, fps, options.smoothness);
  return story;
}

EvidenceMap evidence_of(const std::vector<Story>& stories, const Database& database) {
  constexpr std::size_t kGood = 10;      // matches of a reading
  constexpr int kMoments = 3;            // readings that have to agree
  constexpr double kUnlikely = 0.15;     // likelihood of an interaction below which someone just walks
  std::vector<Evidence> votes;
  std::vector<Vec2> walked;
  int moment = 0;
  for (const Story& story : stories)
    for (const Reading& reading : story.readings) {
      ++moment;
      if (reading.likelihood < kUnlikely) walked.push_back(story.path.at(reading.frame));
      for (std::size_t i = 0; i < std::min(kGood, reading.matches.size()); ++i) {
        Evidence vote{moment, reading.weights[i], {}};
        for (const Object& object : scenelet_of(database, reading.matches[i]).objects)
          vote.objects.push_back(on_path(reading.matches[i], reading, story.path) * object);
        votes.push_back(std::move(vote));
      }
    }
  return gather(votes, walked, kMoments);
}

std::vector<FoundObject> find_objects(const std::vector<Story>& stories, const Database& database, const EvidenceMap& evidence, const View& view,
                                      const Options& options) {
  std::vector<std::vector<bool>> used;
  for (const Scenelet& scenelet : database.scenelets) used.push_back(used_objects(scenelet));
  std::vector<UsedObject> in_use;
  std::vector<std::vector<int>> window_of;  // of each story's readings, −1 = none
  int windows = 0;
  for (std::size_t s = 0; s < stories.size(); ++s) {
    const Story& story = stories[s];
    for (UsedObject& object : used_objects_in(static_cast<int>(s), story.readings, story.path, database, used)) in_use.push_back(std::move(object));
    window_of.emplace_back(story.readings.size(), -1);
    for (const Choice& window : story.windows) {
      for (std::size_t r = 0; r < story.readings.size(); ++r)
        if (window.first <= story.readings[r].frame && story.readings[r].frame <= window.last) window_of.back()[r] = windows;
      ++windows;
    }
  }
  Gathered gathered = gather_objects(in_use, view);
  for (std::size_t i = 0; i < gathered.objects.size(); ++i) {
    FoundObject& found = gathered.objects[i];
    for (const std::size_t member : gathered.members[i])
      if (const int window = window_of[static_cast<std::size_t>(in_use[member].story)][in_use[member].reading]; window >= 0) found.windows.push_back(window);
    std::sort(found.windows.begin(), found.windows.end());
    found.windows.erase(std::unique(found.windows.begin(), found.windows.end()), found.windows.end());
    if (options.evidence) found.confidence *= std::min(1.0, evidence_at(evidence, found.object.superclass(), found.object.center().head<2>()) / 0.5);
  }
  std::erase_if(gathered.objects, [](const FoundObject& found) { return !convincing(found); });
  doubt_shelves_alone(gathered.objects);
  return gathered.objects;
}

std::vector<Window> windows_of(const std::vector<Story>& stories, const Database& database) {
  std::vector<Window> windows;
  for (const Story& story : stories)
    for (const Choice& choice : story.windows) {
      const Reading& reading = story.readings[choice.reading];
      const Match& match = reading.matches[choice.match];
      const Scenelet& scenelet = scenelet_of(database, match);
      windows.push_back({story.person, choice.first, choice.last,
                         fmt::format("{}, frame {}", database.recordings[static_cast<std::size_t>(scenelet.recording)].name, scenelet.center),
                         reading.likelihood, match.error, on_path(match, reading, story.path)});
    }
  return windows;
}

Person person_of(const Story& story, const Database& database, const View& view, double fps) {
  Person person{story.person, {}, {}};
  if (story.readings.empty()) return person;
  person.frames = find_motion(story.sights, story.readings, story.windows, database, story.path, view, fps);
  for (const PersonFrame& frame : person.frames) person.likelihood.push_back(interpolated_likelihood(story.readings, frame.frame));
  return person;
}

}  // namespace unseen::interactions
