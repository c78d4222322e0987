// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/pair_links.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/solve/mass_properties.h"
#include "collision/tracks/at_rest.h"
#include "collision/tracks/meeting_in_space.h"

namespace unseen::collision {
namespace {

constexpr double kFarthestGap = 0.5;    // s, if only flights in space tell, and
constexpr double kLongestFrames = 6.5;  // frame times at least
constexpr double kLongestOverlap = 4.0;  // frame times
constexpr double kLater = 2.0;          // frame times by which the flight after must begin and end later
constexpr double kAlikeBent = 0.1;      // of the curvature, by which perspective makes that of the other side another
constexpr double kBentSlack = 2.0;      // times as far apart parabolas may end if flights in space decide: perspective bends paths otherwise
constexpr double kSameTime = 2.5;       // frame times between the two bodies' own joints, beside what their spread explains
constexpr double kMostSlack = 6.0;      // frame times that this may be at most
constexpr double kMisfit = 2.0;         // ½ χ² a sighting about flights in space
constexpr double kPush = 0.12;          // of the faster velocity, by which both bodies' change if only flights in space tell of an impact
constexpr double kWorth = 40.0;         // of it in the score
constexpr double kTouch = 0.85;         // of the sum of the diameters that the centres may be apart at the impact
constexpr double kApart = 0.75;         // of that sum: where regions that far off are one body alone
constexpr std::ptrdiff_t kFewestAlone = 4;  // points of a flight at which the body is seen by itself
constexpr double kUnlike = 15.9;        // σ² between the looks before and after: bodies turn, and show other sides
constexpr double kOpposed = -0.5;       // cosine between the two changes of velocity: momentum goes from one to the other
constexpr double kSizesDiffer = 0.12;   // of the logarithm of the size ratio
constexpr double kOneCollision = 4.0;   // frame times between two collisions

CurveSums sums_of(const Arc& arc) {
  CurveSums sums(arc.begin());
  for (const Candidate& c : arc.points) sums.add(c.u, c.pixel);
  return sums;
}

/// Whether the body is held where it is, until it flies as `after`.
bool lies_until_hit(const Arc& before, const Curve& after) {
  std::vector<Vec2> places;
  std::vector<double> times;
  for (const Candidate& c : before.points) places.push_back(c.pixel), times.push_back(c.u);
  return stands_still(places, times, after.curvature.norm());
}

Joint joint_of(const Link& link, double u, double noise) { return joint_at(u, link.curve_before, link.curve_after, noise, link.diameter); }

/// Whether nobody saw the impact for so long that parabolas of the picture do not lead there.
bool is_unseen(const Link& a, const Link& b) { return std::max(a.begin - a.end, b.begin - b.end) > kLongestFrames; }

bool near(const Link& a, const Link& b, double distance, double noise) {
  const double reach = a.diameter + b.diameter;
  return reach <= 0.0 || distance < kTouch * reach + 4.0 * noise;
}

/// Times at which both links may be closed.
std::pair<double, double> window_of(const Link& a, const Link& b) {
  return {std::max(std::min(a.end, a.begin), std::min(b.end, b.begin)) - kBeyond, std::min(std::max(a.end, a.begin), std::max(b.end, b.begin)) + kBeyond};
}

/// What is to tell of an impact: parabolas of the picture, or flights in space alone, as after a long time behind something.
enum class Evidence { picture, space };

/// Gives the collision the time that flights in space have; false if they do not meet.
bool settle_in_space(const Shot& shot, const ShotCamera& camera, const std::vector<Arc>& arcs, double noise, double fps, Evidence evidence, Collision& c) {
  std::array<const Arc*, 4> flights{};
  for (std::size_t i = 0; i < 4; ++i) flights[i] = &arcs[c.arcs()[i]];
  if (swapped(shot, joined(flights[0]->points, flights[2]->points), joined(flights[1]->points, flights[3]->points))) {
    std::swap(flights[0], flights[1]);
    std::swap(flights[2], flights[3]);
  }
  const auto [low, high] = window_of(c.a, c.b);
  const auto meeting = meet_in_space(shot, camera, flights, low, high, noise, fps);
  if (!meeting || meeting->misfit > kMisfit || meeting->opposed > kOpposed || (evidence == Evidence::space && meeting->least_change < kPush)) return false;
  if (!near(c.a, c.b, (meeting->pixels[0] - meeting->pixels[1]).norm(), noise)) return false;
  c.u = meeting->u;
  c.score -= kWorth * meeting->misfit;
  return true;
}

/// How far apart in time each link alone is nearest to closed.
double time_between(const Link& a, const Link& b, double noise) { return std::abs(own_joint(a, noise).u - own_joint(b, noise).u); }

/// Whether both links close at one time, by pushes that momentum allows. Sets the time and the score.
bool agree(const Candidates& candidates, const std::vector<Arc>& arcs, double noise, Evidence evidence, Collision& c) {
  c.u = common_time(c.a, c.b, noise);
  if (std::isnan(c.u)) return false;
  const Joint ja = joint_of(c.a, c.u, noise), jb = joint_of(c.b, c.u, noise);
  const double slack = evidence == Evidence::space ? kBentSlack : 1.0;
  if (ja.apart > slack * ja.tolerance || jb.apart > slack * jb.tolerance || (evidence == Evidence::picture && !(ja.sudden && jb.sudden))) return false;
  const double opposed = ja.change.dot(jb.change) / (ja.change.norm() * jb.change.norm());
  if (opposed > kOpposed) return false;
  c.score = -20.0 * opposed - (ja.apart + jb.apart) / noise - 4.0 * time_between(c.a, c.b, noise) - c.a.unlike - c.b.unlike;
  for (const std::size_t k : c.arcs()) {
    const std::ptrdiff_t alone = count_alone(arcs[k], k == c.a.before || k == c.a.after ? c.b : c.a, candidates);
    if (alone < kFewestAlone) return false;
    c.score += std::min<double>(30.0, static_cast<double>(alone));
  }
  return true;
}

/// Whether parabolas of the picture say so of each link alone, and where the bodies can touch.
bool meet_in_the_picture(const Collision& c, double noise) {
  const Joint ja = joint_of(c.a, c.u, noise), jb = joint_of(c.b, c.u, noise);
  const double slack = kSameTime + std::min(kMostSlack, 4.0 * (ja.spread / ja.change.norm() + jb.spread / jb.change.norm()));
  const Vec2 pa = 0.5 * (c.a.curve_before.at(c.u) + c.a.curve_after.at(c.u)), pb = 0.5 * (c.b.curve_before.at(c.u) + c.b.curve_after.at(c.u));
  return time_between(c.a, c.b, noise) <= slack && near(c.a, c.b, (pa - pb).norm(), noise);
}

}  // namespace

std::ptrdiff_t count_alone(const Arc& arc, const Link& other, const Candidates& candidates) {
  return std::count_if(arc.points.begin(), arc.points.end(), [&](const Candidate& c) { return !is_both(c, other, candidates); });
}

Joint own_joint(const Link& link, double noise) { return join(link.curve_before, link.end, link.curve_after, link.begin, noise, link.diameter); }

std::vector<Link> links_of(const std::vector<Arc>& arcs, double noise, double longest, double slack) {
  const double gap = std::max(kLongestFrames, longest);
  std::vector<Candidate> looks;
  for (const Arc& arc : arcs) looks.push_back(looks_of(arc));
  std::vector<Link> links;
  for (std::size_t i = 0; i < arcs.size(); ++i)
    for (std::size_t j = 0; j < arcs.size(); ++j) {
      const double between = arcs[j].begin() - arcs[i].end();
      if (i == j || between > gap || between < -kLongestOverlap) continue;
      if (arcs[j].begin() < arcs[i].begin() + kLater || arcs[j].end() < arcs[i].end() + kLater || unlikeness(looks[i], looks[j]) > kUnlike) continue;
      Link link = link_of(arcs[i], arcs[j], noise);
      const Joint joint = own_joint(link, noise);
      if (joint.apart > slack * joint.tolerance) continue;
      link.before = i;
      link.after = j;
      link.unlike = unlikeness(looks[i], looks[j]);
      links.push_back(link);
    }
  return links;
}

Link link_of(const Arc& before, const Arc& after, double noise) {
  Link link;
  const CurveSums sums[2] = {sums_of(before), sums_of(after)};
  const Curve free[2] = {sums[0].fit(), sums[1].fit()};
  const double w[2] = {1.0 / free[0].cofactor(2, 2), 1.0 / free[1].cofactor(2, 2)};
  const Vec2 shared = (w[0] * free[0].curvature + w[1] * free[1].curvature) / (w[0] + w[1]);
  const double weight = 1.0 / (1.0 / (w[0] + w[1]) + kAlikeBent * kAlikeBent * shared.squaredNorm() / (noise * noise));
  link.curve_before = sums[0].fit(shared, weight);
  link.curve_after = sums[1].fit(shared, weight);
  if (lies_until_hit(before, free[1])) {
    constexpr double kStraight = 1e6;
    link.curve_before = sums[0].fit(Vec2::Zero(), kStraight);
    link.curve_after = free[1];
  }
  link.end = before.end();
  link.begin = after.begin();
  link.diameter = std::max(typical_diameter(before.points), typical_diameter(after.points));
  return link;
}

double common_time(const Link& a, const Link& b, double noise) {
  const auto [low, high] = window_of(a, b);
  if (high < low) return std::numeric_limits<double>::quiet_NaN();
  return least_between(low, high, [&](double u) {
    const Joint x = joint_of(a, u, noise), y = joint_of(b, u, noise);
    return std::pow(x.apart / x.spread, 2) + std::pow(y.apart / y.spread, 2);
  });
}

bool is_both(const Candidate& region, const Link& other, const Candidates& candidates) {
  if (region.region < 0 || region.u <= other.end || region.u >= other.begin) return false;
  const Vec2 before = other.curve_before.at(region.u), after = other.curve_after.at(region.u);
  const auto off = [&](const Candidate& c) { return std::min((c.pixel - before).norm(), (c.pixel - after).norm()); };
  if (off(region) > kApart * (region.diameter + other.diameter)) return false;
  const auto& frame = candidates[static_cast<std::size_t>(region.frame)];
  return std::none_of(frame.begin(), frame.end(), [&](const Candidate& c) {
    return c.region != region.region && !c.shadow && c.diameter > 0.5 * other.diameter && off(c) < 0.5 * other.diameter;
  });
}

std::vector<Collision> find_collisions(const Shot& shot, const ShotCamera& camera, const Candidates& candidates, const std::vector<Arc>& arcs, double noise,
                                       double fps) {
  std::vector<Collision> found;
  for (const Evidence evidence : {Evidence::picture, Evidence::space}) {
    const bool picture = evidence == Evidence::picture;
    const std::vector<Link> links = links_of(arcs, noise, (picture ? kLongestGap : kFarthestGap) * fps, picture ? 1.0 : kBentSlack);
    for (std::size_t i = 0; i < links.size(); ++i)
      for (std::size_t j = i + 1; j < links.size(); ++j) {
        const Link &a = links[i], &b = links[j];
        if (a.before == b.before || a.after == b.after || a.before == b.after || a.after == b.before) continue;
        Collision collision{a, b, 0.0, 0.0};
        if (!agree(candidates, arcs, noise, evidence, collision)) continue;
        const bool in_the_picture = evidence == Evidence::picture && meet_in_the_picture(collision, noise);
        const bool in_space = is_unseen(a, b) && settle_in_space(shot, camera, arcs, noise, fps, evidence, collision);
        if (in_the_picture || in_space) found.push_back(collision);
      }
    if (!found.empty()) break;
  }
  std::stable_sort(found.begin(), found.end(), [](const Collision& x, const Collision& y) { return x.score > y.score; });
  return found;
}

bool swapped(const Shot& shot, const std::vector<Candidate>& first, const std::vector<Candidate>& second) {
  int votes = 0;
  for (const Candidate& c : first) votes += c.body == 1 ? 1 : c.body == 0 ? -1 : 0;
  for (const Candidate& c : second) votes += c.body == 0 ? 1 : c.body == 1 ? -1 : 0;
  if (votes != 0) return votes > 0;
  const double a = mass_properties(shot.bodies[0], shot.name).extent, b = mass_properties(shot.bodies[1], shot.name).extent;
  const double da = typical_diameter(first), db = typical_diameter(second);
  if (a > 0.0 && b > 0.0 && da > 0.0 && db > 0.0 && std::abs(std::log(a / b)) > kSizesDiffer) return (std::log(a / b) > 0.0) != (std::log(da / db) > 0.0);
  const Candidate &f = first.front(), &s = second.front();
  return f.u != s.u ? f.u > s.u : f.pixel.x() > s.pixel.x();
}

std::vector<Candidate> joined(const std::vector<Candidate>& a, const std::vector<Candidate>& b) {
  std::vector<Candidate> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

int count_collisions(const std::vector<Collision>& found, const std::vector<char>& used) {
  std::vector<double> times = {found.front().u};
  for (const Collision& c : found) {
    if ((used[c.a.before] || used[c.b.before]) && (used[c.a.after] || used[c.b.after])) continue;
    if (std::none_of(times.begin(), times.end(), [&](double u) { return std::abs(u - c.u) < kOneCollision; })) times.push_back(c.u);
  }
  return static_cast<int>(times.size());
}

}  // namespace unseen::collision
