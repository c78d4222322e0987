// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <map>

#include "interactions/matching/matching.h"

namespace unseen::interactions {
namespace {

constexpr std::size_t kBlock = 64;      // scenelets at a time: their sums stay in the first cache
constexpr double kNearest = 0.3, kFarthest = 100;  // m: a body on one pixel would be anywhere
constexpr double kLeastCover = 0.5;     // of the glance's weight that a scenelet must have poses for
constexpr std::size_t kLeastJoints = 3;  // seen a sight, on average: with fewer any motion fits
constexpr double kPelvisHeight = 0.8;   // m, between sitting and standing

/// The joints of all scenelets at one offset, a coordinate after the other; zero where a scenelet has no pose there.
struct Sampled {
  std::vector<float> x, y, above;  // [joint][scenelet]; `above` the camera
  std::vector<float> has;          // [scenelet]
};

Sampled sample(const Database& database, double offset, double camera_height) {
  const std::size_t count = database.scenelets.size();
  Sampled s;
  for (auto* values : {&s.x, &s.y, &s.above}) values->assign(kJoints * count, 0.0f);
  s.has.assign(count, 0.0f);
  for (std::size_t i = 0; i < count; ++i) {
    const auto pose = pose_at(database.scenelets[i], offset);
    if (!pose) continue;
    s.has[i] = 1.0f;
    for (std::size_t k = 0; k < kJoints; ++k) {
      s.x[k * count + i] = static_cast<float>((*pose)(0, static_cast<int>(k)));
      s.y[k * count + i] = static_cast<float>((*pose)(1, static_cast<int>(k)));
      s.above[k * count + i] = static_cast<float>((*pose)(2, static_cast<int>(k)) - camera_height);
    }
  }
  return s;
}

/// Entries of PlacementCost for a block of scenelets. c and s are cos θ and sin θ.
struct Sums {
  std::array<float, kBlock> cc{}, cs{}, ss{}, cx{}, cy{}, sx{}, sy{}, xx{}, xy{}, yy{}, c{}, s{}, x{}, y{}, one{}, weight{};
};

/// PlacementCost::add for one joint of all scenelets of a block; the camera stands above the origin.
void add_joint(Sums& sums, const float* px, const float* py, const float* pz, std::size_t count, const Mat3& information) {
  const Eigen::Matrix3f n = information.cast<float>();
  const float n00 = n(0, 0), n01 = n(0, 1), n11 = n(1, 1), n02 = n(0, 2), n12 = n(1, 2), n22 = n(2, 2);
  for (std::size_t i = 0; i < count; ++i) {
    const float x = px[i], y = py[i], k = pz[i];
    const float ax = n00 * x + n01 * y, ay = n01 * x + n11 * y;    // information · (x, y)
    const float bx = -n00 * y + n01 * x, by = -n01 * y + n11 * x;  // information · (−y, x)
    sums.cc[i] += x * ax + y * ay;
    sums.cs[i] += -y * ax + x * ay;
    sums.ss[i] += -y * bx + x * by;
    sums.cx[i] += ax;
    sums.cy[i] += ay;
    sums.sx[i] += bx;
    sums.sy[i] += by;
    sums.c[i] += k * (n02 * x + n12 * y);
    sums.s[i] += k * (n12 * x - n02 * y);
    sums.x[i] += k * n02;
    sums.y[i] += k * n12;
    sums.one[i] += k * k * n22;
  }
}

/// What does not depend on the pose, of a sight's joints together.
void add_sight(Sums& sums, const float* has, std::size_t count, const Sight& sight) {
  Mat3 total = Mat3::Zero();
  double weight = 0;
  for (int k = 0; k < kJoints; ++k) {
    total += sight.information[k];
    if (sight.confidence[k] >= kSeen) weight += sight.confidence[k];
  }
  const Eigen::Matrix3f n = total.cast<float>();
  for (std::size_t i = 0; i < count; ++i) {
    sums.xx[i] += has[i] * n(0, 0);
    sums.xy[i] += has[i] * n(0, 1);
    sums.yy[i] += has[i] * n(1, 1);
    sums.weight[i] += has[i] * static_cast<float>(weight);
  }
}

PlacementCost cost_at(const Sums& s, std::size_t i) {
  PlacementCost cost;
  cost.quadratic << s.cc[i], s.cs[i], s.cx[i], s.cy[i],  //
      s.cs[i], s.ss[i], s.sx[i], s.sy[i],                //
      s.cx[i], s.sx[i], s.xx[i], s.xy[i],                //
      s.cy[i], s.sy[i], s.xy[i], s.yy[i];
  cost.linear << s.c[i], s.s[i], s.x[i], s.y[i];
  cost.constant = s.one[i];
  return cost;
}

/// What a glance's seen joints say together.
struct Seen {
  double weight = 0;         ///< of their confidences
  Vec3 ahead = Vec3::Zero();  ///< where they are from the camera
  std::size_t joints = 0;
};

Seen seen_in(const Glance& glance) {
  Seen seen;
  for (const Sight* sight : glance.sights)
    for (int k = 0; k < kJoints; ++k) {
      if (sight->confidence[k] < kSeen) continue;
      seen.weight += sight->confidence[k];
      seen.ahead += sight->confidence[k] * sight->rays[k];
      ++seen.joints;
    }
  return seen;
}

std::vector<Match> match_glance(const Glance& glance, const std::vector<const Sampled*>& sampled, std::size_t scenelets, double camera_height,
                                std::size_t keep) {
  std::vector<Match> matches;
  const Seen seen = seen_in(glance);
  if (seen.joints < kLeastJoints * glance.sights.size()) return matches;
  const double least = kLeastCover * seen.weight;
  for (std::size_t first = 0; first < scenelets; first += kBlock) {
    const std::size_t count = std::min(kBlock, scenelets - first);
    Sums sums;
    for (std::size_t i = 0; i < glance.sights.size(); ++i) {
      const Sight& sight = *glance.sights[i];
      const Sampled& at = *sampled[i];
      add_sight(sums, at.has.data() + first, count, sight);
      for (std::size_t k = 0; k < kJoints; ++k) {
        const std::size_t place = k * scenelets + first;
        if (sight.confidence[static_cast<int>(k)] >= kSeen)
          add_joint(sums, at.x.data() + place, at.y.data() + place, at.above.data() + place, count, sight.information[k]);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      PlacementFit fit;
      if (!(sums.weight[i] > 0) || sums.weight[i] < least || !fit_placement(cost_at(sums, i), fit)) continue;
      const double far = fit.position.squaredNorm();  // the cost is in metres where the scenelet is: nearer is no better
      if (!(far > kNearest * kNearest && far < kFarthest * kFarthest)) continue;
      if (!(seen.ahead.dot(Vec3(fit.position.x(), fit.position.y(), kPelvisHeight - camera_height)) > 0)) continue;  // rays end at the camera
      const double error = fit.cost / sums.weight[i] * glance.depth * glance.depth / far;
      matches.push_back({static_cast<int>(first + i), {{fit.position.x(), fit.position.y(), 0}, fit.angle}, error});
    }
  }
  const std::size_t kept = std::min(keep, matches.size());
  std::partial_sort(matches.begin(), matches.begin() + static_cast<std::ptrdiff_t>(kept), matches.end(), [](const Match& a, const Match& b) {
    return a.error != b.error ? a.error < b.error : a.scenelet < b.scenelet;
  });
  matches.resize(kept);
  return matches;
}

}  // namespace

std::vector<std::vector<Match>> match_all(const std::vector<Glance>& glances, const Database& database, const Vec3& camera, std::size_t keep,
                                          const Context& context) {
  std::map<long, Sampled> sampled;  // by offset in ms
  const auto key = [](double offset) { return std::lround(1000 * offset); };
  for (const Glance& glance : glances)
    for (const double offset : glance.offsets)
      if (!sampled.contains(key(offset))) sampled[key(offset)] = sample(database, offset, camera.z());
  std::vector<std::vector<Match>> matches(glances.size());
  parallel_blocks(context, glances.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::vector<const Sampled*> here;
      for (const double offset : glances[i].offsets) here.push_back(&sampled.at(key(offset)));
      matches[i] = match_glance(glances[i], here, database.scenelets.size(), camera.z(), keep);
    }
  });
  return matches;
}

}  // namespace unseen::interactions
