// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "unseen/core/error.h"
#include "unseen/report/cuboids_applications.h"

namespace unseen::report {
namespace {

TEST(PhotoEdits, AreReadFromJson) {
  const auto edits = parse_photo_edits(
      R"({"edits": [{"id": 3, "remove": true}, {"id": 4, "move": [0.1, -0.2, 0], "turn_deg": 30}, {"id": 5, "turn_deg": -90}]})", "e.json");
  ASSERT_EQ(edits.size(), 3u);
  EXPECT_TRUE(edits[0].remove);
  EXPECT_EQ(edits[1].id, 4);
  EXPECT_FALSE(edits[1].remove);
  EXPECT_EQ(edits[1].move, Vec3(0.1, -0.2, 0.0));
  EXPECT_NEAR(edits[1].turn, kPi / 6.0, 1e-12);
  EXPECT_NEAR(edits[2].turn, -kPi / 2.0, 1e-12);
}

TEST(PhotoEdits, RefusesEverythingElse) {
  for (const char* text :
       {"", "[", "[]", "{}", "3", R"({"edits": 3})", R"({"edits": []})", R"({"edits": [3]})", R"({"edits": [{}]})",
        R"({"edits": [{"id": 3}]})", R"({"edits": [{"id": -1, "remove": true}]})", R"({"edits": [{"id": 1.5, "remove": true}]})",
        R"({"edits": [{"id": 99999999999, "remove": true}]})", R"({"edits": [{"id": 3, "remove": "yes"}]})",
        R"({"edits": [{"id": 3, "remove": false}]})", R"({"edits": [{"id": 3, "remove": true, "move": [0, 0, 0]}]})",
        R"({"edits": [{"id": 3, "move": [0, 0]}]})", R"({"edits": [{"id": 3, "move": [0, 0, 1e9]}]})",
        R"({"edits": [{"id": 3, "move": [0, 0, 1e999]}]})", R"({"edits": [{"id": 3, "move": [0, 0, null]}]})",
        R"({"edits": [{"id": 3, "turn_deg": 1000}]})", R"({"edits": [{"id": 3, "turn": 10}]})", R"({"edit": []})",
        R"({"edits": [{"id": 3, "remove": true}, {"id": 3, "remove": true}]})"})
    EXPECT_THROW(parse_photo_edits(text, "e.json"), InputError) << text;
}

TEST(PhotoEdits, NamesFileAndField) {
  try {
    parse_photo_edits(R"({"edits": [{"id": 3, "remove": true}, {"id": 4, "move": [0, 0, "x"]}]})", "e.json");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.source, "e.json");
    EXPECT_EQ(error.field, "edits[1].move[2]");
  }
}

TEST(MeshPly, SaysWhatTheMeshHolds) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 0.25, 0}};
  mesh.triangles = {{0, 1, 2}};
  const std::string text = mesh_ply(mesh);
  EXPECT_NE(text.find("element vertex 3\n"), std::string::npos);
  EXPECT_NE(text.find("element face 1\n"), std::string::npos);
  EXPECT_NE(text.find("end_header\n0 0 0\n1 0 0\n0 0.25 0\n3 0 1 2\n"), std::string::npos);
}

}  // namespace
}  // namespace unseen::report
