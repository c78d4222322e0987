// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>

#include "collision/sample.h"
#include "unseen/report/collision_files.h"

namespace unseen::report {
namespace {

using collision::Sample;

tinygltf::Model parsed(const std::string& bytes) {
  tinygltf::Model model;
  tinygltf::TinyGLTF reader;
  std::string error, warning;
  EXPECT_TRUE(reader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<unsigned>(bytes.size()))) << error;
  EXPECT_EQ(warning, "");
  return model;
}

int node_named(const tinygltf::Model& model, const std::string& name) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].name == name) return static_cast<int>(i);
  return -1;
}

std::vector<float> floats(const tinygltf::Model& model, int accessor) {
  const tinygltf::Accessor& a = model.accessors.at(static_cast<std::size_t>(accessor));
  const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(a.bufferView));
  std::vector<float> values(view.byteLength / sizeof(float));
  std::memcpy(values.data(), model.buffers[0].data.data() + view.byteOffset, view.byteLength);
  return values;
}

struct Keys {
  std::vector<float> times, values;
};

Keys keys(const tinygltf::Model& model, const std::string& node, const std::string& path) {
  for (const tinygltf::AnimationChannel& c : model.animations.at(0).channels) {
    if (c.target_node != node_named(model, node) || c.target_path != path) continue;
    const tinygltf::AnimationSampler& s = model.animations[0].samplers.at(static_cast<std::size_t>(c.sampler));
    EXPECT_EQ(s.interpolation, "LINEAR");
    return {floats(model, s.input), floats(model, s.output)};
  }
  ADD_FAILURE() << node << " " << path;
  return {};
}

TEST(CollisionGlb, HasAKeyAFrameAndOneAtTheImpact) {
  const Sample s = collision::sample_two_bodies();
  const tinygltf::Model model = parsed(collision_glb(s.shot, s.result));
  const Keys box = keys(model, "box", "translation"), ball = keys(model, "ball", "translation");
  ASSERT_EQ(box.times.size(), 62u);
  ASSERT_EQ(ball.times.size(), 59u);  // not in flight in the first three frames
  EXPECT_FLOAT_EQ(box.times[31], 0.255F);
  EXPECT_FLOAT_EQ(box.values[3 * 31], -0.1F);
  for (std::size_t i = 1; i < box.times.size(); ++i) EXPECT_GT(box.times[i], box.times[i - 1]);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_FLOAT_EQ(box.values[3 * 10 + i], static_cast<float>(s.result.frames[10].bodies[0]->p[static_cast<int>(i)]));
}

TEST(CollisionGlb, QuaternionsKeepTheirSign) {
  Sample s = collision::sample_two_bodies();
  for (std::size_t i = 0; i < s.result.frames.size(); i += 2) s.result.frames[i].bodies[0]->q.coeffs() *= -1.0;
  const tinygltf::Model model = parsed(collision_glb(s.shot, s.result));
  const Keys box = keys(model, "box", "rotation");
  for (std::size_t i = 1; i < box.times.size(); ++i) {
    float dot = 0;
    for (std::size_t k = 0; k < 4; ++k) dot += box.values[4 * i + k] * box.values[4 * (i - 1) + k];
    EXPECT_GT(dot, 0.9F) << i;
  }
}

TEST(CollisionGlb, LaterBouncesTouchTheFloor) {
  const Sample s = collision::sample_bounces();
  const tinygltf::Model model = parsed(collision_glb(s.shot, s.result));
  const Keys ball = keys(model, "ball", "translation");
  ASSERT_EQ(ball.times.size(), s.result.frames.size() + 1);  // the first bounce is at frame 24
  const double second = s.result.impacts[1].time;
  std::size_t i = 0;
  while (i + 1 < ball.times.size() && ball.times[i] < second - 1e-6) ++i;
  EXPECT_NEAR(ball.values[3 * i + 2], -0.45, 1e-6);  // half a diameter above the floor
  EXPECT_NE(node_named(model, "floor"), -1);
}

TEST(CollisionGlb, CameraLooksWhereThePictureWasTaken) {
  const Sample s = collision::sample_bounces();
  const tinygltf::Model model = parsed(collision_glb(s.shot, s.result));
  const tinygltf::Node& node = model.nodes.at(static_cast<std::size_t>(node_named(model, "camera")));
  const Eigen::Quaterniond q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
  EXPECT_LT((q * -Vec3::UnitZ() - s.result.T_world_camera.rotation.col(2)).norm(), 1e-12);
  EXPECT_LT((q * Vec3::UnitY() + s.result.T_world_camera.rotation.col(1)).norm(), 1e-12);
  EXPECT_NEAR(model.cameras.at(0).perspective.yfov, 2 * std::atan(240.0 / 900.0), 1e-12);
}

TEST(CollisionGlb, AMeshTurnsAboutItsCentreOfMass) {
  Sample s = collision::sample_two_bodies();
  collision::Body& body = s.shot.bodies[0];
  body.shape = collision::Shape::mesh;  // a tetrahedron: its centre is the mean of its corners
  body.mesh.vertices = {{1, 0, 0}, {1.1, 0, 0}, {1, 0.1, 0}, {1, 0, 0.1}};
  body.mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const tinygltf::Model model = parsed(collision_glb(s.shot, s.result));
  const tinygltf::Node& node = model.nodes.at(static_cast<std::size_t>(node_named(model, "box")));
  const auto& accessor = model.accessors.at(static_cast<std::size_t>(model.meshes[static_cast<std::size_t>(node.mesh)].primitives[0].attributes.at("POSITION")));
  EXPECT_NEAR(accessor.minValues[0], -0.025, 1e-7);
  EXPECT_NEAR(accessor.maxValues[0], 0.075, 1e-7);
}

}  // namespace
}  // namespace unseen::report
