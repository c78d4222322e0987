// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <iterator>

#include "report/palette.h"
#include "report/surfaces.h"
#include "unseen/report/planes_files.h"

namespace unseen::report {
namespace {

struct Sizes {
  std::size_t vertices = 0, triangles = 0, segments = 0;
};

Sizes sizes_of(const std::vector<Surface>& surfaces) {
  Sizes sizes;
  for (const Surface& s : surfaces) {
    sizes.vertices += s.vertices.size();
    sizes.triangles += s.triangles.size();
    sizes.segments += s.vertices.size() == 2 ? 1 : 0;
  }
  return sizes;
}

std::string material(int frame) {
  return fmt::format("frame_{}", frame);
}

}  // namespace

/// Vertices are coloured, too: many programs (Blender, Open3D, CloudCompare) pass over colours of faces.
std::string planes_ply(const planes::Arrangement& a) {
  const auto surfaces = surfaces_of(a);
  const Sizes sizes = sizes_of(surfaces);
  const std::string color = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\ncomment planes of unseen\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n{}",
      sizes.vertices, color);
  if (a.two_dimensional)
    text += fmt::format("element edge {}\nproperty int vertex1\nproperty int vertex2\n", sizes.segments);
  else
    text += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", sizes.triangles);
  text += "property int plane\nproperty int frame\n" + color + "end_header\n";

  auto out = std::back_inserter(text);
  for (std::size_t p = 0; p < surfaces.size(); ++p) {
    const Rgb c = frame_color(a.planes[p].frame);
    for (const Vec3& v : surfaces[p].vertices)
      fmt::format_to(out, "{} {} {} {} {} {}\n", v.x(), v.y(), v.z(), c[0], c[1], c[2]);
  }
  std::size_t first = 0;
  for (std::size_t p = 0; p < surfaces.size(); ++p) {
    const int frame = a.planes[p].frame;
    const Rgb c = frame_color(frame);
    const std::string membership = fmt::format("{} {} {} {} {}", p, frame, c[0], c[1], c[2]);
    for (const Triangle& t : surfaces[p].triangles)
      fmt::format_to(out, "3 {} {} {} {}\n", first + t[0], first + t[1], first + t[2], membership);
    if (a.two_dimensional && surfaces[p].vertices.size() == 2)
      fmt::format_to(out, "{} {} {}\n", first, first + 1, membership);
    first += surfaces[p].vertices.size();
  }
  return text;
}

/// Each plane is an object, too, because Blender tells only these apart.
std::string planes_obj(const planes::Arrangement& a, const std::string& material_file) {
  const auto surfaces = surfaces_of(a);
  std::string text = "# planes of unseen\nmtllib " + material_file + "\n";
  auto out = std::back_inserter(text);
  std::size_t first = 1;
  for (std::size_t p = 0; p < surfaces.size(); ++p) {
    const std::string& tag = a.planes[p].tag;
    const std::string name = fmt::format("plane_{}{}", p, tag.empty() ? "" : "_" + tag);
    fmt::format_to(out, "o {0}\ng {0}\nusemtl {1}\n", name, material(a.planes[p].frame));
    for (const Vec3& v : surfaces[p].vertices) fmt::format_to(out, "v {} {} {}\n", v.x(), v.y(), v.z());
    for (const Triangle& t : surfaces[p].triangles)
      fmt::format_to(out, "f {} {} {}\n", first + t[0], first + t[1], first + t[2]);
    if (surfaces[p].vertices.size() == 2) fmt::format_to(out, "l {} {}\n", first, first + 1);
    first += surfaces[p].vertices.size();
  }
  return text;
}

std::string planes_mtl(const planes::Arrangement& a) {
  std::string text = "# colours of the orientation frames\n";
  for (std::size_t f = 0; f < a.frames.size(); ++f) {
    const Rgb c = frame_color(static_cast<int>(f));
    text += fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\n", material(static_cast<int>(f)), c[0] / 255.0,
                        c[1] / 255.0, c[2] / 255.0);
  }
  return text;
}

}  // namespace unseen::report
