// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/synth/synth_builder.h"

namespace unseen::planes {
namespace {

constexpr double kLength = 24, kWidth = 14, kStorey = 3.2, kHeight = 2.8;  // m
constexpr double kCorridorLow = 6, kCorridorHigh = 8, kRoom = 6;

/// Furniture of one room whose corner is (x, y): a wardrobe and a table, or in one room of each storey both
/// turned.
void furnish(SynthBuilder& b, double x, double y, double z, double turn, int frame) {
  const bool turned = frame > 0;
  b.add_box({-0.9, -0.3, 0}, {0.9, 0.3, 2.0}, upright_pose({x + 1.6, y + 1.4, z}, turn), frame, turned);
  b.add_box({-0.8, -0.5, 0}, {0.8, 0.5, 0.75}, upright_pose({x + 3.9, y + 3.6, z}, turn), frame, turned);
  b.add_box({-0.3, -0.3, 0}, {0.3, 0.3, 0.45}, upright_pose({x + 4.8, y + 1.3, z}, turn), frame, turned);
}

/// Twelve steps along x, in the room with corner (x, y).
void add_stairs(SynthBuilder& b, double x, double y, double z) {
  constexpr int kSteps = 12;
  constexpr double kTread = 0.28, kRise = 0.18, kAcross = 1.6;
  const double y0 = y + 3.6, y1 = y0 + kAcross;
  for (int k = 0; k < kSteps; ++k) {
    const double s = x + 1.0 + k * kTread, low = z + k * kRise, high = low + kRise;
    b.add_polygon({{s, y0, low}, {s, y1, low}, {s, y1, high}, {s, y0, high}}, 0);
    b.add_polygon({{s, y0, high}, {s + kTread, y0, high}, {s + kTread, y1, high}, {s, y1, high}}, 0);
  }
}

void add_storey(SynthBuilder& b, int storey, const SynthOptions& options, int turned_frame) {
  const double low = storey * kStorey, high = low + kHeight;
  const auto slab = [&](double z) {
    b.add_polygon({{0, 0, z}, {kLength, 0, z}, {kLength, kWidth, z}, {0, kWidth, z}}, 0);
  };
  slab(low);
  slab(high);
  const std::vector<Vec2> corners = {{0, 0}, {kLength, 0}, {kLength, kWidth}, {0, kWidth}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 &p = corners[i], &q = corners[(i + 1) % 4];
    b.add_polygon({{p.x(), p.y(), low}, {q.x(), q.y(), low}, {q.x(), q.y(), high}, {p.x(), p.y(), high}}, 0);
  }
  for (int k = 0; k < 4; ++k) {
    const double x = k * kRoom;
    b.add_wall({x, kCorridorLow}, {x + kRoom, kCorridorLow}, low, high, 0.12, 2.4);
    b.add_wall({x, kCorridorHigh}, {x + kRoom, kCorridorHigh}, low, high, 0.12, 3.0);
    if (k > 0) {
      b.add_wall({x, 0}, {x, kCorridorLow - 0.06}, low, high, 0.2, -1);
      b.add_wall({x, kCorridorHigh + 0.06}, {x, kWidth}, low, high, 0.2, -1);
    }
    for (const double y : {0.0, kCorridorHigh}) {
      const bool stairs = k == 0 && y > 0, turned = turned_frame > 0 && k == (storey + 1) % 4 && y == 0.0;
      if (stairs)
        add_stairs(b, x, y, low);
      else
        furnish(b, x, y, low, turned ? radians(options.turn) : 0.0, turned ? turned_frame : 0);
      b.add_scanner({x + 2.9, y + 2.7, low + 1.65});
    }
  }
  b.add_scanner({kLength / 4, 7, low + 1.65});
  b.add_scanner({3 * kLength / 4, 7, low + 1.65});
}

}  // namespace

/// Storeys of 24 m × 14 m: a corridor, eight rooms with furniture, one with stairs; ten scanner positions
/// each.
SynthModel make_building(const SynthOptions& options) {
  SynthBuilder b(radians(options.yaw));
  const int turned =
      options.share > 0 ? b.add_frame(upright_pose(Vec3::Zero(), radians(options.turn)).rotation) : 0;
  for (int storey = 0; storey < options.floors; ++storey) add_storey(b, storey, options, turned);
  return b.take();
}

}  // namespace unseen::planes
