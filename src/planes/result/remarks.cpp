// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/result/remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace unseen::planes {
namespace {

/// Warns of coordinates that single precision has rounded coarsely, as large ones are that were stored without an offset; false if it has not.
bool warn_of_single_precision(const Survey& survey, double scale, Context& context) {
  constexpr double kCoarse = 0.25;  // of the scale
  const auto farthest = static_cast<float>(std::max(survey.low.cwiseAbs().maxCoeff(), survey.high.cwiseAbs().maxCoeff()));
  const double step = std::nextafter(farthest, std::numeric_limits<float>::infinity()) - farthest;
  const auto single = [](const Vec3& p) { return p == p.cast<float>().cast<double>(); };
  if (step < kCoarse * scale || !std::all_of(survey.sample.begin(), survey.sample.end(), single)) return false;
  context.warn(fmt::format("the coordinates, up to {:.7g} m, are rounded to single precision, in steps of {:.2g} m: details below that are lost. "
                           "Export them in double precision, or less an offset", farthest, step));
  return true;
}

/// Warns of text with so few digits that they end far before the details, as "5.6789e+06" does.
void warn_of_few_digits(const Survey& survey, double scale, Context& context) {
  constexpr double kCoarse = 0.25;          // of the scale
  constexpr double kFewSteps = 100, kFar = 1e4;  // of the extent, and of the coordinates: a grid of points has more of these, or is nearer to the origin
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = survey.high[axis] - survey.low[axis], farthest = std::max(std::abs(survey.low[axis]), std::abs(survey.high[axis]));
    const auto comes_in = [&](double step) {
      return farthest > kFar * step && std::all_of(survey.sample.begin(), survey.sample.end(), [&](const Vec3& p) { return std::abs(p[axis] / step - std::round(p[axis] / step)) < 1e-6; });
    };
    double step = std::pow(10.0, std::ceil(std::log10(std::max(kCoarse * scale, extent / kFewSteps))));
    if (!(extent > 0.0) || !comes_in(step)) continue;
    while (comes_in(10.0 * step)) step *= 10.0;
    context.warn(fmt::format("{} comes in steps of {:.4g} m only: digits were lost when it was written. Export more of them, in binary, or less an offset", "xyz"[axis], step));
  }
}

}  // namespace

void warn_of_rounding(const Survey& survey, double scale, Context& context) {
  if (!warn_of_single_precision(survey, scale, context)) warn_of_few_digits(survey, scale, context);
}

void warn_of_units(const Survey& survey, const Space& space, double scale, Context& context) {
  constexpr double kCoarse = 3.0;  // m: an aerial scan has a point per square metre
  if (space.is_2d() || scale < kCoarse) return;
  context.warn(fmt::format("the points ask for a scale of {:.3g} m, in a scene {:.4g} m wide: coordinates count as metres. If they are millimetres, so are all lengths of the result",
                           scale, survey.extent()));
}

void warn_of_few(PointSource& source, const Survey& seen, const Space& space, bool estimated, const Arrangement& result, Context& context) {
  constexpr double kFew = 0.5, kMany = 0.1, kLarger = 1.5;
  std::size_t assigned = 0;
  for (const ArrangedPlane& p : result.planes) assigned += p.points;
  const double share = static_cast<double>(assigned) / static_cast<double>(seen.finite);
  if (result.planes.empty() || share > (estimated ? kFew : 1.0 - kMany)) return;
  if (estimated) {
    context.warn(fmt::format("only {:.0f} % of the points lie on planes at the estimated scale of {:.3g} m: plants do not; if the scene is made of planes, another "
                             "scale suits it better (--scale)", 100.0 * share, result.scale));
  } else if (const double scale = estimate_scale(source, seen, space, context).scale; scale > kLarger * result.scale) {
    context.warn(fmt::format("{:.0f} % of the points lie on no plane at a scale of {:.3g} m: their spacing and noise ask for {:.3g} m", 100.0 * (1.0 - share),
                             result.scale, scale));
  }
}

void warn_of_right_angles(const Arrangement& result, const AngleSet& angles, Context& context) {
  constexpr double kRight = 0.5 * kPi / 180.0, kMany = 0.1;  // of all pairs of area: a third are in a box
  if (angles.has_right_angle) return;
  std::vector<double> area(result.directions.size(), 0.0);
  for (const ArrangedPlane& p : result.planes) area[p.direction] += p.area;
  double right = 0, all = 0;
  for (std::size_t a = 0; a < area.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      all += area[a] * area[b];
      if (line_angle(result.directions[a].normal, result.directions[b].normal) > kPi / 2 - kRight) right += area[a] * area[b];
    }
  if (right > kMany * all) context.warn("planes at right angles are not related, as the angles asked for do not name 90: add it, as in --angles 60,90");
}

void warn_of_turned(const Arrangement& result, Context& context) {
  constexpr double kLeast = 2.0 * kPi / 180.0, kErrors = 8.0;  // that a plane is turned by: scans out of register turn small ones by less
  constexpr std::size_t kFewest = 60, kListed = 5;       // points; planes that are named
  std::vector<int> sharing(result.directions.size(), 0);
  std::vector<char> related(result.directions.size(), 0);
  for (const ArrangedPlane& p : result.planes) related[p.direction] = ++sharing[p.direction] > 1;
  for (const Relation& r : result.relations) related[r.a] = related[r.b] = 1;
  std::size_t count = 0;
  std::string names;
  double most = 0;
  for (std::size_t i = 0; i < result.planes.size(); ++i) {
    const ArrangedPlane& p = result.planes[i];
    if (!related[p.direction] || p.points < kFewest || p.turned < std::max(kLeast, kErrors * p.turned_error)) continue;
    if (++count <= kListed) names += (count > 1 ? ", " : "") + std::to_string(i);
    most = std::max(most, p.turned);
  }
  if (count == 0) return;
  if (count > kListed) names += ", …";
  const char* what = result.two_dimensional ? (count > 1 ? "lines are" : "line is") : (count > 1 ? "planes are" : "plane is");
  context.warn(fmt::format("{} {} turned by more than 2° from what their own points say, up to {:.2g}°: they may be two things in one, and their relations deserve a look ({} {})", count, what,
                           degrees(most), count > 1 ? "ids" : "id", names));
}

void warn_of_up(const Arrangement& result, Context& context) {
  constexpr double kSome = 0.02, kMost = 0.85;  // of the area: roofs from above may be four fifths
  if (result.two_dimensional) return;
  double level = 0, sloped = 0, all = 0;
  for (const ArrangedPlane& p : result.planes) {
    all += p.area;
    if (p.tag == "sloped") sloped += p.area;
    else if (p.tag == "floor" || p.tag == "ceiling" || p.tag == "horizontal") level += p.area;
  }
  if (level < kSome * all)
    context.warn("no plane is level with z up, which tags count on: right for a facade alone; otherwise turn the scan so that z is up");
  else if (sloped > kMost * all)
    context.warn("most planes are neither level nor plumb with z up, which tags count on: right for a landscape; otherwise turn the scan so that z is up");
}

void warn_of_curves(const Patches& patches, const Space& space, Context& context) {
  constexpr double kLeast = 2.0 * kPi / 180.0, kMost = 20.0 * kPi / 180.0;  // between strips of a curved surface
  constexpr double kFlush = 0.5 * kPi / 180.0, kMany = 0.6, kWhole = 0.8;   // no edge; of all edges; of the area that has edges, with most of that sort
  constexpr double kMuch = 0.2;                                             // of the area
  constexpr int kSeveral = 10;                                              // strips that are worth a word
  double bowed = 0, whole = 0;
  int strips = 0;
  for (const Patch& p : patches.patches) {
    whole += p.area;
    if (p.bowed) bowed += p.area, ++strips;
  }
  if (bowed > kMuch * whole) {
    context.warn(fmt::format("{:.0f} % of the planes' area is strips of curved surfaces: they are related to nothing", 100.0 * bowed / whole));
    return;
  }
  std::vector<double> gentle(patches.patches.size(), 0.0), all(patches.patches.size(), 0.0);
  for (const auto& [a, b] : patches.adjoining) {
    const Patch &pa = patches.patches[a], &pb = patches.patches[b];
    const double angle = line_angle(pa.fit.normal, pb.fit.normal), edge = std::sqrt(std::min(pa.area, pb.area));
    if (angle < kFlush) continue;
    for (const int p : {a, b}) {
      all[p] += edge;
      if (angle > kLeast && angle < kMost) gentle[p] += edge;
    }
  }
  double edges = 0, gentle_edges = 0, area = 0, curved = 0;
  for (std::size_t p = 0; p < all.size(); ++p) {
    edges += all[p];
    gentle_edges += gentle[p];
    if (all[p] > 0) area += patches.patches[p].area;
    if (gentle[p] > 0.5 * all[p]) curved += patches.patches[p].area;
  }
  if (gentle_edges > kMany * edges && curved > kWhole * area)
    context.warn(fmt::format("most {} meet their neighbours at 2 to 20 degrees, as strips of a curved {} do: if it is one, relations between them mean nothing",
                             space.is_2d() ? "lines" : "planes", space.is_2d() ? "line" : "surface"));
  else if (strips >= kSeveral)
    context.warn(fmt::format("{} strips of curved surfaces, as of columns, pipes or people, are related to nothing: small planes beside them may be such strips, too", strips));
}

}  // namespace unseen::planes
