// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/planes_page.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "report/drawing.h"
#include "report/html.h"
#include "report/palette.h"
#include "unseen/core/version.h"

namespace unseen::report {
namespace {

constexpr std::size_t kDots = 12000;  ///< points drawn in a picture
constexpr std::size_t kRows = 1000;   ///< planes listed; result.json has all

using Rows = std::vector<std::vector<std::string>>;

/// Four decimals, and no "-0.0000".
std::string fixed(double value) {
  return fmt::format("{:.4f}", std::round(value * 1e4) / 1e4 + 0.0);
}

std::string swatch(int frame) {
  return fmt::format("<span class=\"swatch\" style=\"background:{}\"></span>{}", hex(frame_color(frame)),
                     frame);
}

std::string figures(const planes::Arrangement& a) {
  std::string text = "<div class=\"figures\">\n";
  const auto figure = [&](const std::string& name, const std::string& value) {
    text += "<div><b>" + value + "</b>" + escape(name) + "</div>\n";
  };
  for (const auto& [wanted, label] :
       {std::pair{"points", "points"}, std::pair{"assigned", "points on a plane"}})
    for (const auto& [name, count] : a.summary.counts)
      if (name == wanted) figure(label, std::to_string(count));
  figure(a.two_dimensional ? "lines" : "planes", std::to_string(a.planes.size()));
  figure("orientation frames", std::to_string(a.frames.size()));
  figure("relations of directions", std::to_string(a.relations.size()));
  figure(a.two_dimensional ? "related pairs of lines" : "related pairs of planes",
         std::to_string(a.plane_relations));
  figure("scale", fmt::format("{:.4g} m", a.scale));
  return text + "</div>\n";
}

std::string pictures(const planes::Arrangement& a, const PointSample& points) {
  const auto figure = [](const std::string& svg, const std::string& caption) {
    return "<figure>" + svg + "<figcaption>" + caption + "</figcaption></figure>\n";
  };
  std::string text = "<div class=\"pictures\">\n";
  if (a.two_dimensional) {
    text += figure(svg_of_segments(a, points, kDots, "The drawing"),
                   "The lines, coloured by orientation frame; points in grey");
    return text + "</div>\n";
  }
  text += figure(svg_of_planes(a, oblique_view(), "Oblique view"),
                 "Planes, coloured by orientation frame; ceilings above a floor are left out");
  text += figure(svg_of_planes(a, top_view(), "Top view"), "The same from above");
  if (!points.positions.empty())
    text += figure(svg_of_points(a, points, oblique_view(), kDots, "Points"),
                   "Points, coloured by plane; grey ones have none");
  return text + "</div>\n";
}

std::string plane_table(const planes::Arrangement& a) {
  Rows rows;
  for (std::size_t p = 0; p < std::min(a.planes.size(), kRows); ++p) {
    const planes::ArrangedPlane& plane = a.planes[p];
    const Vec3& n = plane.plane.normal;
    rows.push_back({std::to_string(p), escape(plane.tag), swatch(plane.frame),
                    std::to_string(plane.direction), fixed(n.x()) + ", " + fixed(n.y()) + ", " + fixed(n.z()),
                    fixed(plane.plane.offset), fmt::format("{:.4g}", plane.area),
                    std::to_string(plane.points), fmt::format("{:.3g}", plane.rms)});
  }
  std::string text =
      html_table({a.two_dimensional ? "line" : "plane", "tag", "frame", "direction", "normal", "offset (m)",
                  a.two_dimensional ? "length (m)" : "area (m²)", "points", "rms (m)"},
                 rows);
  if (a.planes.size() > kRows)
    text += fmt::format("<p class=\"quiet\">{} more stand in result.json.</p>\n", a.planes.size() - kRows);
  return text;
}

std::string frame_table(const planes::Arrangement& a) {
  Rows rows;
  for (std::size_t f = 0; f < std::min(a.frames.size(), kRows); ++f) {
    double area = 0;
    for (const int p : a.frames[f].planes) area += a.planes[static_cast<std::size_t>(p)].area;
    rows.push_back({swatch(static_cast<int>(f)), std::to_string(a.frames[f].directions.size()),
                    std::to_string(a.frames[f].planes.size()), fmt::format("{:.4g}", area)});
  }
  return html_table({"frame", "directions", a.two_dimensional ? "lines" : "planes",
                     a.two_dimensional ? "length (m)" : "area (m²)"},
                    rows);
}

std::string making_of(const planes::Arrangement& a, const InputRecord& input, const OptionTable& options) {
  Rows seconds, energy, values;
  for (const auto& [name, value] : a.summary.seconds)
    seconds.push_back({escape(name), fmt::format("{:.3f} s", value)});
  for (const auto& [name, value] : a.summary.energy)
    energy.push_back({escape(name), fmt::format("{:.6g}", value)});
  for (const Option& option : options.all())
    values.push_back({escape(option.name), escape(option.text()), escape(option.unit), escape(option.help)});
  std::string text;
  if (!seconds.empty()) text += "<h2>Time</h2>\n" + html_table({}, seconds);
  if (!energy.empty()) text += "<h2>Energy</h2>\n" + html_table({}, energy);
  text += "<h2>Options</h2>\n" + html_table({"option", "value", "unit", "what it does"}, values);
  text += "<p class=\"quiet\">Input " + escape(input.path);
  if (!input.sha256.empty()) text += ", SHA-256 " + escape(input.sha256);
  return text + ". Made by unseen " + kVersion + ".</p>\n";
}

}  // namespace

std::string planes_page(const planes::Arrangement& a, const InputRecord& input, const OptionTable& options,
                        const std::string& command, const PointSample& points) {
  const std::string name = std::filesystem::path(input.path).filename().string();
  const std::string title =
      (a.two_dimensional ? "Lines of " : "Planes of ") + (name.empty() ? input.path : name);
  std::string body = "<h1>" + escape(title) + "</h1>\n<pre>" + escape(command) + "</pre>\n";
  if (a.summary.status != Status::solved)
    body += fmt::format("<p class=\"warning\">Status: {}</p>\n", to_string(a.summary.status));
  for (const std::string& warning : a.summary.warnings)
    body += "<p class=\"warning\">" + escape(warning) + "</p>\n";
  body += figures(a) + pictures(a, points);
  body += std::string("<h2>Orientation frames</h2>\n") + frame_table(a);
  body += std::string("<h2>") + (a.two_dimensional ? "Lines" : "Planes") + "</h2>\n" + plane_table(a);
  return html_page(title, body + making_of(a, input, options));
}

}  // namespace unseen::report
