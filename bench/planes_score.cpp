// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "bench/planes_score.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "unseen/planes/evaluate.h"

namespace unseen::bench {
namespace {

/// How well the turned furniture kept its orientation: median angle (deg) between the normal of its points'
/// planes and the true one, and the share of its points within 0.3°; points without a plane count as lost.
std::string turned_columns(const Loaded& loaded, const Detection& d) {
  if (!loaded.scene || loaded.scene->turned.empty()) return ",";
  const std::set<int> turned(loaded.scene->turned.begin(), loaded.scene->turned.end());
  std::vector<double> errors;
  for (std::size_t i = 0; i < d.plane_of_point.size(); ++i) {
    const int label = loaded.cloud.labels[i];
    if (turned.count(label) == 0) continue;
    const Vec3& normal = loaded.scene->planes[label].normal;
    if (std::abs(normal.z()) > 0.9) continue;  // the top is level whatever the turn
    errors.push_back(
        d.plane_of_point[i] < 0 ? 90.0 : degrees(line_angle(d.planes[d.plane_of_point[i]].normal, normal)));
  }
  if (errors.empty()) return ",";
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  const auto kept = std::count_if(errors.begin(), errors.end(), [](double e) { return e < 0.3; });
  return fmt::format("{:.3f},{:.2f}", *middle,
                     100.0 * static_cast<double>(kept) / static_cast<double>(errors.size()));
}

std::string mesh_columns(const Case& c, const Loaded& loaded, const Detection& d) {
  if (loaded.truth.triangles.empty()) return ",,,,,,,";
  Context context;
  const auto s = planes::evaluate_against_mesh(loaded.cloud.positions, d.plane_of_point, d.planes,
                                               loaded.truth, {c.scale, 500000, 1}, context);
  const auto columns = [](const planes::AssignmentScore& a) {
    return fmt::format("{:.4f},{:.2f},{:.2f}", degrees(a.angles_recalled.mean),
                       100 * a.angles_recalled.below_tenth, 100 * a.recall);
  };
  return fmt::format("{},{},{:.4f},{:.2f}", columns(s.as_assigned), columns(s.nearest),
                     degrees(s.as_assigned.angles.mean), 100 * s.as_assigned.angles.below_tenth);
}

/// Median distance of assigned points to their planes, in scales. Far above 1 means that the planes were
/// turned away from their points, or that points and planes are mixed up.
double median_distance(const Case& c, const Loaded& loaded, const Detection& d) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < d.plane_of_point.size(); ++i)
    if (d.plane_of_point[i] >= 0)
      distances.push_back(std::abs(d.planes[d.plane_of_point[i]].signed_distance(loaded.cloud.positions[i])) /
                          c.scale);
  if (distances.empty()) return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

}  // namespace

std::string csv_header() {
  return "case,method,points,scale,seconds,normals_seconds,peak_mb,planes,assigned_percent,median_distance_"
         "scales,mean_deg,below_01_"
         "percent,"
         "recall_percent,nearest_mean_deg,nearest_below_01_percent,nearest_recall_percent,all_mean_deg,"
         "all_below_01_percent,precision,recall_labels,f1,over,under,turned_error_deg,turned_kept_percent,"
         "near_misses,"
         "largest_relation_error_deg\n";
}

std::string csv_row(const Case& c, const Loaded& loaded, const std::string& method, const Detection& d,
                    double peak_mb, double largest_relation_error_deg) {
  const auto assigned =
      std::count_if(d.plane_of_point.begin(), d.plane_of_point.end(), [](int p) { return p >= 0; });
  const double count = static_cast<double>(d.plane_of_point.size());
  std::string labels = ",,,,";
  if ((c.labels || c.synth) && !loaded.cloud.labels.empty()) {
    const auto s = planes::evaluate_against_labels(d.plane_of_point, loaded.cloud.labels);
    labels = fmt::format("{:.3f},{:.3f},{:.3f},{},{}", s.precision, s.recall, s.f1, s.over_segmented,
                         s.under_segmented);
  }
  std::vector<double> angles;
  for (const double a : c.angles) angles.push_back(radians(a));
  return fmt::format("{},{},{},{},{:.3f},{:.3f},{:.0f},{},{:.2f},{:.3f},{},{},{},{},{}\n", c.name, method,
                     d.plane_of_point.size(), c.scale, d.seconds, d.normals_seconds, peak_mb, d.planes.size(),
                     100.0 * static_cast<double>(assigned) / count, median_distance(c, loaded, d),
                     mesh_columns(c, loaded, d), labels, turned_columns(loaded, d),
                     planes::count_near_misses(d.planes, angles),
                     largest_relation_error_deg < 0 ? "" : fmt::format("{:.2e}", largest_relation_error_deg));
}

std::string csv_failure(const Case& c, const std::string& method, const std::string& why) {
  return fmt::format("{},{},,{},{},,,,,,,,,,,,,,,,,,,,,,\n", c.name, method, c.scale, why);
}

}  // namespace unseen::bench
