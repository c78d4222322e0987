// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/planes/synth.h"

#include <gtest/gtest.h>

#include <set>

#include "planes/evaluate/triangle_tree.h"
#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

SynthOptions small(const std::string& scene) {
  SynthOptions options;
  options.scene = scene;
  options.points = 20000;
  options.noise = 0.002;
  return options;
}

SynthScene make(const SynthOptions& options, int threads = 0) {
  Context context;
  context.threads = threads;
  return make_scene(options, context);
}

double distance_to_label(const TriangleMesh& mesh, int label, const Vec3& p) {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.labels[t] != label) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    best = std::min(
        best, (p - nearest_on_triangle(p, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c])).norm());
  }
  return best;
}

/// How many triangles the open segment from p to q crosses.
int crossings(const TriangleMesh& mesh, const Vec3& p, const Vec3& q) {
  int count = 0;
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Vec3 &a = mesh.vertices[ia], &b = mesh.vertices[ib], &c = mesh.vertices[ic];
    const Vec3 normal = (b - a).cross(c - a);
    const double from = normal.dot(p - a), to = normal.dot(q - a);
    if (from * to >= 0) continue;
    const Vec3 x = p + from / (from - to) * (q - p);
    if ((q - x).norm() > 1e-4 && (x - nearest_on_triangle(x, a, b, c)).norm() < 1e-9) ++count;
  }
  return count;
}

class SynthScenes : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, SynthScenes,
                         testing::Values("lhouse", "stairs", "room", "floorplan", "building"),
                         [](const auto& info) { return info.param; });

TEST_P(SynthScenes, TruthAgreesWithItself) {
  const SynthScene s = make(small(GetParam()));
  ASSERT_EQ(s.truth.labels.size(), s.truth.triangles.size());
  ASSERT_EQ(s.frames.size(), s.planes.size());
  for (std::size_t t = 0; t < s.truth.triangles.size(); ++t)
    for (const auto v : s.truth.triangles[t])
      EXPECT_LT(std::abs(s.planes[s.truth.labels[t]].signed_distance(s.truth.vertices[v])), 1e-9);
  for (std::size_t label = 0; label < s.planes.size(); ++label) {
    const Mat3& axes = s.axes.at(s.frames[label]);
    double best = 1;
    for (int k = 0; k < 3; ++k) best = std::min(best, line_angle(axes.col(k), s.planes[label].normal));
    EXPECT_LT(best, 1e-9) << "plane " << label << " is not in its frame";
  }
}

TEST_P(SynthScenes, PointsLieOnTheSurfaceOfTheirLabel) {
  SynthOptions options = small(GetParam());
  const SynthScene s = make(options);
  ASSERT_EQ(s.cloud.size(), 20000u);
  const TriangleTree tree(s.truth);
  std::size_t other = 0;
  for (std::size_t i = 0; i < s.cloud.size(); ++i) {
    const Vec3& p = s.cloud.positions[i];
    EXPECT_LT(distance_to_label(s.truth, s.cloud.labels[i], p), 6 * options.noise);
    if (s.truth.labels[tree.nearest(p).triangle] != s.cloud.labels[i]) ++other;  // beside an edge, by noise
  }
  EXPECT_LT(other, s.cloud.size() / 50);
}

TEST_P(SynthScenes, SameSeedSameBytesAtAnyThreadCount) {
  SynthOptions options = small(GetParam());
  options.outliers = 0.05;
  options.uneven = 0.5;
  options.registration = 0.01;
  const SynthScene one = make(options, 1);
  for (const int threads : {1, 2, 4}) {
    const SynthScene other = make(options, threads);
    EXPECT_TRUE(one.cloud.positions == other.cloud.positions);
    EXPECT_TRUE(one.cloud.labels == other.cloud.labels);
  }
  options.seed = 2;
  EXPECT_FALSE(one.cloud.positions == make(options, 2).cloud.positions);
}

TEST_P(SynthScenes, OutliersAreCountedAndUnlabelled) {
  SynthOptions options = small(GetParam());
  options.outliers = 0.1;
  options.normals = true;
  const SynthScene s = make(options);
  EXPECT_EQ(s.cloud.size(), 20000u);
  EXPECT_EQ(s.cloud.normals.size(), 20000u);
  EXPECT_EQ(std::count(s.cloud.labels.begin(), s.cloud.labels.end(), -1), 2000);
}

TEST(Synth, TurnAndShareAreWhatWasAskedFor) {
  for (const char* scene : {"room", "floorplan", "building"})
    for (const double turn : {3.0, 12.0, 33.0})
      for (const double share : {0.01, 0.10}) {
        SynthOptions options = small(scene);
        options.turn = turn;
        options.share = share;
        const SynthScene s = make(options);
        const std::set<int> turned(s.turned.begin(), s.turned.end());
        const auto count = std::count_if(s.cloud.labels.begin(), s.cloud.labels.end(),
                                         [&](int label) { return turned.count(label) > 0; });
        EXPECT_NEAR(static_cast<double>(count) / 20000, share, 0.1 * share) << scene;
        ASSERT_EQ(s.axes.size(), 2u);
        EXPECT_NEAR(line_angle(s.axes[0].col(0), s.axes[1].col(0)), radians(turn), 1e-12);
        for (const int label : turned) EXPECT_EQ(s.frames[label], 1);
      }
}

TEST(Synth, NoShareNoTurnedFurniture) {
  SynthOptions options = small("room");
  options.share = 0;
  const SynthScene s = make(options);
  EXPECT_TRUE(s.turned.empty());
  EXPECT_EQ(s.axes.size(), 1u);
}

TEST(Synth, NoiseIsAlongTheRay) {
  SynthOptions options = small("room");
  options.scanners = 1;
  options.noise = 0.01;
  const SynthScene s = make(options);
  ASSERT_TRUE(s.cloud.viewpoint.has_value());
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < s.cloud.size(); ++i) {
    const Plane& plane = s.planes[s.cloud.labels[i]];
    const Vec3 ray = (s.cloud.positions[i] - *s.cloud.viewpoint).normalized();
    const double error = plane.signed_distance(s.cloud.positions[i]) / plane.normal.dot(ray);
    sum += error;
    squares += error * error;
  }
  const double n = static_cast<double>(s.cloud.size());
  EXPECT_NEAR(sum / n, 0.0, 0.0005);
  EXPECT_NEAR(std::sqrt(squares / n), 0.01, 0.0003);
}

TEST(Synth, NothingLiesBehindWhatTheScannerSees) {
  for (const char* scene : {"room", "lhouse", "stairs"}) {
    SynthOptions options = small(scene);
    options.scanners = 1;
    options.noise = 0;
    const SynthScene s = make(options);
    int blocked = 0;
    for (const Vec3& p : s.cloud.positions) blocked += crossings(s.truth, *s.cloud.viewpoint, p) > 0 ? 1 : 0;
    EXPECT_LE(blocked, 4) << scene;  // rays that graze an edge, in Embree's single precision
    EXPECT_GT(crossings(s.truth, *s.cloud.viewpoint, *s.cloud.viewpoint - Vec3(0, 0, 100)), 0);
  }
}

TEST(Synth, BadOptionsAreNamed) {
  for (const auto& [field, change] : std::vector<std::pair<std::string, std::function<void(SynthOptions&)>>>{
           {"scene", [](SynthOptions& o) { o.scene = "castle"; }},
           {"points", [](SynthOptions& o) { o.points = 0; }},
           {"share", [](SynthOptions& o) { o.share = 0.9; }},
           {"noise", [](SynthOptions& o) { o.noise = -1; }}}) {
    SynthOptions options = small("room");
    change(options);
    try {
      make(options);
      ADD_FAILURE() << field;
    } catch (const InputError& e) {
      EXPECT_EQ(e.field, field);
    }
  }
}

}  // namespace
}  // namespace unseen::planes
