// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A cloud in memory → planes with exact angles between them. Usage: 01_planes
#include <unseen/planes/planes.h>

#include <cstdio>
#include <random>

int main() {
  // A floor and two walls, each a little off and with 2 mm of noise.
  unseen::PointCloud cloud;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> side(0.0, 3.0);
  std::normal_distribution<double> noise(0.0, 0.002);
  for (int i = 0; i < 20000; ++i) {
    const double a = side(random), b = side(random), c = noise(random);
    cloud.positions.emplace_back(a, b, 0.003 * a + c);
    cloud.positions.emplace_back(c - 0.002 * b, a, b);
    cloud.positions.emplace_back(a, c + 0.004 * a, b);
  }

  unseen::planes::Options options;
  options.scale = 0.05;  // m; leave it unset to have it estimated
  unseen::Context context;
  unseen::CloudSource source(cloud);
  const unseen::planes::Arrangement found = unseen::planes::find_planes(source, options, context);

  for (const unseen::planes::ArrangedPlane& p : found.planes)
    std::printf("%-10s normal %8.5f %8.5f %8.5f  offset %8.5f m  %zu points\n", p.tag.c_str(), p.plane.normal.x(),
                p.plane.normal.y(), p.plane.normal.z(), p.plane.offset, p.points);
  for (const unseen::planes::Relation& r : found.relations)
    std::printf("directions %d and %d at %g degrees\n", r.a, r.b, unseen::degrees(r.angle));
  return found.summary.status == unseen::Status::solved ? 0 : 1;
}
