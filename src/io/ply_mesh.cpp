// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "io/ply_header.h"
#include "io/polygon.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

/// The faces of a PLY; its vertices come from the reader of points.
class FaceReader {
 public:
  explicit FaceReader(const Input& input)
      : input_(input), header_(read_ply_header(input.view(), input.name)) {
    Input points = input;
    points.options.label_field.clear();
    mesh_.vertices = read_all(*open_ply(points)).positions;
  }

  TriangleMesh read() {
    std::size_t at = header_.data;
    lines_ = Lines(input_.view(), header_.data, header_.data_line);
    for (const PlyElement& element : header_.elements) {
      if (element.name == "face") find_properties(element);
      for (std::size_t i = 0; i < element.count; ++i) {
        const bool read = element.name == "face" ? read_face(element, at) : skip(element, at);
        if (!read)
          throw InputError(input_.name, "element " + element.name, std::to_string(i),
                           "the " + std::to_string(element.count) + " that the header promises");
      }
      if (element.name == "face") break;
    }
    return std::move(mesh_);
  }

 private:
  void find_properties(const PlyElement& element) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      const bool corners = property.name == "vertex_indices" || property.name == "vertex_index";
      if (property.is_list && corners && is_integer(property.type)) corners_at_ = i;
      if (!property.is_list && role_of_name(property.name, is_integer(property.type), "") == Role::label)
        label_at_ = i;
    }
    if (element.count > 0 && corners_at_ == kNone)
      throw InputError(input_.name, "element face", "no list vertex_indices", "the corners of the faces");
  }

  bool skip(const PlyElement& element, std::size_t& at) {
    std::string_view line;
    return header_.ascii ? lines_.next_filled(line) : skip_instance(input_.view(), at, element, header_.swap);
  }

  bool read_face(const PlyElement& element, std::size_t& at) {
    std::string_view line;
    if (header_.ascii && !lines_.next_filled(line)) return false;
    const char *p = line.data(), *end = line.data() + line.size();
    corners_.clear();
    double label = -1.0;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      double length = 1.0;
      if (property.is_list && !read_length(property, p, end, at, length)) return false;
      if (i == corners_at_ && length > static_cast<double>(kMostCorners))
        throw InputError(input_.name, "element face", "a face of more than 1000 corners", "polygons");
      for (double k = 0.0; k < length; k += 1.0) {
        double value = 0.0;
        if (!read_value(property, p, end, at, value)) return false;
        if (i == corners_at_) add_corner(value);
        if (i == label_at_) label = value;
      }
    }
    append_polygon(corners_, mesh_);
    if (label_at_ != kNone) mesh_.labels.resize(mesh_.triangles.size(), to_label(label));
    return true;
  }

  bool read_length(const PlyProperty& property, const char*& p, const char* end, std::size_t& at,
                   double& length) {
    if (header_.ascii) return read_number(p, end, length);
    std::size_t count = 0;
    if (!list_length(input_.view(), at, property, header_.swap, count)) return false;
    length = static_cast<double>(count);
    return true;
  }

  bool read_value(const PlyProperty& property, const char*& p, const char* end, std::size_t& at,
                  double& value) {
    if (header_.ascii) return read_number(p, end, value);
    const std::size_t size = size_of(property.type);
    if (size > input_.view().size() - at) return false;
    value = load_scalar(input_.view().data() + at, property.type, header_.swap);
    at += size;
    return true;
  }

  void add_corner(double value) {
    if (!(value >= 0.0) || value >= static_cast<double>(mesh_.vertices.size()))
      throw InputError(input_.name, "element face", "vertex " + std::to_string(value),
                       "one below " + std::to_string(mesh_.vertices.size()));
    corners_.push_back(static_cast<std::uint32_t>(value));
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  const Input& input_;
  PlyHeader header_;
  Lines lines_;
  TriangleMesh mesh_;
  std::size_t corners_at_ = kNone, label_at_ = kNone;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

TriangleMesh read_ply_mesh(const Input& input) {
  return FaceReader(input).read();
}

}  // namespace unseen::io
