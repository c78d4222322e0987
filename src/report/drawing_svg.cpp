// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "report/palette.h"
#include "report/surfaces.h"
#include "unseen/report/planes_files.h"

namespace unseen::report {
namespace {

constexpr double kLargestPaper = 100.0;  // m: what is larger, as the pixels of a picture, has a metre a pixel

using Axes = std::array<int, 2>;  // of the world: right and up

/// Metres right of and below `offset`.
Vec2 on_paper(const Vec3& world, const Vec3& offset, const Axes& axes) {
  return {world[axes[0]] - offset[axes[0]], offset[axes[1]] - world[axes[1]]};
}

/// A group a frame with the segments that have it.
std::string groups(const planes::Arrangement& a, const Vec3& offset, const Axes& axes) {
  std::string text;
  for (std::size_t f = 0; f < a.frames.size(); ++f) {
    text += fmt::format("<g id=\"frame_{}\" stroke=\"{}\">\n", f, hex(frame_color(static_cast<int>(f))));
    for (const int p : a.frames[f].planes) {
      const auto& segment = a.planes[static_cast<std::size_t>(p)].segment;
      if (!segment) continue;
      const Vec2 from = on_paper((*segment)[0], offset, axes), to = on_paper((*segment)[1], offset, axes);
      text += fmt::format("<path id=\"plane_{}\" d=\"M{:.6f} {:.6f}L{:.6f} {:.6f}\"/>\n", p, from.x(),
                          from.y(), to.x(), to.y());
    }
    text += "</g>\n";
  }
  return text;
}

}  // namespace

std::string drawing_svg(const planes::Arrangement& a) {
  const auto surfaces = surfaces_of(a);
  const Vec3 offset = offset_of(surfaces, {});
  const Axes axes = planes::drawing_axes(a);
  Eigen::AlignedBox2d box;
  for (const Surface& surface : surfaces)
    for (const Vec3& end : surface.vertices) box.extend(on_paper(end, offset, axes));
  if (box.isEmpty()) box.extend(Vec2::Zero());
  const double longest = std::max(box.sizes().maxCoeff(), 1e-3), margin = 0.02 * longest;
  const Vec2 corner = box.min().array() - margin, size = box.sizes().array() + 2 * margin;
  const bool true_size = longest < kLargestPaper;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}{12}\" height=\"{1:.3f}{12}\" "
      "viewBox=\"{2:.6f} {3:.6f} {4:.6f} {5:.6f}\"\n"
      "  style=\"max-width:100%;max-height:100vh\" fill=\"none\" stroke-linecap=\"round\" "
      "stroke-width=\"{6:.6f}\">\n"
      "<desc>lines of unseen, metres; world {10} = x + {7}, world {11} = {8} - y</desc>\n{9}</svg>\n",
      (true_size ? 1e3 : 1.0) * size.x(), (true_size ? 1e3 : 1.0) * size.y(), corner.x(), corner.y(), size.x(), size.y(), 0.003 * longest, offset[axes[0]],
      offset[axes[1]], groups(a, offset, axes), "xyz"[axes[0]], "xyz"[axes[1]], true_size ? "mm" : "");
}

}  // namespace unseen::report
