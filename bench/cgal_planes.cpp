// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "bench/cgal_planes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Random.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/Shape_detection/Region_growing/Region_growing_on_point_set.h>
#include <CGAL/Shape_regularization/regularize_planes.h>
#include <CGAL/linear_least_squares_fitting_3.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>

#include <chrono>
#include <numeric>

namespace unseen::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PointNormal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Points = std::vector<PointNormal>;
using PointMap = CGAL::First_of_pair_property_map<PointNormal>;
using NormalMap = CGAL::Second_of_pair_property_map<PointNormal>;

constexpr std::size_t kNeighbours = 12, kSmallest = 50;
constexpr double kNormalAngle = 25.0;  // deg

class Clock {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Points to_cgal(const OrientedPoints& points) {
  Points out;
  out.reserve(points.positions.size());
  const Vec3& origin = points.positions.front();
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const Vec3 p = points.positions[i] - origin;
    const Vec3& n = points.normals[i];
    out.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), Kernel::Vector_3(n.x(), n.y(), n.z()));
  }
  return out;
}

Plane from_cgal(const Kernel::Plane_3& plane, const Vec3& origin) {
  const Vec3 normal(plane.a(), plane.b(), plane.c());
  return {normal.normalized(), (-plane.d()) / normal.norm() + normal.normalized().dot(origin)};
}

struct Grown {
  std::vector<Kernel::Plane_3> planes;
  std::vector<int> plane_of_point;
};

Grown grow(const Points& points, double scale) {
  namespace Set = CGAL::Shape_detection::Point_set;
  using Query = Set::K_neighbor_query<Kernel, Points, PointMap>;
  using Region = Set::Least_squares_plane_fit_region<Kernel, Points, PointMap, NormalMap>;
  using Sorting = Set::Least_squares_plane_fit_sorting<Kernel, Points, Query, PointMap>;
  Query query(points, kNeighbours, PointMap());
  Region region(points, scale, kNormalAngle, kSmallest, PointMap(), NormalMap());
  Sorting sorting(points, query, PointMap());
  sorting.sort();
  CGAL::Shape_detection::Region_growing<Points, Query, Region, Sorting::Seed_map> growing(
      points, query, region, sorting.seed_map());
  std::vector<std::vector<std::size_t>> regions;
  growing.detect(std::back_inserter(regions));
  Grown grown;
  grown.plane_of_point.assign(points.size(), -1);
  for (const auto& indices : regions) {
    std::vector<Kernel::Point_3> members;
    for (const std::size_t i : indices) {
      members.push_back(points[i].first);
      grown.plane_of_point[i] = static_cast<int>(grown.planes.size());
    }
    Kernel::Plane_3 plane;
    CGAL::linear_least_squares_fitting_3(members.begin(), members.end(), plane, CGAL::Dimension_tag<0>());
    grown.planes.push_back(plane);
  }
  return grown;
}

Detection finish(const Grown& grown, const OrientedPoints& points, double seconds) {
  Detection d;
  for (const auto& plane : grown.planes) d.planes.push_back(from_cgal(plane, points.positions.front()));
  d.plane_of_point = grown.plane_of_point;
  d.seconds = seconds;
  d.normals_seconds = points.normals_seconds;
  return d;
}

/// plane_index_map of regularize_planes.
struct IndexMap {
  using key_type = std::size_t;
  using value_type = int;
  using reference = int;
  using category = boost::readable_property_map_tag;
  const std::vector<int>* plane_of_point;
  friend int get(const IndexMap& map, std::size_t i) { return (*map.plane_of_point)[i]; }
};

}  // namespace

OrientedPoints orient(const std::vector<Vec3>& positions, const std::vector<Vec3f>& normals) {
  OrientedPoints out;
  out.positions = positions;
  std::size_t usable = 0;
  for (const Vec3f& n : normals) usable += std::abs(n.norm() - 1.0f) < 0.05f ? 1 : 0;
  if (!normals.empty() && usable == positions.size()) {
    for (const Vec3f& n : normals) out.normals.push_back(n.cast<double>().normalized());
    return out;
  }
  out.normals.assign(positions.size(), Vec3::UnitZ());
  Points points = to_cgal(out);
  const Clock clock;
  CGAL::pca_estimate_normals<CGAL::Sequential_tag>(
      points, kNeighbours, CGAL::parameters::point_map(PointMap()).normal_map(NormalMap()));
  out.normals_seconds = clock.seconds();
  for (std::size_t i = 0; i < points.size(); ++i)
    out.normals[i] = Vec3(points[i].second.x(), points[i].second.y(), points[i].second.z());
  return out;
}

Detection region_growing(const OrientedPoints& oriented, double scale) {
  const Points points = to_cgal(oriented);
  const Clock clock;
  const Grown grown = grow(points, scale);
  return finish(grown, oriented, clock.seconds());
}

Detection regularized_region_growing(const OrientedPoints& oriented, double scale) {
  const Points points = to_cgal(oriented);
  const Clock clock;
  Grown grown = grow(points, scale);
  CGAL::Shape_regularization::Planes::regularize_planes(
      grown.planes, points,
      CGAL::parameters::plane_map(CGAL::Identity_property_map<Kernel::Plane_3>())
          .point_map(PointMap())
          .plane_index_map(IndexMap{&grown.plane_of_point}));
  return finish(grown, oriented, clock.seconds());
}

Detection efficient_ransac(const OrientedPoints& oriented, double scale) {
  // detect() reorders its input and speaks of points by their new places: each carries its own index.
  using Indexed = std::tuple<Kernel::Point_3, Kernel::Vector_3, std::size_t>;
  using IndexedPoints = std::vector<Indexed>;
  using Traits = CGAL::Shape_detection::Efficient_RANSAC_traits<Kernel, IndexedPoints,
                                                                CGAL::Nth_of_tuple_property_map<0, Indexed>,
                                                                CGAL::Nth_of_tuple_property_map<1, Indexed>>;
  using Ransac = CGAL::Shape_detection::Efficient_RANSAC<Traits>;
  IndexedPoints points;
  points.reserve(oriented.positions.size());
  for (auto& [position, normal] : to_cgal(oriented)) points.emplace_back(position, normal, points.size());
  CGAL::get_default_random() = CGAL::Random(1);
  const Clock clock;
  Ransac ransac;
  ransac.set_input(points);
  ransac.template add_shape_factory<CGAL::Shape_detection::Plane<Traits>>();
  Ransac::Parameters parameters;
  parameters.probability = 0.01;
  parameters.min_points = kSmallest;
  parameters.epsilon = scale;
  parameters.cluster_epsilon = 2 * scale;
  parameters.normal_threshold = std::cos(radians(kNormalAngle));
  ransac.detect(parameters);
  const double seconds = clock.seconds();
  Grown grown;
  grown.plane_of_point.assign(points.size(), -1);
  for (const auto& shape : ransac.planes()) {
    for (const std::size_t i : shape->indices_of_assigned_points())
      grown.plane_of_point[std::get<2>(points[i])] = static_cast<int>(grown.planes.size());
    grown.planes.push_back(static_cast<Kernel::Plane_3>(*shape));
  }
  return finish(grown, oriented, seconds);
}

}  // namespace unseen::bench
