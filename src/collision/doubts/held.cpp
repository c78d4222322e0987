// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/held.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "collision/solve/unknowns.h"
#include "collision/video/frame_pixels.h"

namespace unseen::collision {
namespace {

constexpr double kLong = 0.1;                // s: no bounce takes as long
constexpr double kMore = 1.5;                // areas of the body: what is seen is not it alone
constexpr int kFewestFrames = 2;
constexpr double kOff = 0.5, kFarOff = 1.0;  // diameters: in each of so many frames, and in one of them

/// The last sighting before the impact, or the first one after it; null if there is none with a region.
const TrackPoint* next_to_impact(const Footage& footage, const Tracks& tracks, const Problem& problem, int body, bool after) {
  const PointObservation* next = nullptr;
  for (const PointObservation& p : problem.points)
    if (p.body == body && p.after == after && (!next || (p.time < next->time) == after)) next = &p;
  if (!next || static_cast<std::size_t>(next->frame) >= footage.regions.size()) return nullptr;
  const auto found = std::find_if(tracks.points.begin(), tracks.points.end(), [&](const TrackPoint& p) { return p.body == body && p.frame == next->frame; });
  const bool known = found != tracks.points.end() && found->region >= 0 && static_cast<std::size_t>(found->region) < footage.regions[found->frame].size();
  return known ? &*found : nullptr;
}

/// Those of a frame that are as near as `reach` (px) to some of the frame before.
std::vector<const Region*> connected(const std::vector<const Region*>& before, const std::vector<Region>& regions, int reach) {
  std::vector<const Region*> now;
  for (const Region& region : regions) {
    const cv::Rect about = region.box + cv::Size(2 * reach, 2 * reach) - cv::Point(reach, reach);
    if (std::any_of(before.begin(), before.end(), [&](const Region* b) { return !(b->box & about).empty(); })) now.push_back(&region);
  }
  return now;
}

/// px from a region; 0 = in it.
double distance(const Region& region, const cv::Point2d& pixel) {
  std::vector<cv::Point> inside;
  cv::findNonZero(region.mask, inside);
  double least = std::numeric_limits<double>::infinity();
  for (const cv::Point& p : inside) least = std::min(least, std::max(cv::norm(cv::Point2d(p + region.box.tl()) - pixel) - 0.5, 0.0));
  return least;
}

}  // namespace

std::optional<Held> held_between_flights(const Footage& footage, const ShotCamera& camera, const Tracks& tracks, const Solution& solution, int body) {
  const Problem& problem = solution.problem;
  const TrackPoint *last = next_to_impact(footage, tracks, problem, body, false), *first = next_to_impact(footage, tracks, problem, body, true);
  if (!problem.fixed || !last || !first) return std::nullopt;  // two bodies that collide are seen as one
  const StateT<double> state = values_of(problem, solution.fit.state);
  const double diameter = std::max(last->diameter, first->diameter);
  std::vector<const Region*> carriers{&footage.regions[last->frame][last->region]};
  const double body_area = std::max(carriers[0]->area, footage.regions[first->frame][first->region].area);
  Held held{first->time - last->time, 0.0};
  const int reach = static_cast<int>(std::ceil(diameter));
  int frames = 0, off_frames = 0, with_more = 0;
  for (int f = last->frame + 1; f < first->frame; ++f) {
    if (footage.doubled[f]) continue;
    const std::vector<Region>& regions = footage.regions[f];
    carriers = connected(carriers, regions, reach);
    const double time = footage.times[f];
    const Vec2 led = problem.camera.project(position_at<double>(problem, state, body, time > solution.fit.state.time, time));
    std::vector<cv::Point2d> pixel{{led.x(), led.y()}};
    to_frame_pixels(pixel, f, camera, footage);
    double off = std::numeric_limits<double>::infinity(), area = 0.0;
    for (const Region& region : regions) off = std::min(off, distance(region, pixel[0]));
    for (const Region* region : carriers) area += region->area;
    ++frames;
    with_more += area > kMore * body_area;
    if (!std::isfinite(off)) continue;
    off_frames += off > kOff * diameter;
    held.off = std::max(held.off, off);
  }
  const Region* end = &footage.regions[first->frame][first->region];
  const std::vector<const Region*> then = connected(carriers, footage.regions[first->frame], reach);
  if (std::find(then.begin(), then.end(), end) == then.end() || held.seconds < kLong || 2 * with_more < frames) return std::nullopt;
  if (off_frames < kFewestFrames || held.off < kFarOff * diameter) held.off = 0.0;
  return held;
}

}  // namespace unseen::collision
