// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "report/palette.h"
#include "unseen/report/planes_files.h"

namespace unseen::report {
namespace {

/// sRGB of entry `index`, 10…249, of AutoCAD's colour index: 24 hues 15° apart, five brightnesses each, even
/// ones saturated and odd ones half so.
Rgb indexed_color(int index) {
  constexpr std::array<double, 5> kBrightness = {1.0, 0.65, 0.5, 0.3, 0.15};
  const double hue = (index / 10 - 1) / 4.0;  // in sixths of the circle
  const double value = kBrightness[static_cast<std::size_t>(index % 10 / 2)];
  const double saturation = index % 2 == 0 ? 1.0 : 0.5;
  Rgb color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double turned = std::fmod(hue + 5.0 - 2.0 * static_cast<double>(i), 6.0);
    const double fall = std::clamp(std::min(turned, 4.0 - turned), 0.0, 1.0);
    color[i] = static_cast<std::uint8_t>(255.0 * value * (1.0 - saturation * fall));
  }
  return color;
}

int nearest_index(const Rgb& color) {
  int nearest = 0, least = std::numeric_limits<int>::max();
  for (int index = 10; index < 250; ++index) {
    const Rgb candidate = indexed_color(index);
    int difference = 0;
    for (std::size_t i = 0; i < 3; ++i) difference += (candidate[i] - color[i]) * (candidate[i] - color[i]);
    if (difference < least) least = difference, nearest = index;
  }
  return nearest;
}

/// Group code and value, a line each.
template <class Value>
void group(std::string& text, int code, const Value& value) {
  fmt::format_to(std::back_inserter(text), "{:>3}\n{}\n", code, value);
}

/// Point number `which`, 0 or 1, as three groups of real numbers.
void point(std::string& text, int which, const Vec3& p) {
  for (int i = 0; i < 3; ++i) group(text, 10 * (i + 1) + which, fmt::format("{:#}", p[i] + 0.0));
}

void layer(std::string& text, const std::string& name, int color) {
  group(text, 0, "LAYER");
  group(text, 2, name);
  group(text, 70, 0);
  group(text, 62, color);
  group(text, 6, "CONTINUOUS");
}

std::string layer_name(int frame) {
  return fmt::format("FRAME_{}", frame);
}

void header(std::string& text, const planes::Arrangement& a) {
  Eigen::AlignedBox3d box;
  for (const planes::ArrangedPlane& plane : a.planes)
    if (plane.segment)
      for (const Vec3& end : *plane.segment) box.extend(end);
  if (box.isEmpty()) box.extend(Vec3::Zero());
  group(text, 999, "lines of unseen, metres; a layer an orientation frame");
  group(text, 0, "SECTION");
  group(text, 2, "HEADER");
  group(text, 9, "$ACADVER");
  group(text, 1, "AC1009");
  group(text, 9, "$EXTMIN");
  point(text, 0, box.min());
  group(text, 9, "$EXTMAX");
  point(text, 0, box.max());
  group(text, 0, "ENDSEC");
}

void tables(std::string& text, std::size_t frames) {
  group(text, 0, "SECTION");
  group(text, 2, "TABLES");
  group(text, 0, "TABLE");
  group(text, 2, "LTYPE");
  group(text, 70, 1);
  group(text, 0, "LTYPE");
  group(text, 2, "CONTINUOUS");
  group(text, 70, 0);
  group(text, 3, "Solid line");
  group(text, 72, 65);  // alignment "A", the only one there is
  group(text, 73, 0);
  group(text, 40, "0.0");
  group(text, 0, "ENDTAB");
  group(text, 0, "TABLE");
  group(text, 2, "LAYER");
  group(text, 70, frames + 1);
  layer(text, "0", 7);
  for (int f = 0; f < static_cast<int>(frames); ++f)
    layer(text, layer_name(f), nearest_index(frame_color(f)));
  group(text, 0, "ENDTAB");
  group(text, 0, "ENDSEC");
}

}  // namespace

std::string drawing_dxf(const planes::Arrangement& a) {
  std::string text;
  header(text, a);
  tables(text, a.frames.size());
  group(text, 0, "SECTION");
  group(text, 2, "ENTITIES");
  for (const planes::ArrangedPlane& plane : a.planes) {
    if (!plane.segment) continue;
    group(text, 0, "LINE");
    group(text, 8, layer_name(plane.frame));
    point(text, 0, (*plane.segment)[0]);
    point(text, 1, (*plane.segment)[1]);
  }
  group(text, 0, "ENDSEC");
  group(text, 0, "EOF");
  return text;
}

}  // namespace unseen::report
