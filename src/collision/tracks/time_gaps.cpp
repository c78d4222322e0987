// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/time_gaps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "collision/tracks/curve.h"

namespace unseen::collision {
namespace {

constexpr int kSide = 4;             // points on either side that are looked at, at most
constexpr int kSideOfSingle = 6;     // the same, of a gap that no others repeat
constexpr int kFewestOfGap = 6;           // points in all; with a gravity one less, and two on one side will do
constexpr int kMostMissing = 2;      // frames
constexpr double kFits = 4.0;        // χ² a degree of freedom, of a fit that counts
constexpr double kStepModel = 0.02;      // of a step: what a parabola leaves of drag and perspective
constexpr double kBetter = 6.0;      // times smaller must the sum of squares get, and
constexpr double kClearly = 30.0;    // σ²
constexpr double kAlmost = 8.0;      // σ²: no worse than without the gap
constexpr double kSameSize = 0.05, kSizeError = 0.5;  // of a diameter, and px
constexpr std::size_t kFewestPeriodic = 3;
constexpr int kShortestPeriod = 3;   // frames

/// Both sides of a place in a track.
class Place {
 public:
  Place(const std::vector<Candidate>& track, int at, int before, int after, double noise, const std::optional<ImageGravity>& gravity)
      : track_(track), at_(at), first_(at - before), last_(at + after - 1), gravity_(gravity) {
    const double step = usable() ? (track[at].pixel - track[at - 1].pixel).norm() : 0.0;
    variance_ = noise * noise + kStepModel * kStepModel * step * step;
  }

  bool usable() const {
    return first_ >= 0 && last_ < static_cast<int>(track_.size()) && track_[last_].frame - track_[first_].frame <= last_ - first_ + 2 &&
           track_[at_].frame == track_[at_ - 1].frame + 1;
  }
  /// Sum of squares, σ², of one parabola through both sides with `missing` frames put between them.
  double squares(int missing) const {
    CurveSums sums(track_[at_].u);
    for (int i = first_; i <= last_; ++i) sums.add(track_[i].u + (i >= at_ ? missing : 0.0), track_[i].pixel);
    return (gravity_ ? sums.fit(gravity_->curvature, variance_ / (gravity_->sigma * gravity_->sigma)) : sums.fit()).squares / variance_;
  }
  double limit() const { return kFits * 2.0 * (last_ - first_ + 1 - (gravity_ ? 2 : 3)); }

 private:
  const std::vector<Candidate>& track_;
  int at_, first_, last_;
  const std::optional<ImageGravity>& gravity_;
  double variance_ = 1.0;
};

/// Calls `use` with the places before `at` that have enough points around, most points first, until it returns true.
template <class Use>
void for_each_place(const std::vector<Candidate>& track, int at, double noise, const std::optional<ImageGravity>& gravity, Use use) {
  for (int sum = 2 * kSide; sum >= (gravity ? kFewestOfGap - 1 : kFewestOfGap); --sum)
    for (int before = std::min(kSide, sum - 2); before >= std::max(2, sum - kSide); --before) {
      if (!gravity && (before < 3 || sum - before < 3)) continue;
      const Place place(track, at, before, sum - before, noise, gravity);
      if (place.usable() && use(place)) return;
    }
}

/// Whether two outlines may be one body's, a few frames apart. What takes in a shadow, or loses a part, jumps too.
bool are_alike(const Candidate& a, const Candidate& b) {
  return a.diameter <= 0.0 || b.diameter <= 0.0 || std::abs(a.diameter - b.diameter) < kSameSize * std::max(a.diameter, b.diameter) + kSizeError;
}

/// Missing frames before `at`, or 0.
int missing_before(const std::vector<Candidate>& track, int at, double noise, const std::optional<ImageGravity>& gravity) {
  int found = 0;
  if (!are_alike(track[at - 1], track[at])) return found;
  for_each_place(track, at, noise, gravity, [&](const Place& place) {
    const double plain = place.squares(0);
    if (plain < place.limit()) return true;  // nothing is missing
    for (int missing = 1; missing <= kMostMissing; ++missing)
      if (const double s = place.squares(missing); s < place.limit() && plain > kBetter * s + kClearly) {
        found = missing;
        return true;
      }
    return false;
  });
  return found;
}

/// Whether a gap that is alone has as many points on both sides as tell it from an outline that loses its underside to a shadow near the floor.
bool is_clear(const std::vector<Candidate>& track, int at, int missing, double noise, const std::optional<ImageGravity>& gravity) {
  const Place place(track, at, kSideOfSingle, kSideOfSingle, noise, gravity);
  return place.usable() && place.squares(missing) < place.limit() && place.squares(0) > kBetter * place.squares(missing) + kClearly;
}

/// True if no place of a period speaks against a missing frame there.
bool allowed(const std::vector<Candidate>& track, int period, int phase, double noise, const std::optional<ImageGravity>& gravity) {
  for (int at = 1; at < static_cast<int>(track.size()); ++at) {
    if (track[at - 1].frame % period != phase) continue;
    bool against = false;
    for_each_place(track, at, noise, gravity, [&](const Place& place) {
      const double plain = place.squares(0), gap = place.squares(1);
      against = plain < place.limit() && gap > plain + kAlmost;
      return plain < place.limit() || gap < place.limit();
    });
    if (against) return false;
  }
  return true;
}

/// The shortest period that gaps of one frame each keep to and that nothing speaks against.
std::optional<int> period_of(const std::vector<TimeGaps::Gap>& gaps, const std::vector<Candidate>& track, double noise,
                             const std::optional<ImageGravity>& gravity) {
  if (gaps.size() < kFewestPeriodic) return {};
  int common = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (gaps[i].missing != 1) return {};
    if (i > 0) common = std::gcd(common, gaps[i].after - gaps[i - 1].after);
  }
  for (int period = kShortestPeriod; period <= common; ++period)
    if (common % period == 0 && allowed(track, period, gaps.front().after % period, noise, gravity)) return period;
  return {};
}

}  // namespace

double TimeGaps::corrected(int frame, double u) const {
  if (period) {
    const int phase = (gaps.front().after % *period + *period) % *period;
    const int before = frame > phase ? (frame - phase - 1) / *period + 1 : 0;  // gaps before the frame
    return (u + before) * *period / (*period + 1.0);
  }
  for (const Gap& gap : gaps)
    if (frame > gap.after) u += gap.missing;
  return u;
}

TimeGaps find_time_gaps(const std::vector<Candidate>& track, double noise, const std::optional<ImageGravity>& gravity) {
  TimeGaps found;
  for (int at = 1; at < static_cast<int>(track.size()); ++at) {
    if (track[at].frame != track[at - 1].frame + 1) continue;
    if (const int missing = missing_before(track, at, noise, gravity)) found.gaps.push_back({track[at - 1].frame, missing});
  }
  found.period = period_of(found.gaps, track, noise, gravity);
  if (!found.period)
    std::erase_if(found.gaps, [&](const TimeGaps::Gap& gap) {
      const auto at = std::find_if(track.begin(), track.end(), [&](const Candidate& c) { return c.frame > gap.after; }) - track.begin();
      return !is_clear(track, static_cast<int>(at), gap.missing, noise, gravity);
    });
  return found;
}

}  // namespace unseen::collision
