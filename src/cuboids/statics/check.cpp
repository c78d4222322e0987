// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/linear.h"
#include "cuboids/statics/convex_parts.h"
#include "cuboids/statics/interface.h"
#include "cuboids/statics/statics.h"
#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

constexpr double kStable = 1e-6;
constexpr double kTolerance = 1e-4;  // of the smaller block's radius: files hold single precision
constexpr double kGravity = 9.81;    // m/s²
constexpr double kOverlap = 0.02;    // of the smaller block's radius: worth a warning

struct Piece {
  std::vector<ConvexSolid> parts;
  Body body;
  Vec3 middle;  ///< of a sphere around it
  double radius = 0;
};

Piece piece_of(const Block& block, const Mat3& turn) {
  TriangleMesh mesh = block.mesh;
  for (Vec3& v : mesh.vertices) v = turn * v;
  Piece piece;
  try {
    piece.parts = convex_parts(mesh);
  } catch (const std::invalid_argument& e) {
    throw InputError("assembly", "block " + block.name, e.what(), "a closed solid");
  }
  const MassCenter whole = mass_center(mesh);
  if (!(block.density > 0.0) || !std::isfinite(block.density))
    throw InputError("assembly", "block " + block.name, fmt::format("density {}", block.density), "a positive one");
  piece.body.weight = std::abs(whole.volume) * block.density * kGravity;
  piece.body.center = whole.center;
  piece.middle = piece.parts.front().center;
  for (const ConvexSolid& part : piece.parts)
    for (const Vec3& v : part.vertices) {
      piece.body.half_size = std::max(piece.body.half_size, (v - whole.center).norm());
      piece.radius = std::max(piece.radius, (v - piece.middle).norm());
    }
  return piece;
}

std::vector<Piece> pieces_of(const std::vector<Block>& blocks, const CheckOptions& options, const Mat3& turn,
                             const Context& context) {
  std::vector<Piece> pieces;
  for (const Block& block : blocks) {
    context.check();
    pieces.push_back(piece_of(block, turn));
  }
  for (const std::string& name : options.supports) {
    const auto at = std::find_if(blocks.begin(), blocks.end(), [&](const Block& b) { return b.name == name; });
    if (at == blocks.end()) {
      std::string names;
      for (std::size_t i = 0; i < std::min<std::size_t>(blocks.size(), 20); ++i)
        names += (i == 0 ? "" : ", ") + blocks[i].name;
      throw InputError("support", "", name, "the name of a block: " + names);
    }
    pieces[at - blocks.begin()].body.is_static = true;
  }
  return pieces;
}

/// The contacts of two blocks, with a support first.
void add_contacts(const std::vector<Block>& blocks, const std::vector<Piece>& pieces, int a, int b, Context& context,
                  std::vector<Contact>& contacts) {
  if (pieces[b].body.is_static) std::swap(a, b);
  const Piece &from = pieces[a], &to = pieces[b];
  const double smaller = std::min(from.radius, to.radius), tolerance = kTolerance * smaller;
  if (to.body.is_static || (from.middle - to.middle).norm() > from.radius + to.radius + tolerance) return;
  double gap = 0.0;
  for (const ConvexSolid& part : from.parts)
    for (const ConvexSolid& other : to.parts)
      if (const auto met = interface_of(part, other, tolerance)) {
        gap = std::min(gap, met->gap);
        contacts.push_back({a, b, ContactKind::touching, met->normal, met->points, {}});
      }
  if (gap < -kOverlap * smaller)
    context.warn(fmt::format("blocks {} and {} overlap by {:.3g}", blocks[a].name, blocks[b].name, -gap));
}

Mat3 turn_to_z(const Vec3& up) {
  return turn_between(up, Vec3::UnitZ()).toRotationMatrix();
}

void require(bool holds, const char* option, const std::string& found, const char* expected) {
  if (!holds) throw InputError(option, "", found, expected);
}

}  // namespace

Check check_assembly(const std::vector<Block>& blocks, const CheckOptions& options, Context& context) {
  require(!blocks.empty(), "assembly", "no block", "one or more");
  require(options.up.allFinite() && options.up.norm() > 1e-9, "up",
          fmt::format("{} {} {}", options.up.x(), options.up.y(), options.up.z()), "a direction");
  require(options.friction >= 0.0 && options.friction <= 10.0, "mu", fmt::format("{}", options.friction),
          "a number in [0, 10]");
  const Mat3 turn = turn_to_z(options.up.normalized());
  const std::vector<Piece> pieces = pieces_of(blocks, options, turn, context);
  std::vector<Body> bodies;
  for (const Piece& piece : pieces) bodies.push_back(piece.body);

  Check check;
  for (int a = 0; a < static_cast<int>(pieces.size()); ++a) {
    context.check();
    for (int b = a + 1; b < static_cast<int>(pieces.size()); ++b)
      add_contacts(blocks, pieces, a, b, context, check.contacts);
  }
  std::vector<ContactPoint> points;
  for (const Contact& c : check.contacts)
    for (const Vec3& p : c.points) points.push_back({c.a, c.b, p, c.direction, options.friction});

  const Balance best = balance(bodies, points, -Vec3::UnitZ(), {}, {}, context);
  check.stability.residual = best.residual;
  check.stability.stable = best.residual < kStable;
  check.stability.margin = margin(bodies, points, kStable, 1.0, context);
  check.stability.friction_needed = friction_needed(bodies, points, kStable, context);

  std::size_t next = 0;
  for (Contact& c : check.contacts) {
    c.direction = turn.transpose() * c.direction;
    for (Vec3& p : c.points) {
      c.forces.push_back(turn.transpose() * best.forces[next++]);
      p = turn.transpose() * p;
    }
  }
  double fastest = 0.0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    check.velocity.push_back(turn.transpose() * best.velocity(static_cast<int>(i), bodies[i]));
    check.angular_velocity.push_back(turn.transpose() * best.angular_velocity(static_cast<int>(i), bodies[i]));
    fastest = std::max({fastest, check.velocity[i].norm(), check.angular_velocity[i].norm() * bodies[i].half_size});
  }
  const double factor = check.stability.stable || fastest == 0.0 ? 0.0 : 1.0 / fastest;
  for (Vec3& v : check.velocity) v *= factor;
  for (Vec3& w : check.angular_velocity) w *= factor;
  return check;
}

}  // namespace unseen::cuboids
