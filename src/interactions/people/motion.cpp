// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/motion.h"

#include <algorithm>
#include <cmath>

#include "core/linear.h"

namespace unseen::interactions {
namespace {

constexpr double kPathSd = 0.12, kHeightSd = 0.06, kRaySd = 0.06;  // m: of the path, the scenelet's pelvis height, a joint about its ray
constexpr double kSmoothTime = 0.1, kSmoothSigmas = 3.0;  // s: what a body does not change its motion in

/// A pose with its pelvis at the origin, and where its pelvis is expected.
struct Draft {
  Pose local;
  Vec3 pelvis_at;
  Action action;
  PoseSource source;
};

struct Lent {
  const Reading* reading;
  std::size_t match;
};

/// The scenelet's pose in a frame, turned into the world; nothing where it has none.
std::optional<Draft> lend(const Lent& lent, int frame, const Database& database, const Path& path, double fps) {
  const Match& match = lent.reading->matches[lent.match];
  const Scenelet& scenelet = database.scenelets[static_cast<std::size_t>(match.scenelet)];
  const double offset = (frame - lent.reading->frame) / fps;
  const auto pose = pose_at(scenelet, offset);
  if (!pose) return std::nullopt;
  const Pose placed = match.placement * *pose;
  const auto index = static_cast<std::size_t>(std::clamp(std::lround(scenelet.middle + offset * scenelet.fps), 0L, static_cast<long>(scenelet.poses.size()) - 1));
  Draft draft{placed.colwise() - Vec3(placed.col(pelvis)), placed.col(pelvis), scenelet.actions[index], PoseSource::pose};
  draft.pelvis_at.head<2>() = path.at(frame);
  return draft;
}

const Reading& nearest_reading(const std::vector<Reading>& readings, int frame) {
  return *std::min_element(readings.begin(), readings.end(), [&](const Reading& a, const Reading& b) { return std::abs(a.frame - frame) < std::abs(b.frame - frame); });
}

/// Where the pelvis is best: joints on their rays, near the path, at the expected height.
Vec3 place_pelvis(const Draft& draft, const Sight& sight, const Vec3& camera) {
  const Vec3 prior(1 / (kPathSd * kPathSd), 1 / (kPathSd * kPathSd), 1 / (kHeightSd * kHeightSd));
  Mat3 normal = prior.asDiagonal();
  Vec3 right = prior.cwiseProduct(draft.pelvis_at);
  for (int k = 0; k < kJoints; ++k) {
    const Mat3 weight = sight.information[k] / (kRaySd * kRaySd);
    normal += weight;
    right += weight * (camera - draft.local.col(k));
  }
  return solve_symmetric(normal, right);
}

/// Moves each joint that is seen towards its ray, and its limb's far joints along with it; bones keep their lengths.
Pose bend(const Pose& pose, const Sight& sight, const Vec3& camera) {
  constexpr double kFollow = 0.5;  // of the way to the ray, for a joint seen for sure
  Pose bent = pose;
  for (const auto& [parent, child] : kBones) {
    const Vec3 bone = pose.col(child) - pose.col(parent);
    Vec3 wanted = bent.col(parent) + bone;
    if (sight.confidence[child] >= kSeen) {
      const Vec3 from = wanted - camera;
      const Vec3 off = from - sight.rays[child].dot(from) * sight.rays[child];
      wanted -= kFollow * sight.confidence[child] * off;
    }
    const Vec3 along = wanted - bent.col(parent);
    bent.col(child) = bent.col(parent) + (along.norm() > 1e-6 ? Vec3(along * (bone.norm() / along.norm())) : bone);
  }
  return bent;
}

/// A mean over neighbouring frames, weighted by a Gaussian in time, as far on either side as frames follow each other on both.
void smooth(std::vector<PersonFrame>& frames, double fps) {
  const std::vector<PersonFrame> before = frames;
  const int reach = static_cast<int>(kSmoothSigmas * kSmoothTime * fps);
  const auto frame_at = [&](std::size_t i, int offset) {  // none where a frame is missing
    const auto at = static_cast<std::ptrdiff_t>(i) + offset;
    const bool is_one = at >= 0 && at < std::ssize(before) && before[at].frame - before[i].frame == offset;
    return is_one ? &before[at] : nullptr;
  };
  for (std::size_t i = 0; i < frames.size(); ++i) {
    double sum = 1.0;
    for (int k = 1; k <= reach; ++k) {
      const PersonFrame *earlier = frame_at(i, -k), *later = frame_at(i, k);
      if (!earlier || !later) break;
      const double sigmas = k / (fps * kSmoothTime), weight = std::exp(-0.5 * sigmas * sigmas);
      frames[i].pose += weight * (earlier->pose + later->pose);
      sum += 2.0 * weight;
    }
    frames[i].pose /= sum;
  }
}

}  // namespace

std::vector<PersonFrame> find_motion(const std::vector<Sight>& sights, const std::vector<Reading>& readings, const std::vector<Choice>& windows,
                                     const Database& database, const Path& path, const View& view, double fps) {
  std::vector<PersonFrame> frames;
  for (const Sight& sight : sights) {
    const auto window = std::find_if(windows.begin(), windows.end(), [&](const Choice& w) { return w.first <= sight.frame && sight.frame <= w.last; });
    const Reading& near = nearest_reading(readings, sight.frame);
    std::optional<Draft> draft;
    if (window != windows.end()) draft = lend({&readings[window->reading], window->match}, sight.frame, database, path, fps);
    if (draft) draft->source = PoseSource::scenelet;
    if (!draft) draft = lend({&near, 0}, sight.frame, database, path, fps);
    if (!draft) continue;
    if (draft->source == PoseSource::pose && sight.local) draft->local = *sight.local;
    const Vec3 at = place_pelvis(*draft, sight, view.center());
    frames.push_back({sight.frame, bend(draft->local.colwise() + at, sight, view.center()), draft->source, draft->action, sight.confidence});
  }
  smooth(frames, fps);
  return frames;
}

}  // namespace unseen::interactions
