// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/polygon.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

class OffReader {
 public:
  explicit OffReader(const Input& input) : input_(input), lines_(input.view()) {}

  TriangleMesh read() {
    std::string_view line;
    if (!next(line)) fail("header", "no line", "OFF");
    auto fields = words(line);
    const std::string_view magic = fields[0];
    if (magic.size() < 3 || magic.substr(magic.size() - 3) != "OFF") fail("header", shown(line), "OFF");
    fields.erase(fields.begin());  // some writers put the counts beside it
    if (!fields.empty() && fields[0] == "BINARY")
      fail("header", "binary OFF", "text; convert it to PLY or OBJ");
    if (fields.empty()) {
      if (!next(line)) fail("counts", "the end of the file", "numbers of vertices and faces");
      fields = words(line);
    }
    std::size_t vertices = 0, faces = 0;
    if (fields.size() < 2 || !to_count(fields[0], vertices) || !to_count(fields[1], faces))
      fail("counts", shown(line), "numbers of vertices and faces from 0");
    check_room("vertices", vertices, 6);
    check_room("faces", faces, 4);
    read_vertices(vertices);
    for (std::size_t i = 0; i < faces; ++i) read_face(i, faces);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError(input_.name, field, found, expected);
  }
  std::string here(const char* what) const { return "line " + std::to_string(lines_.number()) + ", " + what; }

  bool next(std::string_view& line) {
    while (lines_.next_filled(line)) {
      line = trim(line.substr(0, line.find('#')));
      if (!line.empty()) return true;
    }
    return false;
  }

  void check_room(const char* what, std::size_t count, std::size_t shortest) const {
    const std::string_view rest = input_.view().substr(lines_.offset());
    if (count > (rest.size() + 1) / shortest)
      fail(what, count_of(count_filled_lines(rest), "line"),
           "the " + std::to_string(count) + " that the header promises");
  }

  void read_vertices(std::size_t count) {
    std::string_view line;
    mesh_.vertices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      if (!next(line))
        fail("vertices", std::to_string(i), "the " + std::to_string(count) + " that the header promises");
      const char *p = line.data(), *end = line.data() + line.size();
      Vec3 vertex;
      for (int k = 0; k < 3; ++k)
        if (!read_number(p, end, vertex[k])) fail(here("vertex"), shown(line), "x y z");
      mesh_.vertices.push_back(vertex);
    }
  }

  void read_face(std::size_t i, std::size_t count) {
    std::string_view line;
    if (!next(line))
      fail("faces", std::to_string(i), "the " + std::to_string(count) + " that the header promises");
    const auto fields = words(line);
    std::size_t size = 0, corner = 0;
    if (!to_count(fields[0], size) || size + 1 > fields.size() || size > kMostCorners)
      fail(here("face"), shown(line), "its number of corners (at most 1000), then the corners");
    corners_.clear();
    for (std::size_t k = 1; k <= size; ++k) {
      if (!to_count(fields[k], corner) || corner >= mesh_.vertices.size())
        fail(here("face"), shown(fields[k]), "a vertex below " + std::to_string(mesh_.vertices.size()));
      corners_.push_back(static_cast<std::uint32_t>(corner));
    }
    append_polygon(corners_, mesh_);
  }

  const Input& input_;
  Lines lines_;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

TriangleMesh read_off(const Input& input) {
  return OffReader(input).read();
}

}  // namespace unseen::io
