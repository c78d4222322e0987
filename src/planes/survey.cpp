// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>

#include "planes/scale.h"
#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kSample = 300'000;
constexpr std::size_t kMostSought = std::size_t{1}
                                    << 25;  // points among which duplicates are sought: 24 bytes each

std::uint64_t mix(std::uint64_t h) {
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ull;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBull;
  return h ^ (h >> 31);
}

/// Depends on the coordinates alone (0.0 and −0.0 are the same).
std::uint64_t hash(const Vec3& p) {
  std::uint64_t h = 0x9E3779B97F4A7C15ull;
  for (int a = 0; a < 3; ++a) h = mix(h + std::bit_cast<std::uint64_t>(p[a] + 0.0));
  return h;
}

std::uint64_t hash(const PointCloud& cloud, std::size_t point) {
  return cloud.normals.empty() ? 0 : hash(cloud.normals[point].cast<double>());
}

/// Marks all but one of the points that share their coordinates (two places in 2⁶⁴ have the same hash). Which
/// one stays does not depend on the order of the points: the one whose normal has the smallest hash.
void find_duplicates(PointSource& source, Survey& survey) {
  struct Hashed {
    std::uint64_t position, normal;
    std::uint32_t point;
    auto operator<=>(const Hashed&) const = default;
  };
  LargeVector<Hashed> order;
  order.reserve(survey.finite);
  for_each_block(source, [&](const PointCloud& block, std::size_t first) {
    for (std::size_t i = 0; i < block.size(); ++i)
      if (block.positions[i].allFinite())
        order.push_back({hash(block.positions[i]), hash(block, i), static_cast<std::uint32_t>(first + i)});
  });
  std::sort(order.begin(), order.end());
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i].position != order[i - 1].position) continue;
    if (survey.duplicate.empty()) survey.duplicate.assign(survey.points, false);
    survey.duplicate[order[i].point] = true;
    ++survey.duplicates;
  }
}

/// The box that holds all but a hundredth of the sample at either end of each axis, grown on all sides by ten
/// times its longest edge. The sample is in the order of its hashes, so that its first points are as even as the whole.
Box neighbourhood(const LargeVector<Vec3>& sample) {
  constexpr double kAtEachEnd = 0.01, kFar = 10.0;
  constexpr std::size_t kTelling = 20'000;
  std::vector<double> along(std::min(sample.size(), kTelling));
  const auto rank = static_cast<std::ptrdiff_t>(kAtEachEnd * static_cast<double>(along.size()));
  Box box;
  for (int a = 0; a < 3; ++a) {
    std::transform(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(along.size()), along.begin(), [&](const Vec3& p) { return p[a]; });
    std::nth_element(along.begin(), along.begin() + rank, along.end());
    box.low[a] = along[rank];
    std::nth_element(along.begin(), along.end() - 1 - rank, along.end());
    box.high[a] = *(along.end() - 1 - rank);
  }
  const double margin = kFar * (box.high - box.low).maxCoeff();
  return {box.low.array() - margin, box.high.array() + margin};
}

/// No-data values and a few points that lie far from all others would stand for the size of the scene: the
/// box leaves them out, and then the sample speaks for the extent.
void leave_out_strays(Survey& s) {
  const Box box = neighbourhood(s.sample);
  if (box.contains(s.low) && box.contains(s.high)) return;
  s.within = box;
  s.low.setConstant(std::numeric_limits<double>::infinity());
  s.high = -s.low;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < s.sample.size(); ++i) {
    if (!box.contains(s.sample[i])) continue;
    s.low = s.low.cwiseMin(s.sample[i]);
    s.high = s.high.cwiseMax(s.sample[i]);
    if (s.has_normals()) s.sample_normals[kept] = s.sample_normals[i];
    s.sample[kept++] = s.sample[i];
  }
  s.sample.resize(kept);
  if (s.has_normals()) s.sample_normals.resize(kept);
}

/// Squares and cubes of lengths must be numbers.
void check_extent(const Survey& s, const std::string& name) {
  constexpr double kLongest = 1e75;  // m
  if (s.extent() < kLongest) return;
  throw InputError(name, "points",
                   fmt::format("coordinates from {} to {}", s.low.minCoeff(), s.high.maxCoeff()),
                   fmt::format("an extent below {} m", kLongest));
}

struct Sampled {
  std::uint64_t hash;
  Vec3 position;
  Vec3f normal;
};

/// At most kSample of the places seen: those whose hash starts with enough zeros. Which these are depends on
/// all places seen, not on their order. A place is known by its hash, and holds the normal whose own hash is
/// smallest.
class EvenSample {
 public:
  explicit EvenSample(std::size_t expected) { places_.reserve(std::min(expected, kSample + 1)); }
  bool wants(std::uint64_t hash) const { return zeros_ == 0 || hash >> (64 - zeros_) == 0; }
  void add(const Sampled& x) {
    std::uint32_t& slot = slot_of(x.hash);
    if (slot == 0) {
      places_.push_back(x);
      slot = static_cast<std::uint32_t>(places_.size());
      if (places_.size() > kSample) thin();
      if (2 * places_.size() > slots_.size()) fill(2 * slots_.size());
      return;
    }
    twins_ = true;
    Sampled& known = places_[slot - 1];
    if (hash(x.normal.cast<double>()) < hash(known.normal.cast<double>())) known.normal = x.normal;
  }
  bool twins() const { return twins_; }
  bool has_all() const { return zeros_ == 0; }
  LargeVector<Sampled> by_hash() const {
    const auto less = [](const Sampled& a, const Sampled& b) { return a.hash < b.hash; };
    // Hashes are spread evenly: buckets of their leading digits hold a few places each.
    const int digits = std::bit_width(places_.size() / kOfBucket);
    const auto bucket_of = [&](const Sampled& x) { return digits == 0 ? 0 : (x.hash << zeros_) >> (64 - digits); };
    std::vector<std::uint32_t> first((std::size_t{1} << digits) + 1, 0);
    for (const Sampled& x : places_) ++first[bucket_of(x)];
    std::partial_sum(first.begin(), first.end(), first.begin());
    LargeVector<Sampled> sorted(places_.size());
    for (const Sampled& x : places_) sorted[--first[bucket_of(x)]] = x;
    for (std::size_t b = 0; b + 1 < first.size(); ++b) std::sort(sorted.begin() + first[b], sorted.begin() + first[b + 1], less);
    return sorted;
  }

 private:
  std::uint32_t& slot_of(std::uint64_t hash) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash & mask;
    while (slots_[at] != 0 && places_[slots_[at] - 1].hash != hash) at = (at + 1) & mask;
    return slots_[at];
  }
  void thin() {
    while (places_.size() > kSample) {
      ++zeros_;
      std::erase_if(places_, [&](const Sampled& x) { return !wants(x.hash); });
    }
    fill(slots_.size());
  }
  void fill(std::size_t slots) {
    slots_.assign(slots, 0);
    for (std::size_t i = 0; i < places_.size(); ++i)
      slot_of(places_[i].hash) = static_cast<std::uint32_t>(i + 1);
  }

  static constexpr std::size_t kOfBucket = 8;
  int zeros_ = 0;
  bool twins_ = false;
  LargeVector<Sampled> places_;
  LargeVector<std::uint32_t> slots_ =
      LargeVector<std::uint32_t>(4096);  ///< a power of two; index + 1 into places_, 0 = free
};

}  // namespace

Survey survey(PointSource& source, Context& context) {
  Survey s;
  s.low.setConstant(std::numeric_limits<double>::infinity());
  s.high = -s.low;
  const bool normals = source.info().has_normals;
  EvenSample sample(source.info().point_count.value_or(0));
  const double total = static_cast<double>(source.info().point_count.value_or(0));
  for_each_block(source, [&](const PointCloud& block, std::size_t first) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      if ((i & 0xffff) == 0) context.progress(total > 0 ? std::min(1.0, (first + i) / total) : 0.0);
      const Vec3& p = block.positions[i];
      if (!p.allFinite()) continue;
      ++s.finite;
      s.low = s.low.cwiseMin(p);
      s.high = s.high.cwiseMax(p);
      const bool normal = normals && i < block.normals.size();
      if (normal) {
        const float length = block.normals[i].squaredNorm();
        if (!(length > 0.25f && length < 4.0f)) ++s.without_normal;
      }
      const std::uint64_t h = hash(p);
      if (sample.wants(h)) sample.add({h, p, normal ? block.normals[i] : Vec3f(Vec3f::Zero())});
    }
    s.points += block.size();
  });
  const bool twins = sample.twins(), no_duplicates = sample.has_all() && !twins;
  const LargeVector<Sampled> places = sample.by_hash();
  s.sample.reserve(places.size());
  if (normals) s.sample_normals.reserve(places.size());
  for (const Sampled& x : places) {
    s.sample.push_back(x.position);
    if (normals) s.sample_normals.push_back(x.normal);
  }
  if (s.finite == 0)
    throw InputError(source.info().name, "points",
                     s.points == 0 ? "none" : std::to_string(s.points) + ", none of them finite",
                     "at least three points that are not in a line");
  if (!no_duplicates && (source.cloud() != nullptr || (twins && s.points <= kMostSought)))
    find_duplicates(source, s);
  else if (twins)
    context.warn(
        fmt::format("some points are duplicates; among more than {} they are not sought", kMostSought));
  s.share = static_cast<double>(s.sample.size()) / static_cast<double>(s.finite - s.duplicates);
  leave_out_strays(s);
  check_extent(s, source.info().name);
  return s;
}

/// Whether a flat sample fills an area rather than lines: its box-counting dimension, from cells of an eighth
/// of the extent down to a sixty-fourth or to eight points each.
bool fills_area(const Survey& survey, int axis) {
  constexpr double kPointsPerCell = 8, kFilled = 1.7;
  const auto occupied = [&](int cells) {
    const double edge = survey.extent() * (1.0 + 1e-9) / cells;
    KeyTable table;
    for (const Vec3& p : survey.sample) {
      const Vec3 at = (p - survey.low) / edge;
      table.insert(
          {static_cast<std::int32_t>(at[(axis + 1) % 3]), static_cast<std::int32_t>(at[(axis + 2) % 3]), 0});
    }
    return static_cast<double>(table.keys().size());
  };
  double coarse = occupied(8);
  for (int cells = 16; cells <= 64; cells *= 2) {
    const double fine = occupied(cells);
    if (cells > 16 && fine * kPointsPerCell > static_cast<double>(survey.sample.size())) break;
    if (std::log2(fine / coarse) < kFilled) return false;
    coarse = fine;
  }
  return true;
}

Space space_of(const Survey& survey, bool declared_2d) {
  Space space;
  const Vec3 extent = survey.high - survey.low;
  if (declared_2d) space.flat_axis = Vec3::UnitZ();
  for (int a = 2; a >= 0 && !space.is_2d(); --a)
    if (extent[a] == 0.0 && extent[(a + 1) % 3] > 0.0 && extent[(a + 2) % 3] > 0.0 && !fills_area(survey, a))
      space.flat_axis = Vec3::Unit(a);
  if (space.is_2d()) space.flat_at = space.flat_axis->dot(survey.low);
  return space;
}

double rounding_of(const Survey& survey) {
  constexpr std::size_t kLooked = 2000;
  constexpr double kLeast = 1e-5, kExact = 1e-3;  // of the extent; of a step
  const std::size_t every = survey.sample.size() / kLooked + 1;
  const auto comes_in = [&](double step) {
    for (std::size_t i = 0; i < survey.sample.size(); i += every) {
      const Vec3 steps = (survey.sample[i] - survey.sample.front()) / step;
      if ((steps - steps.array().round().matrix()).cwiseAbs().maxCoeff() > kExact) return false;
    }
    return true;
  };
  for (double power = std::pow(10.0, std::floor(std::log10(survey.extent()))); power > kLeast * survey.extent(); power /= 10.0)
    for (const double part : {1.0, 0.5, 0.25})
      if (comes_in(part * power)) return part * power;
  return 0.0;
}

}  // namespace unseen::planes
