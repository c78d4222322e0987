// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <charconv>
#include <map>

#include "io/polygon.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

class ObjReader {
 public:
  explicit ObjReader(const Input& input) : input_(input), lines_(input.view()) {}

  TriangleMesh read() {
    std::string_view line;
    while (lines_.next_filled(line)) {
      if (line.back() == '\\') line = continued(line);
      const char* p = line.data();
      const char* const end = line.data() + line.size();
      while (p != end && is_blank(*p)) ++p;
      const char* start = p;
      while (p != end && !is_blank(*p)) ++p;
      const std::string_view key(start, static_cast<std::size_t>(p - start));
      const std::string_view rest(p, static_cast<std::size_t>(end - p));
      if (key == "v") read_vertex(rest);
      if (key == "f") read_face(rest);
      if (key == "g" || key == "o") group_ = group_number(std::string(trim(rest)));
    }
    if (mesh_.vertices.empty()) fail("vertices", "no line \"v x y z\"", "vertices");
    if (groups_.size() < 2) mesh_.labels.clear();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError(input_.name, field, found, expected);
  }
  std::string here(const char* what) const { return "line " + std::to_string(lines_.number()) + ", " + what; }

  /// A line that ends with a backslash, and those that continue it.
  std::string_view continued(std::string_view line) {
    joined_.clear();
    while (!line.empty() && line.back() == '\\') {
      joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
      if (!lines_.next(line)) line = {};
    }
    return joined_ += line;
  }

  void read_vertex(std::string_view rest) {
    const char *p = rest.data(), *end = rest.data() + rest.size();
    Vec3 vertex;
    for (int i = 0; i < 3; ++i)
      if (!read_number(p, end, vertex[i])) fail(here("vertex"), shown(rest), "x y z");
    mesh_.vertices.push_back(vertex);
  }

  std::int32_t group_number(const std::string& name) {
    return groups_.try_emplace(name, static_cast<std::int32_t>(groups_.size())).first->second;
  }

  void read_face(std::string_view rest) {
    corners_.clear();
    const char *p = rest.data(), *end = rest.data() + rest.size();
    while (true) {
      while (p != end && is_blank(*p)) ++p;
      if (p == end) break;
      long long index = 0;
      const auto [after, error] = std::from_chars(p, end, index);
      const auto count = static_cast<long long>(mesh_.vertices.size());
      if (error == std::errc() && index < 0) index += count + 1;  // counted from the last
      if (error != std::errc() || index < 1 || index > count)
        fail(here("face"), shown(trim(rest)), "corners from 1 to " + std::to_string(count));
      corners_.push_back(static_cast<std::uint32_t>(index - 1));
      p = after;
      while (p != end && !is_blank(*p)) ++p;  // texture and normal
      if (corners_.size() > kMostCorners) fail(here("face"), "more than 1000 corners", "a polygon");
    }
    if (groups_.empty()) group_ = group_number("");
    append_polygon(corners_, mesh_);
    mesh_.labels.resize(mesh_.triangles.size(), group_);
  }

  const Input& input_;
  Lines lines_;
  std::string joined_;
  TriangleMesh mesh_;
  std::vector<std::uint32_t> corners_;
  std::map<std::string, std::int32_t> groups_;
  std::int32_t group_ = 0;
};

}  // namespace

TriangleMesh read_obj(const Input& input) {
  return ObjReader(input).read();
}

}  // namespace unseen::io
