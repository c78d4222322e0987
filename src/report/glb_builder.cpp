// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/glb_builder.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "unseen/core/version.h"

namespace unseen::report {
namespace {

tinygltf::Node root_node(const Vec3& offset) {
  tinygltf::Node root;
  root.name = "unseen";
  root.rotation = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // x, y, z, w: −90° about x, z up becomes y up
  tinygltf::Value::Array entries;
  for (const double c : {offset.x(), offset.y(), offset.z()}) entries.emplace_back(c);
  root.extras = tinygltf::Value(tinygltf::Value::Object{{"offset", tinygltf::Value(std::move(entries))}});
  return root;
}

}  // namespace

GlbBuilder::GlbBuilder(const Vec3& origin) : offset(origin) {
  model.asset.version = "2.0";
  model.asset.generator = std::string("unseen ") + kVersion;
  model.buffers.emplace_back();
  model.nodes.push_back(root_node(offset));
}

int GlbBuilder::add_positions(const std::vector<Vec3>& world) {
  std::vector<std::array<float, 3>> stored;
  Eigen::AlignedBox3f box;
  for (const Vec3& p : world) {
    const Vec3f q = (p - offset).cast<float>();
    stored.push_back({q.x(), q.y(), q.z()});
    box.extend(q);
  }
  const int id =
      add_accessor(stored, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
  for (int i = 0; i < 3; ++i) {
    model.accessors.back().minValues.push_back(box.min()[i]);
    model.accessors.back().maxValues.push_back(box.max()[i]);
  }
  return id;
}

int GlbBuilder::add_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const int id = add_accessor(triangles, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                              TINYGLTF_TYPE_SCALAR);
  model.accessors.back().count = triangles.size() * 3;
  return id;
}

int GlbBuilder::add_material(const std::string& name, const Rgb& color, double opacity) {
  const auto c = linear(color);
  tinygltf::Material material;
  material.name = name;
  material.pbrMetallicRoughness.baseColorFactor = {c[0], c[1], c[2], opacity};
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 0.9;
  material.doubleSided = true;
  if (opacity < 1.0) material.alphaMode = "BLEND";
  model.materials.push_back(material);
  return static_cast<int>(model.materials.size()) - 1;
}

int GlbBuilder::add_empty_node(const std::string& name, const Vec3& position, const Eigen::Quaterniond& rotation) {
  tinygltf::Node node;
  node.name = name;
  const Vec3 p = position - offset;
  if (position != Vec3::Zero()) node.translation = {p.x(), p.y(), p.z()};
  if (rotation.coeffs() != Eigen::Quaterniond::Identity().coeffs()) node.rotation = {rotation.x(), rotation.y(), rotation.z(), rotation.w()};
  model.nodes.push_back(std::move(node));
  const int id = static_cast<int>(model.nodes.size()) - 1;
  model.nodes[0].children.push_back(id);
  return id;
}

tinygltf::Primitive GlbBuilder::surface(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles, int material) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = material;
  primitive.attributes["POSITION"] = add_positions(vertices);
  primitive.indices = add_triangles(triangles);
  return primitive;
}

int GlbBuilder::add_node(const std::string& name, tinygltf::Primitive primitive) {
  tinygltf::Mesh mesh;
  mesh.name = name;
  mesh.primitives.push_back(std::move(primitive));
  model.meshes.push_back(std::move(mesh));
  const int id = add_empty_node(name);
  model.nodes[static_cast<std::size_t>(id)].mesh = static_cast<int>(model.meshes.size()) - 1;
  return id;
}

void GlbBuilder::add_motion(int node, const std::vector<double>& times, const std::vector<Vec3>& positions,
                            const std::vector<Eigen::Quaterniond>& rotations) {
  constexpr int kNoTarget = 0, kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT;
  std::vector<float> seconds(times.begin(), times.end());
  std::vector<std::array<float, 3>> places;
  std::vector<std::array<float, 4>> turns;
  for (const Vec3& p : positions) places.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  for (const Eigen::Quaterniond& q : rotations)
    turns.push_back({static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()), static_cast<float>(q.w())});
  const int input = add_accessor(seconds, kNoTarget, kFloat, TINYGLTF_TYPE_SCALAR);
  model.accessors.back().minValues = {seconds.front()};
  model.accessors.back().maxValues = {seconds.back()};
  std::vector<std::pair<const char*, int>> outputs = {{"translation", add_accessor(places, kNoTarget, kFloat, TINYGLTF_TYPE_VEC3)}};
  if (!turns.empty()) outputs.emplace_back("rotation", add_accessor(turns, kNoTarget, kFloat, TINYGLTF_TYPE_VEC4));
  if (model.animations.empty()) {
    model.animations.emplace_back();
    model.animations.back().name = "motion";
  }
  tinygltf::Animation& animation = model.animations.back();
  for (const auto& [path, output] : outputs) {
    tinygltf::AnimationSampler sampler;
    sampler.input = input;
    sampler.output = output;
    sampler.interpolation = "LINEAR";
    animation.samplers.push_back(sampler);
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size()) - 1;
    channel.target_node = node;
    channel.target_path = path;
    animation.channels.push_back(channel);
  }
}

void GlbBuilder::add_points(const std::string& name, const std::vector<Vec3>& positions, const std::vector<Rgb>& srgb) {
  std::vector<std::array<std::uint8_t, 4>> colors;
  for (const Rgb& color : srgb) {
    const auto c = linear(color);
    const auto byte = [](double v) { return static_cast<std::uint8_t>(std::lround(255.0 * v)); };
    colors.push_back({byte(c[0]), byte(c[1]), byte(c[2]), 255});
  }
  tinygltf::Material unlit;
  unlit.name = name;
  unlit.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object{});
  model.extensionsUsed.push_back("KHR_materials_unlit");
  model.materials.push_back(unlit);
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_POINTS;
  primitive.material = static_cast<int>(model.materials.size()) - 1;
  primitive.attributes["POSITION"] = add_positions(positions);
  primitive.attributes["COLOR_0"] = add_accessor(colors, TINYGLTF_TARGET_ARRAY_BUFFER, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
                                                 TINYGLTF_TYPE_VEC4);
  model.accessors.back().normalized = true;
  add_node(name, std::move(primitive));
}

std::string GlbBuilder::finish() {
  if (model.buffers[0].data.empty()) model.buffers.clear();
  tinygltf::Scene scene;
  scene.nodes = {0};
  model.scenes.push_back(scene);
  model.defaultScene = 0;
  std::ostringstream out;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model, out, false, true)) throw std::runtime_error("cannot make scene.glb");
  return out.str();
}

}  // namespace unseen::report
