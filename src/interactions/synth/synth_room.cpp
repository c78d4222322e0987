// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/synth/synth_room.h"

#include <algorithm>

namespace unseen::interactions {
namespace {

constexpr double kAisle = 0.75;  // m, between pieces that do not belong together

/// Footprints as rectangles: clear of each other by `gap`, tested with a grid of points on the outline of each.
bool apart(const Piece& a, const Piece& b, double gap) {
  for (const auto& [p, q] : {std::pair(&a, &b), std::pair(&b, &a)})
    for (int i = 0; i <= 8; ++i)
      for (int j = 0; j <= 8; ++j) {
        const Vec3 at = p->placement * Vec3((i / 4.0 - 1.0) * p->half.x(), (j / 4.0 - 1.0) * p->half.y(), 0);
        if (ground_distance(*q, at.head<2>()) < gap) return false;
      }
  return true;
}

bool inside(const Floor& floor, const Piece& piece) {
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      if (!floor.contains((piece.placement * Vec3(x * piece.half.x(), y * piece.half.y(), 0)).head<2>(), 0.0)) return false;
  const Vec3 front = piece.placement * Vec3(0, piece.edge + 0.45, 0);  // where people stand
  return floor.contains(front.head<2>(), 0.1);
}

bool fits(const Room& room, const Piece& piece, const Piece* companion) {
  if (!inside(room.floor, piece)) return false;
  for (const Piece& other : room.pieces)
    if (&other != companion && !apart(piece, other, kAisle)) return false;
  return true;
}

Placement draw_placement(const Floor& floor, const Piece& piece, bool wall, Random& random) {
  if (!wall) return {{random.uniform(floor.left, floor.right), random.uniform(floor.near, floor.far), 0}, random.uniform(-kPi, kPi)};
  const double off = piece.half.y() + random.uniform(0.02, 0.08);
  const int side = static_cast<int>(random.index(4));  // left, right, and twice the far wall, which is longest
  if (side == 0) return {{floor.left + off, random.uniform(floor.near, floor.far), 0}, -kPi / 2};
  if (side == 1) return {{floor.right - off, random.uniform(floor.near, floor.far), 0}, kPi / 2};
  return {{random.uniform(floor.left, floor.right), floor.far - off, 0}, kPi};
}

bool at_wall(Kind kind, Random& random) {
  switch (kind) {
    case Kind::shelf: case Kind::sideboard: return true;
    case Kind::couch: case Kind::bed: case Kind::desk: return random.uniform() < 0.5;
    case Kind::armchair: return random.uniform() < 0.3;
    default: return random.uniform() < 0.15;
  }
}

/// A desk at a wall has its chair in front, so it fits only with the place for it.
bool add_piece(Room& room, Kind kind, Random& random) {
  for (int attempt = 0; attempt < 100; ++attempt) {
    Piece piece = draw_piece(kind, random);
    const bool wall = at_wall(kind, random);
    piece = placed(piece, draw_placement(room.floor, piece, wall, random));
    if (!fits(room, piece, nullptr)) continue;
    room.pieces.push_back(std::move(piece));
    return true;
  }
  return false;
}

/// A seat in front of a table, with just enough room to step in between.
bool add_seat_at(Room& room, int table, Kind kind, Random& random) {
  for (int attempt = 0; attempt < 30; ++attempt) {
    const Piece& at = room.pieces[static_cast<std::size_t>(table)];
    Piece seat = draw_piece(kind, random);
    const double gap = random.uniform(0.22, 0.32), along = random.uniform(-0.6, 0.6) * at.room;
    seat = placed(seat, at.placement * Placement{{along, at.half.y() + gap + seat.edge, 0}, kPi + random.uniform(-0.06, 0.06)});
    seat.table = table;
    if (!fits(room, seat, &at)) continue;
    room.pieces.push_back(std::move(seat));
    return true;
  }
  return false;
}

/// A low table in front of a couch.
bool add_coffee_table(Room& room, int couch, Random& random) {
  for (int attempt = 0; attempt < 30; ++attempt) {
    const Piece& at = room.pieces[static_cast<std::size_t>(couch)];
    Piece table = draw_piece(Kind::coffee_table, random);
    const double gap = random.uniform(0.38, 0.5), along = random.uniform(-0.5, 0.5) * at.room;
    table = placed(table, at.placement * Placement{{along, at.edge + gap + table.half.y(), 0}, kPi + random.uniform(-0.08, 0.08)});
    if (!fits(room, table, &at)) continue;
    const int index = static_cast<int>(room.pieces.size());
    room.pieces.push_back(std::move(table));
    room.pieces[static_cast<std::size_t>(couch)].table = index;
    return true;
  }
  return false;
}

/// One piece, or several that belong together; never more than `most`.
void add_group(Room& room, int most, Random& random) {
  constexpr Kind kinds[] = {Kind::couch, Kind::couch, Kind::armchair, Kind::desk, Kind::desk, Kind::dining_table, Kind::dining_table,
                            Kind::shelf, Kind::shelf, Kind::shelf, Kind::sideboard, Kind::bed, Kind::bed, Kind::bed, Kind::bed, Kind::bed, Kind::stool, Kind::stool,
                            Kind::chair, Kind::chair, Kind::coffee_table};
  const Kind kind = kinds[random.index(std::size(kinds))];
  const int index = static_cast<int>(room.pieces.size());
  if (!add_piece(room, kind, random) || most < 2) return;
  const double chance = random.uniform();
  const Kind seat = random.uniform() < 0.75 ? Kind::chair : Kind::stool;
  if (kind == Kind::desk && chance < 0.85) add_seat_at(room, index, seat, random);
  if (kind == Kind::dining_table && chance < 0.7) add_seat_at(room, index, seat, random);
  if ((kind == Kind::couch || kind == Kind::armchair) && chance < 0.45) add_coffee_table(room, index, random);
}

/// How much pieces stand before each other as the camera sees them: shares of the width of the farther one.
double hiding(const Room& room) {
  std::vector<std::array<double, 3>> spans;  // azimuth from, to, and distance
  for (const Piece& piece : room.pieces) {
    std::array<double, 3> span = {kPi, -kPi, piece.placement.position.norm()};
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0}) {
        const Vec3 corner = piece.placement * Vec3(x * piece.half.x(), y * piece.half.y(), 0);
        const double azimuth = std::atan2(corner.x(), corner.y());
        span = {std::min(span[0], azimuth), std::max(span[1], azimuth), span[2]};
      }
    spans.push_back(span);
  }
  double sum = 0;
  for (const auto& near : spans)
    for (const auto& far : spans)
      if (near[2] < far[2]) sum += std::max(0.0, std::min(near[1], far[1]) - std::max(near[0], far[0])) / (far[1] - far[0]);
  return sum;
}

}  // namespace

View draw_view(int width, int height, Random& random) {
  View v;
  const double focal = 0.5 * width / std::tan(0.5 * radians(random.uniform(50.0, 64.0)));
  v.camera = {focal, focal, 0.5 * (width - 1), 0.5 * (height - 1), width, height};
  const double up = random.uniform(0.8, 1.8);
  // aimed at the middle of people some 5 m away, by hand
  const double pitch = std::clamp(std::atan2(up - 0.9, 5.0) + radians(1.5) * random.normal(), 0.0, radians(10.0));
  const double c = std::cos(pitch), s = std::sin(pitch);
  v.T_world_camera.rotation << 1, 0, 0, 0, -s, c, 0, -c, -s;
  v.T_world_camera.translation = Vec3(0, 0, up);
  return v;
}

bool Floor::contains(const Vec2& p, double margin) const {
  return p.x() >= left + margin && p.x() <= right - margin && p.y() >= near + margin && p.y() <= far - margin &&
         std::abs(p.x()) <= slope * p.y() - margin;
}

double ground_distance(const Piece& piece, const Vec2& p) {
  const Vec3 own = piece.placement.inverse() * Vec3(p.x(), p.y(), 0);
  return (own.head<2>().cwiseAbs() - piece.half).cwiseMax(0.0).norm();
}

Room draw_room(const View& view, int pieces, Random& random) {
  Room best;
  int complete = 0;
  for (int attempt = 0; attempt < 40 && complete < 3; ++attempt) {
    Room room;
    const double grow = 0.25 * std::max(0, pieces - 3) + 0.1 * attempt / 4, width = random.uniform(4.0, 5.5) + grow;
    room.floor = {-0.5 * width, 0.5 * width, random.uniform(2.4, 3.0), 0, 0.92 * 0.5 * view.camera.width / view.camera.fx};
    room.floor.far = room.floor.near + random.uniform(3.2, 4.5) + grow;
    for (int g = 0; g < 4 * pieces && static_cast<int>(room.pieces.size()) < pieces; ++g)
      add_group(room, pieces - static_cast<int>(room.pieces.size()), random);
    complete += static_cast<int>(room.pieces.size()) == pieces;
    const auto order = [](const Room& r) { return std::pair(r.pieces.size(), hiding(r)); };
    if (order(room) > order(best)) best = std::move(room);
  }
  for (std::size_t i = 0; i < best.pieces.size(); ++i) best.pieces[i].object.id = static_cast<int>(i);
  for (Piece& piece : best.pieces) piece.idle = pieces > 2 && random.uniform() < 0.12;
  return best;
}

}  // namespace unseen::interactions
