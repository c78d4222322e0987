// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Assemblies from files: known verdicts, both formats, and files that are broken on purpose.
#include "unseen/cuboids/check.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "cuboids/statics/convex_parts.h"
#include "unseen/core/error.h"
#include "unseen/io/assembly.h"

namespace unseen::cuboids {
namespace {

Check check(const io::Assembly& assembly, const CheckOptions& options) {
  std::vector<Block> blocks;
  for (const io::NamedMesh& b : assembly.blocks) blocks.push_back({b.name, b.mesh, b.density.value_or(2400.0)});
  Context context;
  return check_assembly(blocks, options, context);
}

Check check_text(const std::string& text, double friction = 0.7, const Vec3& up = Vec3::UnitZ()) {
  const io::Assembly assembly = io::read_assembly_in_memory(text, "test.json");
  return check(assembly, {assembly.supports, up, friction});
}

TEST(Check, KnownVerdictsOfPublishedAssemblies) {
  const std::filesystem::path folder =
      std::filesystem::path(UNSEEN_SOURCE_DIR) / "../shared/data/cuboids/compas_cra";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no data in " << folder;
  const struct {
    const char* name;
    double friction;
    bool side, stands;
  } cases[] = {{"A", 0.84, true, true},      {"A", 0.3, true, false},      {"type-a", 0.84, true, true},
               {"type-b", 0.84, true, true}, {"type-c", 0.84, true, false}, {"type-d", 0.84, true, false},
               {"cubes", 0.84, false, true}, {"shelf-stable", 0.84, false, true}};
  for (const auto& c : cases) {
    const io::Assembly assembly = io::read_assembly(folder / (std::string(c.name) + ".json"));
    const Check result = check(assembly, {{"0"}, c.side ? Vec3(-Vec3::UnitX()) : Vec3(Vec3::UnitZ()), c.friction});
    EXPECT_EQ(result.stability.stable, c.stands) << c.name << " " << c.friction << " " << result.stability.residual;
    if (std::string(c.name) == "A" && c.stands) {
      EXPECT_NEAR(result.stability.friction_needed, std::tan(kPi / 6), 3e-3);
    }
    for (const Vec3& v : result.velocity) EXPECT_EQ(v.norm() > 0.0, !c.stands && &v != &result.velocity[0]) << c.name;
  }
}

constexpr const char* kTower = R"({"blocks": [
  {"id": "floor", "center": [0,0,-0.5], "size": [4,4,1]},
  {"id": 1, "center": [0,0,0.5], "axes": [[0,1,0],[-1,0,0],[0,0,1]], "size": [1,1,1], "density": 500},
  {"id": 2, "vertices": [[-0.5,-0.5,1],[0.5,-0.5,1],[0.5,0.5,1],[-0.5,0.5,1],[0,0,2]],
   "faces": [[3,2,1,0],[0,1,4],[1,2,4],[2,3,4],[3,0,4]]}], "supports": ["floor"]})";

TEST(Check, ReadsBoxesAndSolids) {
  const io::Assembly assembly = io::read_assembly_in_memory(kTower, "test.json");
  ASSERT_EQ(assembly.blocks.size(), 3u);
  EXPECT_EQ(assembly.blocks[1].name, "1");
  EXPECT_EQ(assembly.blocks[1].density, 500.0);
  EXPECT_NEAR(std::abs(mass_center(assembly.blocks[2].mesh).volume), 1.0 / 3.0, 1e-12);
  const Check result = check_text(kTower);
  EXPECT_TRUE(result.stability.stable);
  ASSERT_EQ(result.contacts.size(), 2u);
  double carried = 0.0;
  for (const Vec3& f : result.contacts[0].forces) carried += f.z();
  EXPECT_NEAR(carried, 9.81 * (500.0 + 2400.0 / 3.0), 1e-6);
  // Turned on its side, everything slides off the floor.
  const Check side = check_text(kTower, 0.7, Vec3::UnitX());
  EXPECT_FALSE(side.stability.stable);
  EXPECT_LT(side.velocity[1].x(), 0.0);
  EXPECT_EQ(side.velocity[0], Vec3::Zero());
}

/// A bowl: a box with a box-shaped hole from above; a cube rests in it.
TEST(Check, CutsDentedBlocks) {
  const std::string bowl = R"({"blocks": [{"id": "bowl", "vertices": [
      [0,0,0],[3,0,0],[3,3,0],[0,3,0],[0,0,2],[3,0,2],[3,3,2],[0,3,2],
      [1,1,1],[2,1,1],[2,2,1],[1,2,1],[1,1,2],[2,1,2],[2,2,2],[1,2,2]],
     "faces": [[3,2,1,0],[0,1,5,4],[1,2,6,5],[2,3,7,6],[3,0,4,7],[8,9,10,11],[8,12,13,9],[9,13,14,10],[10,14,15,11],
      [11,15,12,8],[4,5,13,12],[5,6,14,13],[6,7,15,14],[7,4,12,15]]},
     {"id": "cube", "center": [1.5,1.5,HEIGHT], "size": [0.8,0.8,0.8]}], "supports": ["bowl"]})";
  const auto at = [&](const std::string& height) {
    std::string text = bowl;
    return check_text(text.replace(text.find("HEIGHT"), 6, height));
  };
  EXPECT_TRUE(at("1.4").stability.stable);
  const Check hanging = at("1.9");  // in the hole, but touching nothing
  EXPECT_NEAR(hanging.stability.residual, 1.0, 1e-9);
  EXPECT_TRUE(hanging.contacts.empty());
  const io::Assembly assembly = io::read_assembly_in_memory(bowl.substr(0, bowl.find("HEIGHT")) + "3" +
                                                            bowl.substr(bowl.find("HEIGHT") + 6), "t");
  double volume = 0.0;
  for (const ConvexSolid& part : convex_parts(assembly.blocks[0].mesh)) {
    TriangleMesh mesh;
    mesh.vertices = part.vertices;
    for (const auto& face : part.faces)
      for (std::size_t i = 2; i < face.size(); ++i)
        mesh.triangles.push_back({std::uint32_t(face[0]), std::uint32_t(face[i - 1]), std::uint32_t(face[i])});
    volume += mass_center(mesh).volume;
  }
  EXPECT_NEAR(volume, 17.0, 1e-3);
}

TEST(Check, NamesWhatIsWrong) {
  const auto refused = [](const std::string& text, const std::string& field) {
    try {
      const io::Assembly assembly = io::read_assembly_in_memory(text, "test.json");
      check(assembly, {assembly.supports, Vec3::UnitZ(), 0.7});
      ADD_FAILURE() << "accepted: " << text.substr(0, 100);
    } catch (const InputError& e) {
      EXPECT_EQ(e.field, field) << e.what();
    }
  };
  const std::string box = R"("center": [0,0,0], "size": [1,1,1])";
  refused("", "");
  refused("[]", "");
  refused("{}", "");
  refused("{\"blocks\": 3}", "blocks");
  refused("{\"blocks\": []}", "blocks");
  refused("{\"blocks\": [{\"center\": [0,0,0]}]}", "blocks[0].id");
  refused("{\"blocks\": [{\"id\": 1.5, " + box + "}]}", "blocks[0].id");
  refused("{\"blocks\": [{\"id\": 1, " + box + "}, {\"id\": \"1\", " + box + "}]}", "blocks[1].id");
  refused("{\"blocks\": [{\"id\": 1, " + box + "}], \"supports\": [2]}", "supports[0]");
  refused(R"({"blocks": [{"id": 1, "center": [0,0,1e9], "size": [1,1,1]}]})", "blocks[0].center");
  refused(R"({"blocks": [{"id": 1, "center": [0,0,"1"], "size": [1,1,1]}]})", "blocks[0].center[2]");
  refused(R"({"blocks": [{"id": 1, "center": [0,0,0], "size": [1,0,1]}]})", "blocks[0].size");
  refused(R"({"blocks": [{"id": 1, "center": [0,0,0], "size": [1,1,1], "axes": [[1,0,0],[1,0,0],[0,0,1]]}]})",
          "blocks[0].axes");
  refused(R"({"blocks": [{"id": 1, "vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "faces": [[0,1,2],[0,1,9],[1,2,3],[0,2,3]]}]})",
          "blocks[0].faces[1][2]");
  refused(R"({"blocks": [{"id": 1, "vertices": [[0,0,0],[1,0,0],[0,1,0],[1,1,0]], "faces": [[0,1,2],[0,1,3],[1,2,3],[0,2,3]]}]})",
          "block 1");  // flat
  refused(R"({"blocks": [{"id": 1, "vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1],[2,2,2]], "faces": [[0,2,1],[0,1,3],[1,2,3],[1,2,3]]}]})",
          "block 1");  // open
  refused(R"({"blocks": [{"id": 1, "vertices": [[0,0,0],[2,0,0],[2,1,0],[1,1,0],[1,2,0],[0,2,0],
      [0,0,0.1],[2,0,0.1],[2,1,0.1],[1,1,0.1],[1,2,0.1],[0,2,0.1]],
    "faces": [[0,1,7,6],[1,2,8,7],[2,3,9,8],[3,4,10,9],[4,5,11,10],[5,0,6,11]]}]})",
          "block 1");  // a short pipe: open, though the areas of its faces cancel
  for (const char* size : {"1e-31", "1e-100", "1e-107", "1e-200"})  // areas, volumes or weights underflow
    refused("{\"blocks\": [{\"id\": 1, \"center\": [0,0,0], \"size\": [" + std::string(size) + "," + size + "," + size +
                "]}]}",
            "block 1");
  refused(std::string(100000, '['), "");
  refused("{\"data\": {\"graph\": {\"data\": {\"node\": {\"x\": {}}}}}}", "data.graph.data.node.x");
  refused("{\"data\": 1e999}", "data");
  Context context;
  const io::Assembly tower = io::read_assembly_in_memory(kTower, "test.json");
  EXPECT_THROW(check(tower, {{"nobody"}, Vec3::UnitZ(), 0.7}), InputError);
  EXPECT_THROW(check(tower, {{"floor"}, Vec3::Zero(), 0.7}), InputError);
  EXPECT_THROW(check(tower, {{"floor"}, Vec3::UnitZ(), -1.0}), InputError);
  EXPECT_THROW(io::read_assembly("/nowhere/assembly.json"), InputError);
}

}  // namespace
}  // namespace unseen::cuboids
