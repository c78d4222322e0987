// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/body_mesh.h"

#include "collision/solve/mass_properties.h"

namespace unseen::collision {
namespace {

TriangleMesh box_mesh(const Vec3& edges) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)  // bit 0 is x, bit 1 y, bit 2 z
    mesh.vertices.push_back(Vec3((k & 1) - 0.5, (k >> 1 & 1) - 0.5, (k >> 2 & 1) - 0.5).cwiseProduct(edges));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh sphere_mesh(double radius) {
  constexpr std::uint32_t kRings = 24, kAround = 48;
  TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, radius});
  for (std::uint32_t i = 1; i < kRings; ++i)
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const double polar = kPi * i / kRings, azimuth = 2.0 * kPi * j / kAround;
      mesh.vertices.push_back(radius * Vec3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)));
    }
  mesh.vertices.push_back({0, 0, -radius});
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size()) - 1;
  for (std::uint32_t j = 0; j < kAround; ++j) {
    const std::uint32_t next = (j + 1) % kAround, lowest = 1 + (kRings - 2) * kAround;
    mesh.triangles.push_back({0, 1 + j, 1 + next});
    for (std::uint32_t i = 0; i + 2 < kRings; ++i) {
      const std::uint32_t row = 1 + i * kAround, below = row + kAround;
      mesh.triangles.push_back({row + j, below + j, row + next});
      mesh.triangles.push_back({row + next, below + j, below + next});
    }
    mesh.triangles.push_back({lowest + j, last, lowest + next});
  }
  return mesh;
}

}  // namespace

TriangleMesh body_mesh(const Body& body, const std::string& source) {
  switch (body.shape) {
    case Shape::mesh: {
      TriangleMesh mesh = body.mesh;
      const Vec3 center = mass_properties(body, source).center;
      for (Vec3& v : mesh.vertices) v -= center;
      return mesh;
    }
    case Shape::box: return box_mesh(body.box);
    case Shape::sphere: return sphere_mesh(body.radius);
    case Shape::size: return sphere_mesh(0.5 * body.size);
    case Shape::fixed: break;
  }
  return {};
}

double largest_extent(const Body& body) {
  switch (body.shape) {
    case Shape::mesh: {
      Eigen::AlignedBox3d box;
      for (const auto& t : body.mesh.triangles)
        for (const std::uint32_t v : t) box.extend(body.mesh.vertices[v]);
      return box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
    }
    case Shape::box: return body.box.maxCoeff();
    case Shape::sphere: return 2.0 * body.radius;
    case Shape::size: return body.size;
    case Shape::fixed: break;
  }
  return 0.0;
}

}  // namespace unseen::collision
