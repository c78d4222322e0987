// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/layout/gather_objects.h"

#include <cmath>
#include <map>

namespace unseen::interactions {
namespace {

/// How votes of a superclass gather: sd across and along the view (m, share of the distance), what is enough, and what makes sure: who gestures
/// reaches for a shelf now and then.
struct Habit {
  double across, along;
  double least_time;   // s
  double sure_time;    // s, of time constant
  double least_share;  // of a reading's matches
};
constexpr std::array<Habit, 3> kHabits = {{{0.16, 0.07, 0.5, 0.5, 0.5}, {0.30, 0.10, 1.0, 1.0, 0.4}, {0.30, 0.10, 1.5, 3.0, 0.4}}};
constexpr double kReadingTime = 0.2;  // s that a reading stands for
constexpr double kGate = 2.5;  // sd

/// How far the object reaches along its longer side on the ground, from its middle. m
double reach_of(const Object& object) {
  double reach = 0;
  for (const Part& part : object.parts) reach = std::max(reach, part.box.half_size.head<2>().maxCoeff());
  return reach;
}

/// Are two finds of one superclass one thing? Those within 0.8 m are, and two ends of a couch or bed; but two chairs can stand side by side.
bool same_thing(const Object& a, const Object& b, const Vec2& camera) {
  constexpr double kNear = 0.8, kBeside = 0.45, kSmallSeat = 0.35;  // m; the last of half a seat
  const Vec2 off = (a.center() - b.center()).head<2>();
  const Vec2 along = (0.5 * (a.center() + b.center()).head<2>() - camera).normalized();
  const double side = std::abs(off.x() * along.y() - off.y() * along.x()), larger = std::max(reach_of(a), reach_of(b));
  if (a.superclass() == Superclass::sit && larger < kSmallSeat) return off.norm() < kNear && side < kBeside;
  return off.norm() < std::max(kNear, a.superclass() == Superclass::sit ? larger + kBeside : 0.0);
}

/// Squared distance of two places in standard deviations.
double apart(const Vec2& a, const Vec2& b, const Habit& habit, const Vec2& camera) {
  const Vec2 middle = 0.5 * (a + b) - camera, along = middle.normalized(), off = a - b;
  const double depth = off.dot(along) / (habit.along * middle.norm()), side = (off.x() * along.y() - off.y() * along.x()) / habit.across;
  return depth * depth + side * side;
}

/// Votes that are within 2 cm of each other.
struct Heap {
  Vec2 place = Vec2::Zero();  ///< mean by mass
  double mass = 0;
};

std::vector<Heap> heaps_of(const std::vector<UsedObject>& in_use, const std::vector<std::size_t>& open) {
  constexpr double kCell = 0.02;  // m, far below what tells two objects apart: a long take has many votes but not many places
  std::map<std::pair<long, long>, Heap> cells;
  for (const std::size_t i : open) {
    Heap& heap = cells[{std::lround(in_use[i].place.x() / kCell), std::lround(in_use[i].place.y() / kCell)}];
    heap.place += in_use[i].mass * in_use[i].place;
    heap.mass += in_use[i].mass;
  }
  std::vector<Heap> heaps;
  for (auto& [cell, heap] : cells)
    if (heap.mass > 0) heaps.push_back({heap.place / heap.mass, heap.mass});
  return heaps;
}

/// The place around which most mass gathers.
Vec2 densest(const std::vector<UsedObject>& in_use, const std::vector<std::size_t>& open, const Habit& habit, const Vec2& camera) {
  const std::vector<Heap> heaps = heaps_of(in_use, open);
  Vec2 best = in_use[open.front()].place;
  double most = -1;
  for (const Heap& at : heaps) {
    double density = 0;
    for (const Heap& other : heaps) density += other.mass * std::exp(-0.5 * apart(at.place, other.place, habit, camera));
    if (density <= most) continue;
    most = density;
    best = at.place;
  }
  return best;
}

/// Largest share of a reading's matches, as a mean over three readings.
double peak_share(const std::vector<UsedObject>& in_use, const std::vector<std::size_t>& members) {
  std::map<std::pair<int, std::size_t>, double> shares;
  for (const std::size_t i : members) shares[{in_use[i].story, in_use[i].reading}] += in_use[i].share;
  double peak = 0;
  for (const auto& [at, share] : shares) {
    double sum = share;
    if (const auto before = shares.find({at.first, at.second - 1}); before != shares.end()) sum += before->second;
    if (const auto after = shares.find({at.first, at.second + 1}); after != shares.end()) sum += after->second;
    peak = std::max(peak, sum / 3);
  }
  return std::min(1.0, peak);
}

/// The object that they describe: category of most mass, its most typical one moved to their mean place.
Object describe(const std::vector<UsedObject>& in_use, const std::vector<std::size_t>& members) {
  std::map<std::string, double> masses;
  for (const std::size_t i : members) masses[in_use[i].object.category] += in_use[i].mass;
  const std::string category = std::max_element(masses.begin(), masses.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
  Vec3 mean = Vec3::Zero();
  double mass = 0;
  for (const std::size_t i : members) {
    if (in_use[i].object.category != category) continue;
    mean += in_use[i].mass * in_use[i].object.center();
    mass += in_use[i].mass;
  }
  mean /= mass;
  const UsedObject* typical = nullptr;
  double least = 0;
  for (const std::size_t i : members) {
    if (in_use[i].object.category != category) continue;
    const double cost = (in_use[i].object.center() - mean).squaredNorm() - 0.2 * in_use[i].share;
    if (typical && cost >= least) continue;
    typical = &in_use[i];
    least = cost;
  }
  Vec3 shift = mean - typical->object.center();
  shift.z() = 0;  // it stands on the floor
  return Placement{shift, 0} * typical->object;
}

/// How much their votes say that the object is there: those for a seat had better be of people who seem to interact, for who bends looks like one who sits.
double confidence_of(const std::vector<UsedObject>& in_use, const std::vector<std::size_t>& members, Superclass superclass, double share, double mass) {
  constexpr double kSurelySits = 0.5;  // likelihood of an interaction
  const double confidence = share * (1 - std::exp(-mass / kHabits[static_cast<std::size_t>(superclass)].sure_time));
  if (superclass != Superclass::sit) return confidence;
  double likelihood = 0;
  for (const std::size_t i : members) likelihood += in_use[i].mass * in_use[i].likelihood;
  return confidence * std::min(1.0, likelihood / mass / kSurelySits);
}

double mass_of(const std::vector<UsedObject>& in_use, const std::vector<std::size_t>& members) {
  double mass = 0;
  for (const std::size_t i : members) mass += in_use[i].mass;
  return mass;
}

/// Tables and shelves are both what hands are on: of two at one place the one with more votes stays, as sure as the surer one.
void tell_tables_from_shelves(Gathered& gathered, const std::vector<UsedObject>& in_use) {
  constexpr double kOnePiece = 0.6;  // m
  for (std::size_t i = 0; i < gathered.objects.size(); ++i)
    for (std::size_t j = gathered.objects.size(); j-- > i + 1;) {
      FoundObject &table = gathered.objects[i], &shelf = gathered.objects[j];
      if (table.object.superclass() != Superclass::table || shelf.object.superclass() != Superclass::shelf) continue;
      if ((table.object.center() - shelf.object.center()).head<2>().norm() >= kOnePiece) continue;
      const double confidence = std::max(table.confidence, shelf.confidence);
      if (mass_of(in_use, gathered.members[i]) < mass_of(in_use, gathered.members[j])) {
        std::swap(table, shelf);
        std::swap(gathered.members[i], gathered.members[j]);
      }
      gathered.objects[i].confidence = confidence;
      gathered.objects.erase(gathered.objects.begin() + static_cast<std::ptrdiff_t>(j));
      gathered.members.erase(gathered.members.begin() + static_cast<std::ptrdiff_t>(j));
    }
}

}  // namespace

std::vector<UsedObject> used_objects_in(int story, const std::vector<Reading>& readings, const Path& path, const Database& database,
                           const std::vector<std::vector<bool>>& used) {
  std::vector<UsedObject> in_use;
  for (std::size_t r = 0; r < readings.size(); ++r)
    for (std::size_t i = 0; i < readings[r].matches.size(); ++i) {
      const Match& match = readings[r].matches[i];
      const Scenelet& scenelet = database.scenelets[static_cast<std::size_t>(match.scenelet)];
      Placement placement = match.placement;
      placement.position.head<2>() = path.at(readings[r].frame);
      for (std::size_t o = 0; o < scenelet.objects.size(); ++o) {
        const Object& object = scenelet.objects[o];
        if (!used[static_cast<std::size_t>(match.scenelet)][o] || object.superclass() == Superclass::other) continue;
        UsedObject one{story, r, match.scenelet, placement * object, Vec2::Zero(),
                       readings[r].weights[i] * kReadingTime, readings[r].weights[i], readings[r].likelihood};
        one.place = object.superclass() == Superclass::sit ? Vec2(placement.position.head<2>()) : Vec2(one.object.center().head<2>());
        in_use.push_back(std::move(one));
      }
    }
  return in_use;
}

Gathered gather_objects(const std::vector<UsedObject>& in_use, const View& view) {
  Gathered gathered;
  const Vec2 camera = view.center().head<2>();
  for (std::size_t superclass = 0; superclass < kHabits.size(); ++superclass) {
    const Habit& habit = kHabits[superclass];
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < in_use.size(); ++i)
      if (in_use[i].object.superclass() == static_cast<Superclass>(superclass)) open.push_back(i);
    while (!open.empty()) {
      const Vec2 center = densest(in_use, open, habit, camera);
      std::vector<std::size_t> members, rest;
      for (const std::size_t i : open) (apart(in_use[i].place, center, habit, camera) < kGate * kGate ? members : rest).push_back(i);
      open = std::move(rest);
      const double mass = mass_of(in_use, members);
      if (mass < habit.least_time) break;  // nothing left gathers more
      const double share = peak_share(in_use, members);
      if (share < habit.least_share) continue;
      FoundObject found;
      found.object = describe(in_use, members);
      const auto known = std::find_if(gathered.objects.begin(), gathered.objects.end(), [&](const FoundObject& other) {
        return other.object.superclass() == found.object.superclass() && same_thing(other.object, found.object, camera);
      });
      if (known != gathered.objects.end()) {
        auto& all = gathered.members[static_cast<std::size_t>(known - gathered.objects.begin())];
        all.insert(all.end(), members.begin(), members.end());
        continue;
      }
      found.confidence = confidence_of(in_use, members, static_cast<Superclass>(superclass), share, mass);
      gathered.objects.push_back(std::move(found));
      gathered.members.push_back(std::move(members));
    }
  }
  tell_tables_from_shelves(gathered, in_use);
  for (std::size_t i = 0; i < gathered.objects.size(); ++i) gathered.objects[i].object.id = static_cast<int>(i);
  return gathered;
}

}  // namespace unseen::interactions
