// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/result/rings.h"

namespace unseen::planes {

bool Rings::contains(const Vec2& p) const {
  if (!box.contains(p)) return false;
  bool inside = false;
  for (const std::vector<Vec2>& ring : rings)
    for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++)
      if ((ring[i].y() > p.y()) != (ring[k].y() > p.y()) && p.x() < ring[i].x() + (ring[k].x() - ring[i].x()) * (p.y() - ring[i].y()) / (ring[k].y() - ring[i].y()))
        inside = !inside;
  return inside;
}

std::vector<Vec2> Rings::samples() const {
  constexpr int kAlong = 16;
  std::vector<Vec2> inside;
  for (int i = 0; i < kAlong * kAlong && !box.isEmpty(); ++i) {
    const Vec2 share((i % kAlong + 0.5) / kAlong, (i / kAlong + 0.5) / kAlong), at = box.min() + share.cwiseProduct(box.sizes());
    if (contains(at)) inside.push_back(at);
  }
  return inside;
}

Rings rings_of(const ArrangedPlane& plane, const Vec3& u, const Vec3& v) {
  Rings r;
  for (const std::vector<Vec3>& ring : plane.polygon) {
    r.rings.emplace_back();
    for (const Vec3& c : ring) r.rings.back().emplace_back(u.dot(c), v.dot(c));
  }
  if (plane.segment) {
    const double a = u.dot((*plane.segment)[0]), b = u.dot((*plane.segment)[1]);
    r.rings = {{{a, -1.0}, {b, -1.0}, {b, 1.0}, {a, 1.0}}};
  }
  for (const std::vector<Vec2>& ring : r.rings)
    for (const Vec2& c : ring) r.box.extend(c);
  return r;
}

}  // namespace unseen::planes
