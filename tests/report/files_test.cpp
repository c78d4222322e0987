// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/planes_files.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "report/palette.h"
#include "report/sample.h"
#include "unseen/core/error.h"
#include "unseen/report/points_file.h"

namespace unseen::report {
namespace {

PointSample points_of(const planes::Arrangement& a) {
  PointSample sample;
  for (std::size_t p = 0; p < a.planes.size(); ++p)
    for (const auto& ring : a.planes[p].polygon) {
      const std::vector<int> membership(ring.size(), static_cast<int>(p));
      sample.add(ring, membership);
    }
  const std::vector<Vec3> loose = {a.planes[0].polygon.empty() ? Vec3::Zero() : a.planes[0].polygon[0][0]};
  sample.add(loose, std::vector<int>{-1});
  return sample;
}

tinygltf::Model load(const std::string& glb) {
  tinygltf::TinyGLTF reader;
  tinygltf::Model model;
  std::string error, warning;
  EXPECT_TRUE(reader.LoadBinaryFromMemory(&model, &error, &warning,
                                          reinterpret_cast<const unsigned char*>(glb.data()),
                                          static_cast<unsigned>(glb.size())))
      << error;
  EXPECT_TRUE(error.empty() && warning.empty()) << error << warning;
  return model;
}

std::vector<Vec3> positions(const tinygltf::Model& model, const tinygltf::Node& node) {
  const auto& primitive = model.meshes.at(static_cast<std::size_t>(node.mesh)).primitives.at(0);
  const auto& accessor = model.accessors.at(static_cast<std::size_t>(primitive.attributes.at("POSITION")));
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < accessor.count; ++i) {
    float xyz[3];
    std::memcpy(xyz, model.buffers[0].data.data() + view.byteOffset + 12 * i, 12);
    out.emplace_back(xyz[0], xyz[1], xyz[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_GE(xyz[k], accessor.minValues.at(k));
      EXPECT_LE(xyz[k], accessor.maxValues.at(k));
    }
  }
  return out;
}

TEST(SceneGlb, ReadsBackWithNamesAndCoordinates) {
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(500000.25, 5400000.75, 321.5)}) {
    const planes::Arrangement a = sample_room(offset);
    const tinygltf::Model model = load(planes_glb(a, points_of(a)));
    ASSERT_EQ(model.nodes.size(), 1 + a.planes.size() + 1);
    EXPECT_EQ(model.nodes[1].name, "plane 0 (floor)");
    EXPECT_EQ(model.nodes[4].name, "plane 3");
    EXPECT_EQ(model.nodes.back().name, "points");
    EXPECT_EQ(model.materials.size(), a.frames.size() + 1);
    const auto& stored = model.nodes[0].extras.Get("offset");
    const Vec3 back(stored.Get(0).GetNumberAsDouble(), stored.Get(1).GetNumberAsDouble(),
                    stored.Get(2).GetNumberAsDouble());
    for (std::size_t p = 0; p < a.planes.size(); ++p) {
      std::vector<Vec3> truth;
      for (const auto& ring : a.planes[p].polygon) truth.insert(truth.end(), ring.begin(), ring.end());
      const auto found = positions(model, model.nodes[p + 1]);
      ASSERT_EQ(found.size(), truth.size());
      for (std::size_t i = 0; i < truth.size(); ++i)
        EXPECT_LT((found[i] + back - truth[i]).norm(), 1e-6 * 6.0);
    }
    EXPECT_EQ(positions(model, model.nodes.back()).size(), points_of(a).positions.size());
  }
}

TEST(SceneGlb, RootTurnsZUpIntoYUp) {
  const tinygltf::Model model = load(planes_glb(sample_room(), {}));
  const auto& q = model.nodes[0].rotation;
  const Eigen::Quaterniond rotation(q.at(3), q.at(0), q.at(1), q.at(2));
  EXPECT_LT((rotation * Vec3::UnitZ() - Vec3::UnitY()).norm(), 1e-7);
  EXPECT_LT((rotation * Vec3::UnitX() - Vec3::UnitX()).norm(), 1e-7);
}

TEST(SceneGlb, DrawingsAndNothingAreFilesToo) {
  const tinygltf::Model drawing = load(planes_glb(sample_drawing(), {}));
  ASSERT_EQ(drawing.nodes.size(), 3u);
  EXPECT_EQ(drawing.meshes[0].primitives[0].mode, TINYGLTF_MODE_LINE);
  EXPECT_EQ(load(planes_glb({}, {})).nodes.size(), 1u);
}

std::size_t lines_starting(const std::string& text, const std::string& with) {
  std::istringstream lines(text);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) count += line.rfind(with, 0) == 0 ? 1 : 0;
  return count;
}

TEST(PlanesPly, HeaderCountsWhatFollows) {
  const std::string text = planes_ply(sample_room());
  EXPECT_NE(text.find("element vertex 24\n"), std::string::npos);  // five rectangles and a hole
  EXPECT_NE(text.find("element face 16\n"), std::string::npos);    // 4·2 and a floor with a hole: 8
  EXPECT_EQ(lines_starting(text, "3 "), 16u);
  const std::string drawing = planes_ply(sample_drawing());
  EXPECT_NE(drawing.find("element edge 2\n"), std::string::npos);
  EXPECT_EQ(drawing.substr(drawing.find("end_header\n") + 11).substr(0, 19), "0.5 -1 0 0 114 178\n");
}

TEST(PlanesObj, OneGroupAPlaneOneMaterialAFrame) {
  const std::string text = planes_obj(sample_room(), "planes.mtl");
  EXPECT_EQ(lines_starting(text, "g plane_"), 5u);
  EXPECT_EQ(lines_starting(text, "g plane_0_floor"), 1u);
  EXPECT_EQ(lines_starting(text, "o plane_0_floor"), 1u);
  EXPECT_EQ(lines_starting(text, "usemtl frame_0"), 4u);
  EXPECT_EQ(lines_starting(text, "f "), 16u);
  EXPECT_EQ(lines_starting(planes_mtl(sample_room()), "newmtl frame_"), 2u);
  EXPECT_EQ(lines_starting(planes_obj(sample_drawing(), "planes.mtl"), "l "), 2u);
}

TEST(PointSample, KeepsAnEvenShareInOrder) {
  PointSample sample;
  sample.limit = 100;
  std::vector<Vec3> block;
  std::vector<int> planes;
  for (int i = 0; i < 1234; ++i) {
    block.emplace_back(i, 0, 0);
    planes.push_back(i % 7 - 1);
  }
  block[5].x() = std::nan("");
  for (std::size_t at = 0; at < block.size(); at += 100) {
    const std::size_t count = std::min<std::size_t>(100, block.size() - at);
    sample.add(std::span(block).subspan(at, count), std::span(planes).subspan(at, count));
  }
  EXPECT_EQ(sample.seen, 1233u);
  EXPECT_EQ(sample.step, 16u);
  ASSERT_EQ(sample.positions.size(), (1233u + 15) / 16);
  for (std::size_t i = 1; i < sample.positions.size(); ++i) {
    EXPECT_EQ(sample.positions[i].x(),
              16.0 * static_cast<double>(i) + 1);  // one more: the sixth is not finite
    EXPECT_EQ(sample.plane_of_point[i], static_cast<int>(sample.positions[i].x()) % 7 - 1);
  }
}

TEST(PointsFile, HoldsEveryPointInOrder) {
  const auto path = std::filesystem::temp_directory_path() / "unseen_points_file_test.ply";
  constexpr int kPoints = 100000;
  {
    PointsFile file(path);
    for (int first = 0; first < kPoints; first += 40000) {
      std::vector<Vec3> block;
      std::vector<int> planes;
      for (int i = first; i < std::min(first + 40000, kPoints); ++i) {
        block.emplace_back(i + 0.1, i % 3 ? 1e7 / 3 : std::nan(""), -i);
        planes.push_back(i % 4 - 1);
      }
      file.add(block, planes);
    }
    file.finish({0, 7, 5});
  }
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "ply");
  while (line != "end_header" && std::getline(file, line))
    if (line.rfind("element", 0) == 0) {
      EXPECT_EQ(line, "element vertex 100000");
    }
  for (int i = 0; i < kPoints; ++i) {
    double xyz[3];
    std::int32_t ids[2];
    file.read(reinterpret_cast<char*>(xyz), sizeof(xyz)).read(reinterpret_cast<char*>(ids), sizeof(ids));
    ASSERT_EQ(xyz[0], i + 0.1);
    ASSERT_EQ(std::isnan(xyz[1]), i % 3 == 0);
    ASSERT_EQ(ids[0], i % 4 - 1);
    ASSERT_EQ(ids[1], (std::array<int, 4>{-1, 0, 7, 5})[static_cast<std::size_t>(i % 4)]);
  }
  EXPECT_TRUE(file && file.peek() == EOF);
  std::filesystem::remove(path);
  EXPECT_THROW(PointsFile("/dev/null/points.ply"), InputError);
}

TEST(Palette, FramesStayApart) {
  std::set<std::string> seen;
  for (int frame = -1; frame < 32; ++frame) EXPECT_TRUE(seen.insert(hex(frame_color(frame))).second) << frame;
  EXPECT_EQ(hex({0, 255, 16}), "#00ff10");
  EXPECT_NEAR(linear({255, 0, 188})[2], 0.5029, 1e-4);
}

}  // namespace
}  // namespace unseen::report
