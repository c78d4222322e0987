// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>

#include "interactions/page_sample.h"
#include "unseen/report/interactions_files.h"

namespace unseen::report {
namespace {

using namespace interactions;

tinygltf::Model parsed(const std::string& bytes) {
  tinygltf::Model model;
  tinygltf::TinyGLTF reader;
  std::string error, warning;
  EXPECT_TRUE(reader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
                                          static_cast<unsigned>(bytes.size())))
      << error;
  EXPECT_EQ(warning, "");
  return model;
}

int node_named(const tinygltf::Model& model, const std::string& name) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].name == name) return static_cast<int>(i);
  ADD_FAILURE() << name;
  return 0;
}

std::vector<float> floats(const tinygltf::Model& model, int accessor) {
  const tinygltf::BufferView& view =
      model.bufferViews.at(static_cast<std::size_t>(model.accessors.at(static_cast<std::size_t>(accessor)).bufferView));
  std::vector<float> values(view.byteLength / sizeof(float));
  std::memcpy(values.data(), model.buffers[0].data.data() + view.byteOffset, view.byteLength);
  return values;
}

/// Times and values of what moves a node; nothing if it has no such channel.
std::pair<std::vector<float>, std::vector<float>> keys(const tinygltf::Model& model, const std::string& node, const std::string& path) {
  const int id = node_named(model, node);
  for (const tinygltf::AnimationChannel& c : model.animations.at(0).channels)
    if (c.target_node == id && c.target_path == path) {
      const tinygltf::AnimationSampler& s = model.animations[0].samplers.at(static_cast<std::size_t>(c.sampler));
      return {floats(model, s.input), floats(model, s.output)};
    }
  return {};
}

TEST(InteractionsGlb, JointsAreWhereThePosesHaveThem) {
  const PageSample s = page_sample();
  const Person& person = s.result.people[0];
  const tinygltf::Model model = parsed(interactions_glb(s.result));
  for (int j = 0; j < kJoints; ++j) {
    const auto [times, places] = keys(model, std::string("person 0 ") + kJointNames[static_cast<std::size_t>(j)], "translation");
    ASSERT_EQ(times.size(), person.frames.size());
    for (std::size_t f = 0; f < times.size(); ++f) {
      EXPECT_FLOAT_EQ(times[f], static_cast<float>(person.frames[f].frame / s.result.fps));
      for (int a = 0; a < 3; ++a) ASSERT_FLOAT_EQ(places[3 * f + static_cast<std::size_t>(a)], static_cast<float>(person.frames[f].pose(a, j)));
    }
  }
}

TEST(InteractionsGlb, BonesReachFromJointToJoint) {
  const PageSample s = page_sample(1, 24, 7);
  const Person& person = s.result.people[0];
  const tinygltf::Model model = parsed(interactions_glb(s.result));
  for (const auto& [from, to] : kBones) {
    const std::string name = std::string("person 0 ") + kJointNames[from] + " to " + kJointNames[to];
    const auto turns = keys(model, name, "rotation").second;
    const auto& node = model.nodes[static_cast<std::size_t>(node_named(model, name))];
    const auto& accessor =
        model.accessors[static_cast<std::size_t>(model.meshes[static_cast<std::size_t>(node.mesh)].primitives[0].attributes.at("POSITION"))];
    const double length = accessor.maxValues[2] + accessor.minValues[2];  // the ends are as round below as above
    for (std::size_t f = 0; f < person.frames.size(); ++f) {
      const Eigen::Quaterniond q(turns[4 * f + 3], turns[4 * f], turns[4 * f + 1], turns[4 * f + 2]);
      const Vec3 bone = person.frames[f].pose.col(to) - person.frames[f].pose.col(from);
      ASSERT_LT((q * Vec3::UnitZ() - bone.normalized()).norm(), 1e-5) << name << " " << f;
      EXPECT_NEAR(length, bone.norm(), 0.02) << name;
      if (f == 0) continue;
      double dot = 0;
      for (std::size_t c = 0; c < 4; ++c) dot += turns[4 * f + c] * turns[4 * (f - 1) + c];
      EXPECT_GT(dot, 0.0) << name << " " << f;
    }
  }
}

TEST(InteractionsGlb, ObjectsReachAsFarAsTheirParts) {
  const PageSample s = page_sample();
  const tinygltf::Model model = parsed(interactions_glb(s.result));
  for (const FoundObject& found : s.result.objects) {
    const auto& node = model.nodes[static_cast<std::size_t>(node_named(model, found.object.category + " " + std::to_string(found.object.id)))];
    const auto& accessor =
        model.accessors[static_cast<std::size_t>(model.meshes[static_cast<std::size_t>(node.mesh)].primitives[0].attributes.at("POSITION"))];
    Eigen::AlignedBox3d box;
    for (const Part& part : found.object.parts)
      for (int corner = 0; corner < 8; ++corner)
        box.extend(part.box.center +
                   part.box.axes * part.box.half_size.cwiseProduct(Vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1)));
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(accessor.minValues[static_cast<std::size_t>(a)], box.min()[a], 1e-6);
      EXPECT_NEAR(accessor.maxValues[static_cast<std::size_t>(a)], box.max()[a], 1e-6);
    }
  }
}

TEST(InteractionsGlb, OfAnEmptyResultIsAFileToo) {
  EXPECT_TRUE(parsed(interactions_glb({})).animations.empty());
}

}  // namespace
}  // namespace unseen::report
