// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

#include "planes/scenes.h"
#include "unseen/core/random.h"
#include "unseen/planes/synth.h"

namespace unseen::planes {
namespace {

struct Stroke {
  double length = 0, angle = 0;  ///< angle in deg in [0, 180), with y up
};

/// The straight strokes of the paths `m x,y dx,dy dx,dy …` of an SVG, whose y points down.
std::vector<Stroke> strokes_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::regex path("[^a-z]d=\"m ([^\"]*)\"");
  std::vector<Stroke> strokes;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), path); it != std::sregex_iterator(); ++it) {
    std::istringstream pairs((*it)[1]);
    std::string pair;
    pairs >> pair;  // where it starts
    while (pairs >> pair) {
      const std::size_t comma = pair.find(',');
      const double dx = std::stod(pair.substr(0, comma)), dy = -std::stod(pair.substr(comma + 1));
      strokes.push_back({std::hypot(dx, dy), std::fmod(degrees(std::atan2(dy, dx)) + 360, 180)});
    }
  }
  return strokes;
}

/// Angle (deg) between two lines given by their angles.
double apart(double a, double b) {
  const double d = std::fmod(std::abs(a - b), 180.0);
  return std::min(d, 180 - d);
}

struct Drawn {
  Arrangement result;
  /// Length of the lines found within `tolerance` of an angle; `flip` = the drawing's y against the SVG's.
  double length_at(double angle, double tolerance, bool flip) const {
    double sum = 0;
    for (const ArrangedPlane& p : result.planes) {
      const Vec3 d = (*p.segment)[1] - (*p.segment)[0];
      if (apart(degrees(std::atan2(flip ? -d.y() : d.y(), d.x())), angle) < tolerance) sum += d.norm();
    }
    return sum;
  }
};

Drawn draw(const std::filesystem::path& file, const Options& options) {
  const auto source = io::open_points(file);
  Context context;
  Drawn d{find_planes(*source, options, context)};
  EXPECT_TRUE(d.result.two_dimensional);
  std::cout << d.result.planes.size() << " lines, " << d.result.frames.size() << " frames, scale "
            << d.result.scale << ";";
  for (const ArrangedPlane& p : d.result.planes) {
    const Vec3 v = (*p.segment)[1] - (*p.segment)[0];
    std::cout << " " << std::fmod(degrees(std::atan2(v.y(), v.x())) + 360, 180) << "/" << v.norm();
  }
  std::cout << "\n";
  return d;
}

/// Every stroke of the truth has lines of its orientation within 0.3°, about as long.
void expect_strokes(const Drawn& drawn, const std::vector<Stroke>& strokes, double tolerance) {
  std::map<int, double> length;  // by angle, in steps of 0.5°
  for (const Stroke& s : strokes) length[static_cast<int>(std::lround(2 * s.angle)) % 360] += s.length;
  double missing[2] = {0, 0};
  for (const auto& [angle, expected] : length)
    for (const bool flip : {false, true})
      missing[flip] += drawn.length_at(0.5 * angle, tolerance, flip) < 0.6 * expected;
  EXPECT_EQ(std::min(missing[0], missing[1]), 0);
}

/// Length of the lines along the turned rectangle's two directions, and along the upright one's, at least.
struct Rectangles {
  double turned = 0, upright = 0;
  std::size_t frames = 0;
};

std::optional<Rectangles> two_rectangles(const Options& options, double tolerance) {
  const auto file = test::shared_scan("rapter/two_rectangles.ply"),
             truth = test::shared_scan("rapter/two_cubes_gt.svg");
  if (file.empty() || truth.empty()) return std::nullopt;
  const std::vector<Stroke> strokes = strokes_of(truth);
  EXPECT_EQ(strokes.size(), 8u);
  const double turn = strokes.at(4).angle;  // of the turned one's longest side
  EXPECT_NEAR(apart(turn, strokes.at(5).angle), 90, 0.5);
  EXPECT_GT(apart(turn, 0), 10);
  const Drawn drawn = draw(file, options);
  Rectangles r;
  for (const bool flip : {false, true})
    r.turned = std::max(r.turned, std::min(drawn.length_at(turn, tolerance, flip),
                                           drawn.length_at(turn + 90, tolerance, flip)));
  r.upright = std::min(drawn.length_at(0, tolerance, false), drawn.length_at(90, tolerance, false));
  r.frames = drawn.result.frames.size();
  return r;
}

TEST(Drawings, TheTurnedRectangleKeepsItsOrientation) {
  for (const Options& options : {test::with_scale(0.02), Options()}) {
    const auto r = two_rectangles(options, 0.3);
    if (!r) GTEST_SKIP() << test::kNoScan;
    EXPECT_GT(r->turned, 0.3);
    EXPECT_GT(r->upright, 0.3);
    EXPECT_GE(r->frames, 2u);
  }
}

TEST(Drawings, TheChamferKeepsItsOrientation) {
  const auto file = test::shared_scan("rapter/increasing-noise-0.ply"),
             truth = test::shared_scan("rapter/increasing-noise-0_gt.svg");
  if (file.empty() || truth.empty()) GTEST_SKIP() << test::kNoScan;
  const std::vector<Stroke> strokes = strokes_of(truth);
  ASSERT_EQ(strokes.size(), 5u);
  ASSERT_NEAR(strokes[1].angle, 45, 0.1);
  const Drawn drawn = draw(file, Options());
  std::vector<Stroke> square, chamfer;
  for (const Stroke& s : strokes) (std::abs(apart(s.angle, 45)) < 1 ? chamfer : square).push_back(s);
  expect_strokes(drawn, square, 0.3);
  // No angle of Θ ties the chamfer, and its own 46 points fix it no better than to about 1°.
  expect_strokes(drawn, chamfer, 2.0);
  Options with_45;
  with_45.angles = {45};
  expect_strokes(draw(file, with_45), strokes, 0.3);
}

TEST(Drawings, OverviewHasFourFrames) {
  const auto file = test::shared_scan("rapter/overview_sigg2d.ply");
  if (file.empty()) GTEST_SKIP() << test::kNoScan;
  Options options;
  options.angles = {60, 90};
  EXPECT_EQ(draw(file, options).result.frames.size(), 4u);
  options.scale = 0.02;
  EXPECT_EQ(draw(file, options).result.frames.size(), 4u);
}

/// A square whose fourth side was seen by scans that are turned about its end by up to `widest` degrees, and by `least` at least.
PointCloud square_with_a_fan(double least, double widest) {
  constexpr int kScans = 5, kPoints = 80;
  Random random(1);
  PointCloud cloud;
  const auto side = [&](const Vec3& from, double degrees_turned, int points) {
    const Vec3 along(std::cos(radians(degrees_turned)), std::sin(radians(degrees_turned)), 0), across(-along.y(), along.x(), 0);
    for (int i = 0; i < points; ++i) cloud.positions.push_back(from + random.uniform() * along + 0.003 * random.normal() * across);
  };
  side({0, 0, 0}, 0, kScans * kPoints);
  side({0, 0, 0}, 90, kScans * kPoints);
  side({1, 0, 0}, 90, kScans * kPoints);
  for (int scan = 0; scan < kScans; ++scan) side({0, 1, 0}, least + (widest - least) * scan / (kScans - 1), kPoints);
  return cloud;
}

/// Pixels of quadrilaterals that each are skewed by chance, 3 px wide, and the true direction of each line's pixels.
PointCloud drawn_quadrilaterals(int columns, int rows, std::vector<Vec3>& along) {
  Random random(5);
  std::map<std::pair<int, int>, Vec3> pixels;
  for (int a = 0; a < columns; ++a)
    for (int b = 0; b < rows; ++b) {
      std::vector<Vec3> corners;
      for (const auto& [x, y] : {std::pair(-80, -90), std::pair(80, -90), std::pair(80, 90), std::pair(-80, 90)})
        corners.emplace_back(130 + 205 * a + x + 24 * random.uniform() - 12, 130 + 230 * b + y + 24 * random.uniform() - 12, 0);
      for (int k = 0; k < 4; ++k) {
        const Vec3 from = corners[k], way = corners[(k + 1) % 4] - from, across(-way.y() / way.norm(), way.x() / way.norm(), 0);
        for (double t = 0.03; t < 0.97; t += 0.3 / way.norm())
          for (int w = -1; w <= 1; ++w) {
            const Vec3 p = from + t * way + w * across;
            pixels.emplace(std::pair(static_cast<int>(std::round(p.x())), static_cast<int>(std::round(p.y()))), way.normalized());
          }
      }
    }
  PointCloud cloud;
  for (const auto& [at, way] : pixels) cloud.positions.emplace_back(at.first, at.second, 0), along.push_back(way);
  return cloud;
}

// Among many lines of any direction each is near a right angle to some; pixels tell better than that.
TEST(Drawings, LinesOfManyDirectionsAreNotForcedIntoLine) {
  std::vector<Vec3> along;
  const test::Run r = test::run(drawn_quadrilaterals(4, 3, along), Options());
  ASSERT_TRUE(r.result.two_dimensional);
  std::size_t off = 0;
  for (std::size_t i = 0; i < along.size(); ++i)
    if (const int plane = r.plane_of_point[i]; plane >= 0) off += std::asin(std::abs(r.result.planes[plane].plane.normal.dot(along[i]))) > radians(1.0);
  EXPECT_LT(static_cast<double>(off), 0.03 * static_cast<double>(along.size()));
}

TEST(Drawings, ScansTurnedAgainstEachOtherMakeNoFrame) {
  const test::Run fan = test::run(square_with_a_fan(0.0, 8.0), test::with_scale(0.05));
  EXPECT_EQ(fan.result.frames.size(), 1u);
  const test::Run turned = test::run(square_with_a_fan(4.0, 4.0), test::with_scale(0.05));
  EXPECT_EQ(turned.result.frames.size(), 2u);  // by as much, but clearly
}

TEST(Drawings, AFloorplanKeepsItsTurnedFurniture) {
  SynthOptions synth;
  synth.scene = "floorplan";
  synth.points = 10'000;
  synth.turn = 12;
  synth.share = 0.08;
  Context context;
  const SynthScene scene = make_scene(synth, context);
  const test::Run r = test::run(scene.cloud, Options());
  ASSERT_TRUE(r.result.two_dimensional);
  std::size_t turned = 0, right = 0;
  for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
    const int label = scene.cloud.labels[i], plane = r.plane_of_point[i];
    if (label < 0 || std::find(scene.turned.begin(), scene.turned.end(), label) == scene.turned.end())
      continue;
    ++turned;
    right += plane >= 0 &&
             line_angle(r.result.planes[plane].plane.normal, scene.planes[label].normal) < radians(0.3);
  }
  ASSERT_GT(turned, 500u);
  EXPECT_GT(static_cast<double>(right), 0.9 * static_cast<double>(turned));
}

TEST(Drawings, LinesWithoutAnyNoise) {
  PointCloud cloud;
  for (int i = 0; i < 500; ++i) {
    cloud.positions.emplace_back(0.008 * i, 0, 0);
    cloud.positions.emplace_back(0, 0.008 * i, 0);
  }
  const test::Run r = test::run(cloud, test::with_scale(0.05));
  ASSERT_EQ(r.result.planes.size(), 2u);
  EXPECT_EQ(r.result.frames.size(), 1u);
}

/// The pixels of a frame of four long lines and of `dashes` short ones, all turned by `turn` (deg).
PointCloud scanned_plan(double turn, int dashes) {
  const Vec3 along(std::cos(radians(turn)), std::sin(radians(turn)), 0), up(-along.y(), along.x(), 0);
  PointCloud cloud;
  const auto line = [&](double x, double y, const Vec3& direction, int length) {
    const Vec3 from = x * along + y * up;
    for (int i = 0; i < length; ++i) {
      const Vec3 at = from + i * direction;
      cloud.positions.emplace_back(std::round(at.x()), std::round(at.y()), 0);
    }
  };
  for (const double y : {0.0, 500.0}) line(0, y, along, 700);
  for (const double x : {0.0, 700.0}) line(x, 0, up, 500);
  for (int i = 0; i < dashes; ++i) line(40 + 80 * (i % 8), 40 + 60 * (i / 8), i % 2 ? along : up, 9);
  return cloud;
}

/// Short strokes lie in one row of pixels each, without any noise: they know their direction no better for it.
TEST(Drawings, ShortStrokesDoNotLevelAScannedPlan) {
  for (const double turn : {0.7, 2.2}) {
    SCOPED_TRACE(turn);
    const test::Run r = test::run(scanned_plan(turn, 64), test::with_scale(2.5));
    int lines = 0;
    for (const ArrangedPlane& p : r.result.planes) {
      if (p.area < 300) continue;
      ++lines;
      const Vec3& n = p.plane.normal;
      EXPECT_NEAR(std::remainder(degrees(std::atan2(n.y(), n.x())) - turn, 90.0), 0.0, 0.05);
    }
    EXPECT_EQ(lines, 4);
  }
}

/// Where others end on it normals are theirs, and the line's patches end: its parts grow together again.
TEST(Drawings, AWallThatOthersEndOnIsOneLine) {
  PointCloud cloud;
  const auto bar = [&](int x, int y, int width, int height) {
    for (int i = 0; i < width; ++i)
      for (int k = 0; k < height; ++k) cloud.positions.emplace_back(x + i, y + k, 0);
  };
  bar(0, 0, 900, 3);
  for (const int x : {200, 400, 650}) bar(x, 3, 3, 300);
  const test::Run r = test::run(cloud, test::with_scale(2.5));
  ASSERT_EQ(r.result.planes.size(), 4u);
  double longest = 0;
  for (const ArrangedPlane& p : r.result.planes) longest = std::max(longest, p.area);
  EXPECT_NEAR(longest, 900, 2);
}

/// Their corners say how exactly houses are built, and so how little turns one against another by chance.
TEST(Drawings, HousesOfASitePlanKeepTheirTurns) {
  PointCloud cloud;
  Random random(6);
  std::vector<std::pair<Vec3, double>> houses;
  for (const double turn : {0.0, 0.8, 1.6, 2.5, 3.3, 4.1}) {
    const Vec3 center(25.0 * static_cast<double>(houses.size() % 3), 25.0 * static_cast<double>(houses.size() / 3), 0);
    houses.emplace_back(center, turn);
    for (int i = 0; i < 800; ++i) {
      const double along = 0.05 * i, x = std::clamp(along < 20 ? along : 32 - along, 0.0, 12.0), y = std::clamp(along < 20 ? along - 12 : 40 - along, 0.0, 8.0);
      const Vec3 p(x - 6 + 0.004 * random.normal(), y - 4 + 0.004 * random.normal(), 0);
      cloud.positions.push_back(center + Eigen::AngleAxisd(radians(turn), Vec3::UnitZ()) * p);
    }
  }
  const Arrangement a = test::run(cloud, {}).result;
  EXPECT_EQ(a.planes.size(), 24u);
  for (const ArrangedPlane& p : a.planes) {
    const Vec3 d = (*p.segment)[1] - (*p.segment)[0], middle = 0.5 * ((*p.segment)[0] + (*p.segment)[1]);
    const auto house = std::min_element(houses.begin(), houses.end(), [&](const auto& h, const auto& g) { return (h.first - middle).norm() < (g.first - middle).norm(); });
    const double angle = degrees(std::atan2(d.y(), d.x()));
    EXPECT_LT(std::min(apart(angle, house->second), apart(angle, house->second + 90)), 0.2) << house->second;
  }
}

/// Points of a drawing in a plane other than z = 0 are noticed, and the lines lie in it.
TEST(Drawings, AnyCoordinatePlaneWillDo) {
  SynthOptions synth;
  synth.scene = "floorplan";
  synth.points = 5'000;
  Context context;
  const SynthScene scene = make_scene(synth, context);
  const test::Run flat = test::run(scene.cloud, test::with_scale(0.05));
  PointCloud upright;
  for (const Vec3& p : scene.cloud.positions) upright.positions.emplace_back(7.5, p.x(), p.y());
  const test::Run stood = test::run(upright, test::with_scale(0.05));
  EXPECT_TRUE(stood.result.two_dimensional);
  EXPECT_EQ(stood.result.planes.size(), flat.result.planes.size());
  for (const ArrangedPlane& p : stood.result.planes) {
    EXPECT_EQ(p.plane.normal.x(), 0.0);
    ASSERT_TRUE(p.segment);
    for (const Vec3& end : *p.segment) EXPECT_NEAR(end.x(), 7.5, 1e-6);
  }
}

/// Two walls side by side, and one beside neither: only the first two face each other.
TEST(Drawings, LinesFaceEachOtherInAnyCoordinatePlane) {
  for (int flat = 0; flat < 3; ++flat) {
    const int u = flat == 0 ? 1 : 0, v = flat == 2 ? 1 : 2;
    PointCloud cloud;
    Random random(4);
    const auto wall = [&](double at, double from, double to) {
      for (int i = 0; i < 600; ++i) {
        Vec3 p = Vec3::Constant(7.5);
        p[u] = at + 0.002 * random.normal();
        p[v] = random.uniform(from, to);
        cloud.positions.push_back(p);
      }
    };
    wall(0, 0, 2);
    wall(1, 0, 2);
    wall(0.5, 3, 5);
    const Arrangement a = test::run(cloud, test::with_scale(0.05)).result;
    SCOPED_TRACE(flat);
    EXPECT_EQ(flat_axis(a), flat);
    ASSERT_EQ(a.planes.size(), 3u);
    ASSERT_EQ(a.distances.size(), 1u);
    EXPECT_NEAR(a.distances[0].distance, 1, 0.002);
  }
}

}  // namespace
}  // namespace unseen::planes
