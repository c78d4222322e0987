// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/mesh.h"

#include <cstring>

#include "io/samples.h"

namespace unseen::io {
namespace {

const char* const kSquare = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n";

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum +=
        0.5 *
        (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]).norm();
  return sum;
}

TEST(Mesh, ObjPolygonsNegativeIndicesGroupsAndDegenerateFaces) {
  const TriangleMesh mesh = read_mesh_in_memory(
      std::string(kSquare) +
          "v 500000.123456789 0 1\ng a\nf 1/1/1 2/2/1 3//1 4\ng b\nf -5 -4 -3\nf 1 1 2\ng a\nf 1 2 5\n",
      "a.obj");
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.labels, (std::vector<std::int32_t>{0, 0, 1, 0}));
  EXPECT_EQ(mesh.vertices[4].x(), 500000.123456789);
}

TEST(Mesh, ObjLinesMayContinue) {
  const TriangleMesh mesh = read_mesh_in_memory(
      "v 0 \\\n0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 \\\r\n 3 \\\n4\nf 1 2 3 \\", "a.obj");
  EXPECT_DOUBLE_EQ(area(mesh), 6.0);
}

TEST(Mesh, ADentedPolygonKeepsItsArea) {
  const TriangleMesh mesh =
      read_mesh_in_memory("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n", "a.obj");
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_DOUBLE_EQ(area(mesh), 10.0);
}

TEST(Mesh, OffStlAndPly) {
  EXPECT_DOUBLE_EQ(
      area(read_mesh_in_memory("OFF # remark\n4 1 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n4 0 1 2 3\n", "a.off")),
      4.0);
  EXPECT_DOUBLE_EQ(
      area(read_mesh_in_memory("solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\n"
                               "vertex 2 2 0\nendloop\nendfacet\nendsolid\n",
                               "a.stl")),
      2.0);
  EXPECT_DOUBLE_EQ(
      area(read_mesh_in_memory("SOLID S\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 2 0 0\n"
                               "VERTEX 2 2 0\nENDLOOP\nENDFACET\nENDSOLID\n",
                               "a.stl")),
      2.0);
  std::string stl(80, ' ');
  put<std::uint32_t>(stl, 1);
  for (const float v : {0, 0, 1, 0, 0, 0, 2, 0, 0, 2, 2, 0}) put<float>(stl, v);
  put<std::uint16_t>(stl, 0);
  EXPECT_DOUBLE_EQ(area(read_mesh_in_memory(stl, "a.stl")), 2.0);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 1\n"
      "property list uchar int vertex_indices\nproperty int label\nend_header\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n4 "
      "0 1 2 3 7\n";
  const TriangleMesh mesh = read_mesh_in_memory(ply, "a.ply");
  EXPECT_DOUBLE_EQ(area(mesh), 4.0);
  EXPECT_EQ(mesh.labels, (std::vector<std::int32_t>{7, 7}));
}

TEST(Mesh, SamplesAreUniformSeededAndLabelled) {
  const std::string obj = std::string(kSquare) + "v 0 0 1\nv 1 0 1\nv 0 1 1\ng a\nf 1 2 3 4\ng b\nf 5 6 7\n";
  const TriangleMesh mesh = read_mesh_in_memory(obj, "a.obj");
  const PointCloud cloud = sample_mesh(mesh, 9000, 1);
  ASSERT_EQ(cloud.size(), 9000u);
  std::size_t upper = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_NEAR(cloud.positions[i].z(), cloud.labels[i], 1e-12);
    upper += cloud.labels[i] == 1;
  }
  EXPECT_NEAR(static_cast<double>(upper), 1000.0, 150.0);
  expect_same(cloud, sample_mesh(mesh, 9000, 1));
  EXPECT_NE(cloud.positions, sample_mesh(mesh, 9000, 2).positions);
  EXPECT_EQ(cloud.normals[0], Vec3f(0, 0, 1));
}

TEST(Mesh, OpenPointsSamplesAndTakesVerticesWhereThereAreNoFaces) {
  ReadOptions options;
  options.mesh_samples = 100;
  EXPECT_EQ(read(std::string(kSquare) + "f 1 2 3\n", "a.obj", options).size(), 100u);
  EXPECT_EQ(read(kSquare, "a.obj", options).size(), 4u);
}

/// A PLY file with faces is a drawn mesh if its vertices are few, a meshed scan if they are many.
TEST(Mesh, PlyWithFacesIsSampledIfItWasDrawn) {
  ReadOptions options;
  options.mesh_samples = 100;
  const auto ply = [](int vertices) {
    std::string s =
        "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
        "\nproperty float x\nproperty float y\nproperty float z\nproperty int kind\nelement face 1\nproperty list uchar int "
        "vertex_indices\nend_header\n";
    for (int i = 0; i < vertices; ++i) s += std::to_string(i % 2) + " " + std::to_string(i / 2) + " 0 7\n";
    return s + "3 0 1 2\n";
  };
  EXPECT_EQ(read(ply(4), "a.ply", options).size(), 100u);
  EXPECT_EQ(read(ply(5000), "a.ply", options).size(), 5000u);
  options.label_field = "kind";  // asks for the vertices
  EXPECT_EQ(read(ply(4), "a.ply", options).labels, (std::vector<std::int32_t>(4, 7)));
}

TEST(Mesh, FaultsNameFileAndField) {
  const auto bad = [](const std::string& s, const std::string& name, std::vector<std::string> parts) {
    parts.push_back(name);
    expect_error([&] { read_mesh_in_memory(s, name); }, parts);
  };
  bad("v 0 0\n", "b.obj", {"line 1", "vertex"});
  bad(std::string(kSquare) + "f 1 2 9\n", "b.obj", {"line 5", "face", "1 to 4"});
  bad(std::string(kSquare) + "f 1 2 x\n", "b.obj", {"line 5", "face"});
  bad(std::string(kSquare) + "f 1 2 -9\n", "b.obj", {"line 5", "face"});
  bad("g only\n", "b.obj", {"vertices"});
  bad("OFF\n4 1 0\n0 0 0\n", "b.off", {"vertices", "the 4"});
  bad("OFF\n1000000000 1 0\n0 0 0\n", "b.off", {"vertices", "1000000000"});
  bad("OFF\n-3 1 0\n0 0 0\n", "b.off", {"counts", "-3"});
  bad("OFF\n1 1 0\n0 0 0\n3 0 0 5\n", "b.off", {"face", "below 1"});
  bad("OFF\n1 1 0\n0 0 0\n999 0 0 5\n", "b.off", {"face"});
  bad("solid s\nfacet\nvertex 1 2\nendfacet", "b.stl", {"line 3", "vertex"});
  bad("solid s\nfacet\nendfacet", "b.stl", {"line 3", "facet"});
  bad(std::string(80, ' ') + "\xff\xff\xff\x7f", "b.stl", {"triangles", "2147483647"});
  bad(ply_ascii() + "", "b.obj", {"a PLY file named .obj"});
  bad(las(0, 2), "b.las", {"LAS", "a mesh"});
}

}  // namespace
}  // namespace unseen::io
