// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "unseen/core/mesh.h"

namespace unseen::planes::test {

/// The folder of shared scans, beside the project; tests that need it pass with a remark where it is missing.
inline std::filesystem::path data_folder() {
  return std::filesystem::path(UNSEEN_SOURCE_DIR) / "../shared/data/planes";
}

/// First three columns of an ASCII PLY that has nothing but vertices.
inline std::vector<Vec3> read_points(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line) && line.rfind("end_header", 0) != 0) {
  }
  std::vector<Vec3> points;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    Vec3 p;
    if (words >> p.x() >> p.y() >> p.z()) points.push_back(p);
  }
  return points;
}

/// Vertices and triangles of a Wavefront OBJ, nothing else.
inline TriangleMesh read_mesh(const std::filesystem::path& file) {
  std::ifstream in(file);
  TriangleMesh mesh;
  std::string line, word;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    words >> word;
    if (word == "v") {
      Vec3 p;
      words >> p.x() >> p.y() >> p.z();
      mesh.vertices.push_back(p);
    } else if (word == "f") {
      std::array<std::uint32_t, 3> triangle{};
      for (auto& index : triangle) {
        words >> word;
        index = static_cast<std::uint32_t>(std::stoul(word)) - 1;
      }
      mesh.triangles.push_back(triangle);
    }
    word.clear();
  }
  return mesh;
}

struct Segmentation {
  std::vector<Plane> planes;
  std::vector<int> plane_of_point;
};

/// Primitives `x,y,z,nx,ny,nz,gid,…` and associations `point,gid,…` of the original implementation.
inline Segmentation read_original(const std::filesystem::path& primitives,
                                  const std::filesystem::path& associations, std::size_t point_count) {
  const auto rows = [](const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<std::vector<double>> rows;
    std::string line, word;
    while (std::getline(in, line)) {
      if (line.empty() || line[0] == '#') continue;
      std::istringstream words(line);
      rows.emplace_back();
      while (std::getline(words, word, ',')) rows.back().push_back(std::stod(word));
    }
    return rows;
  };
  Segmentation result;
  std::map<int, int> plane_of_id;
  for (const auto& row : rows(primitives)) {
    const Vec3 normal = Vec3(row[3], row[4], row[5]).normalized();
    plane_of_id[static_cast<int>(row[6])] = static_cast<int>(result.planes.size());
    result.planes.push_back({normal, normal.dot(Vec3(row[0], row[1], row[2]))});
  }
  result.plane_of_point.assign(point_count, -1);
  for (const auto& row : rows(associations))
    if (const auto found = plane_of_id.find(static_cast<int>(row[1])); found != plane_of_id.end())
      result.plane_of_point.at(static_cast<std::size_t>(row[0])) = found->second;
  return result;
}

}  // namespace unseen::planes::test
