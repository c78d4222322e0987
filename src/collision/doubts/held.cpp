// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/held.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "collision/video/mask_shape.h"

namespace unseen::collision {
namespace {

constexpr double kLong = 0.1;      // s, and
constexpr int kFewestFrames = 3;   // no bounce takes as long
constexpr double kMore = 1.5;      // areas of the body: what is seen is not it alone

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

/// Whether two regions are as near as `reach` (px).
bool are_near(const Region& a, const Region& b, int reach) {
  const cv::Rect wide = (a.box + cv::Size(2 * reach, 2 * reach) - cv::Point(reach, reach)) & b.box;
  if (wide.empty()) return false;
  cv::Mat part = cv::Mat::zeros(wide.size() + cv::Size(2 * reach, 2 * reach), CV_8U), near;  // of a, as far as it can be near
  const cv::Point corner = wide.tl() - cv::Point(reach, reach);
  const cv::Rect own = cv::Rect(corner, part.size()) & a.box;
  a.mask(own - a.box.tl()).copyTo(part(own - corner));
  cv::dilate(part, near, disc(2 * reach + 1));
  return cv::countNonZero(near(wide - corner) & b.mask(wide - b.box.tl())) > 0;
}

/// Those of a frame that are near some of the frame before.
std::vector<const Region*> connected(const std::vector<const Region*>& before, const std::vector<Region>& regions, int reach) {
  std::vector<const Region*> now;
  for (const Region& region : regions)
    if (std::any_of(before.begin(), before.end(), [&](const Region* b) { return are_near(*b, region, reach); })) now.push_back(&region);
  return now;
}

}  // namespace

std::optional<double> seconds_held(const Footage& footage, const Tracks& tracks, const Problem& problem, int body) {
  if (!problem.fixed) return std::nullopt;  // two bodies that collide are seen as one
  const TrackPoint *last = next_to_impact(footage, tracks, problem, body, false), *first = next_to_impact(footage, tracks, problem, body, true);
  if (!last || !first || first->time - last->time < kLong || first->frame - last->frame <= kFewestFrames) return std::nullopt;
  const Region &start = footage.regions[last->frame][last->region], &end = footage.regions[first->frame][first->region];
  const double body_area = std::max(start.area, end.area);
  const int reach = static_cast<int>(std::ceil(std::max(start.diameter, end.diameter)));
  std::vector<const Region*> carriers{&start};
  int frames = 0, with_more = 0;
  for (int f = last->frame + 1; f < first->frame; ++f) {
    if (footage.doubled[f]) continue;
    carriers = connected(carriers, footage.regions[f], reach);
    if (carriers.empty()) return std::nullopt;
    double area = 0.0;
    for (const Region* region : carriers) area += region->area;
    ++frames;
    with_more += area > kMore * body_area;
  }
  const std::vector<const Region*> then = connected(carriers, footage.regions[first->frame], reach);
  const bool held = frames >= kFewestFrames && 2 * with_more >= frames && std::find(then.begin(), then.end(), &end) != then.end();
  return held ? std::optional(first->time - last->time) : std::nullopt;
}

}  // namespace unseen::collision
