// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/identity_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "unseen/core/error.h"

namespace unseen::interactions {
namespace {

constexpr double kNearEnough = 0.2;  ///< half diagonals, from a label to the body that it marks

/// px from a pixel to the nearest bone whose ends are detected.
double distance(const Detection& detection, const Vec2& pixel) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : kBones) {
    if (!(detection.confidence[from] > 0) || !(detection.confidence[to] > 0)) continue;
    const Vec2 a = detection.pixels.col(from), along = detection.pixels.col(to) - a;
    const double length2 = along.squaredNorm();
    const double share = length2 > 0 ? std::clamp((pixel - a).dot(along) / length2, 0.0, 1.0) : 0.0;
    least = std::min(least, (a + share * along - pixel).norm());
  }
  return least;
}

int marked(const Take& take, const Sightings& s, const Label& label, const std::string& field) {
  int best = -1;
  double least = kNearEnough * s.half_diagonal;
  const auto slot = std::lower_bound(s.frames.begin(), s.frames.end(), label.frame);
  if (slot != s.frames.end() && *slot == label.frame)
    for (const int i : s.at[static_cast<std::size_t>(slot - s.frames.begin())])
      if (const double d = distance(take.detections[static_cast<std::size_t>(i)], label.pixel); d < least) {
        least = d;
        best = i;
      }
  if (best < 0)
    throw InputError(take.name, field, fmt::format("nobody at ({:.0f}, {:.0f}) in frame {}", label.pixel.x(), label.pixel.y(), label.frame), "a detected person");
  return best;
}

void fix(const Take& take, const Sightings& s, Allowed& allowed, int detection, int person, const std::string& field) {
  if (person < 0 || person >= take.people)
    throw InputError(take.name, field, fmt::format("person {}", person), fmt::format("0 to {}", take.people - 1));
  if ((allowed.detection[static_cast<std::size_t>(detection)] & (People{1} << person)) == 0)
    throw InputError(take.name, field, fmt::format("person {} in frame {}", person, take.detections[static_cast<std::size_t>(detection)].frame), "no contradiction to the other labels");
  allowed = with_fixed(std::move(allowed), s, detection, person);
}

}  // namespace

bool is_one(People people) { return std::has_single_bit(people); }

People busy(const Allowed& allowed, int after, int before) {
  People people = 0;
  for (std::size_t p = 0; p < allowed.fixed.size(); ++p) {
    const auto next = std::upper_bound(allowed.fixed[p].begin(), allowed.fixed[p].end(), after);
    if (next != allowed.fixed[p].end() && *next < before) people |= People{1} << p;
  }
  return people;
}

Allowed with_fixed(Allowed allowed, const Sightings& s, int detection, int person) {
  const int slot = s.slot[static_cast<std::size_t>(detection)];
  for (const int other : s.at[static_cast<std::size_t>(slot)]) allowed.detection[static_cast<std::size_t>(other)] &= ~(People{1} << person);
  allowed.detection[static_cast<std::size_t>(detection)] = People{1} << person;
  std::vector<int>& slots = allowed.fixed[static_cast<std::size_t>(person)];
  if (const auto at = std::lower_bound(slots.begin(), slots.end(), slot); at == slots.end() || *at != slot) slots.insert(at, slot);
  return allowed;
}

Allowed allowed_by_labels(const Take& take, const Sightings& s) {
  if (take.people < 1 || take.people > kMostPeople) throw InputError(take.name, "people", fmt::format("{}", take.people), fmt::format("1 to {}", kMostPeople));
  Allowed allowed = {std::vector<People>(take.detections.size(), (People{1} << take.people) - 1), std::vector<std::vector<int>>(static_cast<std::size_t>(take.people))};
  for (std::size_t i = 0; i < take.detections.size(); ++i)
    if (take.detections[i].person >= 0)
      fix(take, s, allowed, static_cast<int>(i), take.detections[i].person, fmt::format("frame {}", take.detections[i].frame));
  for (std::size_t i = 0; i < take.labels.size(); ++i) {
    const std::string field = fmt::format("labels[{}]", i);
    fix(take, s, allowed, marked(take, s, take.labels[i], field), take.labels[i].person, field);
  }
  return allowed;
}

}  // namespace unseen::interactions
