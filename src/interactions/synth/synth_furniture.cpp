// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/synth/synth_furniture.h"

#include <fmt/format.h>

namespace unseen::interactions {
namespace {

// Sizes are drawn in braces: unlike arguments in parentheses they come in this order with every compiler.

/// Adds a box between two corners; the second part of a name becomes NAME-1, as in the i3DB scenes.
void add(Object& object, const std::string& name, const Vec3& low, const Vec3& high) {
  int same = 0;
  for (const Part& part : object.parts) same += part.name == name || part.name.rfind(name + "-", 0) == 0;
  object.parts.push_back({same > 0 ? fmt::format("{}-{}", name, same) : name, {0.5 * (low + high), Mat3::Identity(), 0.5 * (high - low)}});
}

void add_legs(Object& object, const Vec2& half, double top, double thick) {
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      const Vec2 c(x * (half.x() - 0.5 * thick), y * (half.y() - 0.5 * thick));
      add(object, "leg", Vec3(c.x() - 0.5 * thick, c.y() - 0.5 * thick, 0), Vec3(c.x() + 0.5 * thick, c.y() + 0.5 * thick, top));
    }
}

Piece chair(Random& random, bool stool) {
  Piece p;
  p.object.category = stool ? "stool" : "chair";
  p.half = stool ? Vec2::Constant(random.uniform(0.17, 0.23)) : Vec2{random.uniform(0.21, 0.26), random.uniform(0.22, 0.26)};
  p.surface = stool ? random.uniform(0.42, 0.50) : random.uniform(0.43, 0.48);
  p.edge = p.half.y();
  p.depth = 2.0 * p.half.y();
  p.rest = !stool;
  add(p.object, "seat", Vec3(-p.half.x(), -p.half.y(), p.surface - 0.05), Vec3(p.half.x(), p.half.y(), p.surface));
  add_legs(p.object, p.half, p.surface - 0.05, 0.04);
  p.height = p.surface;
  if (stool) return p;
  p.height += random.uniform(0.38, 0.52);
  p.depth -= 0.05;
  add(p.object, "back", Vec3(-p.half.x(), -p.half.y(), p.surface), Vec3(p.half.x(), -p.half.y() + 0.05, p.height));
  if (random.uniform() < 0.3) {  // armrests stand beside the seat
    const double y = 0.6 * p.half.y(), z = p.surface + random.uniform(0.18, 0.24), x = p.half.x() + 0.05;
    for (const double side : {-1.0, 1.0})
      add(p.object, "arm", Vec3(std::min(side * x, side * p.half.x()), -p.half.y(), z - 0.04), Vec3(std::max(side * x, side * p.half.x()), y, z));
    p.half.x() = x;
  }
  return p;
}

Piece couch(Random& random, bool armchair) {
  Piece p;
  p.object.category = "couch";
  const double arm = random.uniform(0.12, 0.22), back = random.uniform(0.15, 0.24);
  p.half = Vec2{0.5 * (armchair ? random.uniform(0.52, 0.62) : random.uniform(1.2, 2.0)) + arm, 0.5 * (random.uniform(0.54, 0.64) + back)};
  p.surface = random.uniform(0.38, 0.45);
  p.height = random.uniform(0.72, 0.92);
  p.edge = p.half.y();
  p.depth = 2.0 * p.half.y() - back;
  p.room = p.half.x() - arm - 0.26;
  p.soft = p.rest = true;
  const double x = p.half.x() - arm, y = -p.half.y() + back, armrest = p.surface + random.uniform(0.14, 0.24);
  add(p.object, "seat", Vec3(-x, y, 0), Vec3(x, p.half.y(), p.surface));
  add(p.object, "back", Vec3(-p.half.x(), -p.half.y(), 0), Vec3(p.half.x(), y, p.height));
  add(p.object, "arm", Vec3(-p.half.x(), y, 0), Vec3(-x, p.half.y(), armrest));
  add(p.object, "arm", Vec3(x, y, 0), Vec3(p.half.x(), p.half.y(), armrest));
  return p;
}

/// One sits on a long side; the head is at −x.
Piece bed(Random& random) {
  Piece p;
  p.object.category = "bed";
  p.half = Vec2{0.5 * random.uniform(2.0, 2.15), 0.5 * random.uniform(0.9, 1.6)};
  p.surface = random.uniform(0.42, 0.55);
  p.height = p.surface + random.uniform(0.25, 0.5);
  p.edge = p.half.y();
  p.depth = 2.0 * p.half.y();
  p.room = 0.25;
  p.soft = true;
  add(p.object, "seat", Vec3(-p.half.x() + 0.06, -p.half.y(), 0.18), Vec3(p.half.x(), p.half.y(), p.surface));
  add(p.object, "back", Vec3(-p.half.x(), -p.half.y(), 0), Vec3(-p.half.x() + 0.06, p.half.y(), p.height));
  add_legs(p.object, p.half, 0.18, 0.07);
  return p;
}

Piece table(Random& random, Kind kind) {
  Piece p;
  const bool low = kind == Kind::coffee_table, desk = kind == Kind::desk;
  p.object.category = desk ? "desk" : "table";
  p.half = low    ? Vec2{random.uniform(0.42, 0.62), random.uniform(0.25, 0.35)}
           : desk ? Vec2{random.uniform(0.6, 0.8), random.uniform(0.3, 0.4)}
                  : Vec2{random.uniform(0.55, 0.9), random.uniform(0.37, 0.46)};
  p.surface = p.height = low ? random.uniform(0.38, 0.50) : random.uniform(0.71, 0.77);
  p.edge = p.half.y();
  p.depth = 2.0 * p.half.y();
  p.room = p.half.x() - 0.25;
  const double under = p.surface - 0.04;
  add(p.object, "top", Vec3(-p.half.x(), -p.half.y(), under), Vec3(p.half.x(), p.half.y(), p.surface));
  if (desk && random.uniform() < 0.5) {  // drawers on one side
    const double width = random.uniform(0.3, 0.4), x = random.uniform() < 0.5 ? -p.half.x() : p.half.x() - width;
    add(p.object, "bottom", Vec3(x, -p.half.y(), 0), Vec3(x + width, p.half.y() - 0.05, under));
  }
  add_legs(p.object, p.half, under, 0.05);
  return p;
}

/// Compartments stand on each other; one reaches to their front.
Piece shelf(Random& random, bool sideboard) {
  Piece p;
  p.object.category = "shelf";
  p.half = Vec2{0.5 * random.uniform(sideboard ? 0.9 : 0.7, sideboard ? 1.5 : 1.2), 0.5 * random.uniform(0.28, 0.42)};
  p.edge = p.half.y();
  p.room = p.half.x() - 0.2;
  double z = sideboard ? random.uniform(0.1, 0.4) : random.uniform(0.3, 0.95);
  add(p.object, "bottom", Vec3(-p.half.x(), -p.half.y(), 0), Vec3(p.half.x(), p.half.y(), z));
  for (const double top = sideboard ? random.uniform(0.75, 1.1) : random.uniform(1.5, 2.15); z < top - 0.2;) {
    const double next = std::min(top, z + random.uniform(0.28, 0.45));
    add(p.object, "shelf", Vec3(-p.half.x(), -p.half.y(), z), Vec3(p.half.x(), p.half.y(), next));
    p.levels.push_back({z, next});
    z = next;
  }
  p.height = p.surface = z;
  return p;
}

}  // namespace

Piece draw_piece(Kind kind, Random& random) {
  switch (kind) {
    case Kind::chair: return chair(random, false);
    case Kind::stool: return chair(random, true);
    case Kind::couch: return couch(random, false);
    case Kind::armchair: return couch(random, true);
    case Kind::bed: return bed(random);
    case Kind::shelf: return shelf(random, false);
    case Kind::sideboard: return shelf(random, true);
    default: return table(random, kind);
  }
}

Piece placed(Piece piece, const Placement& placement) {
  piece.object = placement * piece.object;
  piece.placement = placement;
  return piece;
}

Piece from_side(Piece piece, int quarter) {
  piece.placement.angle += quarter * 0.5 * kPi;
  if (quarter % 2 != 0) std::swap(piece.half.x(), piece.half.y());
  piece.edge = piece.half.y();
  piece.depth = 2.0 * piece.half.y();
  piece.room = std::max(0.05, piece.half.x() - 0.25);
  return piece;
}

}  // namespace unseen::interactions
