// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "unseen/planes/types.h"

namespace unseen::planes::test {

/// Every number of a result, bit by bit (times excepted), as one list that can be compared.
class Digest {
 public:
  explicit Digest(const Arrangement& a) {
    *this << a.two_dimensional << a.scale << a.lambda << a.planes.size();
    for (const double angle : a.angles) *this << angle;
    for (const ArrangedPlane& p : a.planes) {
      *this << p.plane.normal << p.plane.offset << p.direction << p.frame << p.area << p.points << p.rms
            << p.tag.size();
      for (const char c : p.tag) *this << c;
      for (const auto& ring : p.polygon) {
        *this << ring.size();
        for (const Vec3& corner : ring) *this << corner;
      }
      if (p.segment) *this << (*p.segment)[0] << (*p.segment)[1];
    }
    for (const Direction& d : a.directions) *this << d.normal << d.frame;
    for (const Frame& f : a.frames) *this << f.directions << f.planes;
    for (const Relation& r : a.relations) *this << r.a << r.b << r.angle;
    *this << a.plane_relations << a.coplanar.size();
    for (const auto& c : a.coplanar) *this << c;
    for (const Spacing& s : a.spacing) *this << s.planes << s.step << s.rms;
    for (const Distance& d : a.distances) *this << d.a << d.b << d.distance;
    for (const EqualLength& e : a.equal_lengths) *this << e.planes << e.length << e.rms;
    for (const auto& [name, value] : a.summary.energy) *this << value;
    for (const auto& [name, value] : a.summary.counts) *this << value;
    *this << static_cast<int>(a.summary.status) << a.summary.warnings.size();
  }
  bool operator==(const Digest&) const = default;
  std::size_t size() const { return words_.size(); }
  /// Where two results part; for messages.
  std::size_t first_difference(const Digest& o) const {
    std::size_t i = 0;
    while (i < std::min(words_.size(), o.words_.size()) && words_[i] == o.words_[i]) ++i;
    return i;
  }

 private:
  Digest& operator<<(double v) {
    words_.push_back(std::bit_cast<std::uint64_t>(v));
    return *this;
  }
  template <class T>
  requires std::is_integral_v<T> Digest& operator<<(T v) {
    words_.push_back(static_cast<std::uint64_t>(v));
    return *this;
  }
  Digest& operator<<(const Vec3& v) { return *this << v.x() << v.y() << v.z(); }
  Digest& operator<<(const std::vector<int>& list) {
    *this << list.size();
    for (const int i : list) *this << i;
    return *this;
  }

  std::vector<std::uint64_t> words_;
};

}  // namespace unseen::planes::test
