// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/synth/synth_contact.h"

#include <algorithm>

#include "core/linear.h"

namespace unseen::collision {
namespace {

constexpr double kLeastSlope = 0.15;  // sine: a corner's edges leave the contact plane by that much

/// A rotation that takes `from` to `to` and is otherwise free.
Quat turned(const Vec3& from, const Vec3& to, double angle) {
  return Quat(Eigen::AngleAxisd(angle, to)) * turn_between(from, to);
}

Vec3 show_face(const SynthBody& body, const Vec3& direction, Random& random, Quat& q) {
  const auto& face = body.faces[random.index(body.faces.size())];
  q = turned(face.normal, direction, random.uniform(0, 2 * kPi));
  Vec3 middle = Vec3::Zero();
  for (const int v : face.corners) middle += body.vertices[v] / static_cast<double>(face.corners.size());
  const auto corner = [&] { return body.vertices[face.corners[random.index(face.corners.size())]]; };
  const Vec3 one = corner(), other = corner();
  const double mix = random.uniform();
  const Vec3 point = middle + random.uniform(0, 0.9) * (mix * one + (1 - mix) * other - middle);
  return -(q * point);
}

/// The edge runs at `azimuth` about the direction.
Vec3 show_edge(const SynthBody& body, const Vec3& direction, double azimuth, Random& random, Quat& q) {
  const auto& edge = body.edges[random.index(body.edges.size())];
  const double mix = random.uniform(0.3, 0.7);
  const Vec3 outwards = (mix * edge.normals[0] + (1 - mix) * edge.normals[1]).normalized();
  const Vec3 from = body.vertices[edge.from], along = body.vertices[edge.to] - from;
  const Quat start = turn_between(outwards, direction);
  const Vec3 zero = any_orthogonal(direction), now = start * along.normalized();
  const double angle = std::atan2(direction.dot(zero.cross(now)), zero.dot(now));
  q = Quat(Eigen::AngleAxisd(azimuth - angle, direction)) * start;
  return -(q * (from + random.uniform(0.15, 0.85) * along));
}

}  // namespace

Vec3 show_corner(const SynthBody& body, const Vec3& direction, Random& random, Quat& q) {
  for (;;) {
    q = turned(Vec3::UnitZ(), random.direction(), random.uniform(0, 2 * kPi));
    if (body.sphere()) return -body.radius * direction;
    const Vec3 local = q.conjugate() * direction;
    const auto corner = std::max_element(body.vertices.begin(), body.vertices.end(),
                                         [&](const Vec3& v, const Vec3& w) { return local.dot(v) < local.dot(w); });
    const bool sharp = std::all_of(body.vertices.begin(), body.vertices.end(), [&](const Vec3& v) {
      return &v == &*corner || local.dot(*corner - v) > kLeastSlope * (*corner - v).norm();
    });
    if (sharp) return -(q * *corner);
  }
}

std::array<Vec3, 2> touch(const SynthBody& a, const SynthBody& b, const Vec3& normal, Random& random, Quat& qa, Quat& qb) {
  const double kind = random.uniform(), azimuth = random.uniform(0, 2 * kPi);
  if (a.sphere() || b.sphere()) {
    const auto show = [&](const SynthBody& body, const Vec3& direction, Quat& q) {
      if (body.sphere()) return show_corner(body, direction, random, q);
      return kind < 0.7 ? show_face(body, direction, random, q) : show_edge(body, direction, azimuth, random, q);
    };
    const Vec3 of_a = show(a, -normal, qa);
    return {of_a, show(b, normal, qb)};
  }
  if (kind < 0.35) {
    const Vec3 of_a = show_edge(a, -normal, azimuth, random, qa);
    // b's edges are told about −(−normal): azimuths there run the other way, from another zero
    const Vec3 along = Eigen::AngleAxisd(azimuth + random.uniform(0.7, kPi - 0.7), -normal) * any_orthogonal(-normal);
    const Vec3 zero = any_orthogonal(normal);
    return {of_a, show_edge(b, normal, std::atan2(normal.dot(zero.cross(along)), zero.dot(along)), random, qb)};
  }
  const bool a_is_sharp = kind < 0.7;
  const Vec3 of_a = a_is_sharp ? show_corner(a, -normal, random, qa) : show_face(a, -normal, random, qa);
  return {of_a, a_is_sharp ? show_face(b, normal, random, qb) : show_corner(b, normal, random, qb)};
}

}  // namespace unseen::collision
