// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/mesh.h"

#include <algorithm>
#include <cmath>

#include "io/readers.h"
#include "io/sniff.h"
#include "io/text.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"

namespace unseen::io {
namespace {

Vec3 doubled_area(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  const Vec3& a = mesh.vertices[t[0]];
  return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
}

TriangleMesh without_degenerate(TriangleMesh mesh) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const double area = doubled_area(mesh, i).norm();
    if (!(area > 0.0) || !std::isfinite(area)) continue;
    mesh.triangles[kept] = mesh.triangles[i];
    if (!mesh.labels.empty()) mesh.labels[kept] = mesh.labels[i];
    ++kept;
  }
  mesh.triangles.resize(kept);
  if (!mesh.labels.empty()) mesh.labels.resize(kept);
  return mesh;
}

}  // namespace

TriangleMesh read_mesh_file(const Input& input) {
  const Format format = decide_format(input.view(), input.name, input.extension);
  switch (format) {
    case Format::obj:
      return without_degenerate(read_obj(input));
    case Format::off:
      return without_degenerate(read_off(input));
    case Format::stl:
      return without_degenerate(read_stl(input));
    case Format::ply:
      return without_degenerate(read_ply_mesh(input));
    default:
      throw InputError(input.name, "content", name_of(format), "a mesh: OBJ, OFF, STL or PLY");
  }
}

TriangleMesh read_mesh(const std::filesystem::path& path) {
  return read_mesh_file(input_from(path, {}));
}

TriangleMesh read_mesh_in_memory(std::string bytes, const std::string& name) {
  Input input = input_from_memory(std::move(bytes), name, {});
  return read_mesh_file(input);
}

PointCloud sample_mesh(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  std::vector<double> sums;  // of the areas up to each triangle
  sums.reserve(mesh.triangles.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const double area = doubled_area(mesh, i).norm();
    if (std::isfinite(area)) sum += area;
    sums.push_back(sum);
  }
  PointCloud cloud;
  if (!(sum > 0.0) || !std::isfinite(sum)) return cloud;
  Random random(seed);
  for (std::size_t k = 0; k < count; ++k) {
    const double at = random.uniform() * sum;
    const auto found = std::upper_bound(sums.begin(), sums.end(), at);
    const auto i = static_cast<std::size_t>(std::min(found, sums.end() - 1) - sums.begin());
    const double s = std::sqrt(random.uniform()), t = random.uniform();
    const auto& corners = mesh.triangles[i];
    cloud.positions.push_back((1.0 - s) * mesh.vertices[corners[0]] +
                              s * (1.0 - t) * mesh.vertices[corners[1]] + s * t * mesh.vertices[corners[2]]);
    cloud.normals.push_back(doubled_area(mesh, i).normalized().cast<float>());
    if (!mesh.labels.empty()) cloud.labels.push_back(mesh.labels[i]);
  }
  return cloud;
}

std::unique_ptr<PointSource> open_mesh(const Input& input) {
  const TriangleMesh mesh = read_mesh_file(input);
  SourceInfo info;
  info.name = input.name;
  PointCloud cloud = sample_mesh(mesh, input.options.mesh_samples, input.options.seed);
  if (cloud.size() > 0) {
    info.notes.push_back(count_of(cloud.size(), "point") + " sampled on " +
                         count_of(mesh.triangles.size(), "triangle"));
  } else if (mesh.triangles.empty() && !mesh.vertices.empty()) {
    cloud.positions = mesh.vertices;
    info.notes.push_back("no faces: the points are the vertices");
  } else {
    throw InputError(input.name, "content", "a mesh without area or vertices", "triangles or points");
  }
  return std::make_unique<OwnedCloudSource>(std::move(cloud), std::move(info));
}

}  // namespace unseen::io
