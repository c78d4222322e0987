// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/statics/cone_contacts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cuboids/statics/contact_loads.h"

namespace unseen::cuboids {
namespace {

/// The component of each body, −1 for static ones; returns how many there are.
int number_components(std::span<const Body> bodies, std::span<const ContactPoint> contacts,
                      std::vector<int>& of_body) {
  std::vector<int> root(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) root[i] = static_cast<int>(i);
  const auto find = [&](int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const ContactPoint& c : contacts) {
    if (bodies[c.a].is_static || bodies[c.b].is_static) continue;
    const int a = find(c.a), b = find(c.b);
    root[std::max(a, b)] = std::min(a, b);
  }
  int count = 0;
  of_body.assign(bodies.size(), -1);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!bodies[i].is_static) of_body[i] = find(i) == static_cast<int>(i) ? count++ : of_body[find(i)];
  return count;
}

ConeContact cone_contact(std::span<const Body> bodies, const std::vector<int>& local, const ContactPoint& c,
                         double load, int index) {
  ConeContact k;
  k.normal = c.normal;
  k.friction = c.friction;
  k.index = index;
  double sum = 0;
  for (int side = 0; side < 2; ++side) {
    const int i = side == 0 ? c.a : c.b;
    const Body& body = bodies[i];
    if (body.is_static) continue;
    k.lever[side] = {local[i], (side == 0 ? -1.0 : 1.0) / body.weight,
                     (c.position - body.center) / body.half_size};
    sum += 1.0 / (body.weight * body.weight);
  }
  // At least about the weight of the lighter body.
  k.unit = std::max(load, 1.0 / std::sqrt(sum));
  for (Lever& l : k.lever) l.scale *= k.unit;
  return k;
}

}  // namespace

std::vector<Component> components_of(std::span<const Body> bodies, std::span<const ContactPoint> contacts) {
  std::vector<int> of_body, local(bodies.size(), -1);
  std::vector<Component> components(number_components(bodies, contacts, of_body));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (of_body[i] < 0) continue;
    if (!(bodies[i].weight > 0.0) || !(bodies[i].half_size > 0.0))
      throw std::invalid_argument("a body that is not static needs weight and size");
    local[i] = static_cast<int>(components[of_body[i]].bodies.size());
    components[of_body[i]].bodies.push_back(static_cast<int>(i));
  }
  const std::vector<double> loads = contact_loads(bodies, contacts);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const ContactPoint& p = contacts[c];
    if (p.a == p.b || (bodies[p.a].is_static && bodies[p.b].is_static)) continue;
    Component& component = components[std::max(of_body[p.a], of_body[p.b])];
    ConeContact k = cone_contact(bodies, local, p, loads[c], static_cast<int>(c));
    if (k.lever[0].body >= 0 && k.lever[1].body >= 0) {
      const std::pair<int, int> pair(k.lever[0].body, k.lever[1].body);
      if (component.pairs.empty() || component.pairs.back() != pair) component.pairs.push_back(pair);
      k.pair = static_cast<int>(component.pairs.size()) - 1;
    }
    component.contacts.push_back(k);
  }
  return components;
}

}  // namespace unseen::cuboids
