// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/columns.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50;

void append_triangle(const Vec3 (&corners)[3], TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners, corners + 3);
  mesh.triangles.push_back({first, first + 1, first + 2});
}

TriangleMesh read_binary(const Input& input) {
  constexpr bool kSwap = std::endian::native == std::endian::big;
  const std::string_view bytes = input.view();
  const auto fail = [&](const char* field, const std::string& found, const std::string& expected) {
    throw InputError(input.name, field, found, expected);
  };
  if (bytes.size() < kHeader) fail("header", count_of(bytes.size(), "byte"), "at least 84");
  const std::size_t count = load<std::uint32_t>(bytes.data() + 80, kSwap);
  const std::size_t room = (bytes.size() - kHeader) / kTriangle;
  if (count > room)
    fail("triangles", std::to_string(room), "the " + std::to_string(count) + " that the header promises");
  TriangleMesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 corners[3];
    for (std::size_t k = 0; k < 9; ++k)
      corners[k / 3][static_cast<Eigen::Index>(k % 3)] =
          load<float>(bytes.data() + kHeader + i * kTriangle + 12 + 4 * k, kSwap);
    append_triangle(corners, mesh);
  }
  return mesh;
}

TriangleMesh read_text(const Input& input) {
  TriangleMesh mesh;
  Lines lines(input.view());
  std::string_view line;
  Vec3 corners[3];
  std::size_t found = 0;
  const auto fail = [&](const std::string& what, const char* expected) {
    throw InputError(input.name, "line " + std::to_string(lines.number()), what, expected);
  };
  while (lines.next_filled(line)) {
    const auto fields = words(line);
    const std::string key = lower(fields[0]);
    if (key == "endfacet") {
      if (found != 3) fail(count_of(found, "vertex line") + " in a facet", "3");
      append_triangle(corners, mesh);
      found = 0;
    } else if (key == "vertex") {
      if (found == 3) fail("a fourth vertex in a facet", "3");
      for (std::size_t k = 0; k < 3; ++k)
        if (fields.size() != 4 || !to_number(fields[k + 1], corners[found][static_cast<Eigen::Index>(k)]))
          fail(shown(line), "\"vertex x y z\"");
      ++found;
    }
  }
  if (found > 0) fail("the end of the file within a facet", "\"endfacet\"");
  return mesh;
}

}  // namespace

TriangleMesh read_stl(const Input& input) {
  const std::string head = lower(input.view().substr(0, 4096));
  const bool text = head.starts_with("solid") && head.find("facet") != std::string::npos;
  TriangleMesh mesh = text ? read_text(input) : read_binary(input);
  if (mesh.triangles.empty()) throw InputError(input.name, "triangles", "none", "triangles");
  return mesh;
}

}  // namespace unseen::io
