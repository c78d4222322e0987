// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "report/palette.h"
#include "report/surfaces.h"
#include "unseen/core/version.h"
#include "unseen/report/planes_files.h"

namespace unseen::report {
namespace {

/// A glTF model under construction: one buffer, to which views are appended.
struct Builder {
  tinygltf::Model model;
  Vec3 offset = Vec3::Zero();

  template <class T>
  int add_accessor(const std::vector<T>& values, int target, int component, int type) {
    tinygltf::Buffer& buffer = model.buffers[0];
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.data.size();
    view.byteLength = values.size() * sizeof(T);
    view.target = target;
    buffer.data.resize(buffer.data.size() + view.byteLength);
    std::memcpy(buffer.data.data() + view.byteOffset, values.data(), view.byteLength);
    buffer.data.resize((buffer.data.size() + 3) / 4 * 4);
    model.bufferViews.push_back(view);

    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = values.size();
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
  }

  int add_positions(const std::vector<Vec3>& world) {
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

  /// A node below the root that shows one primitive.
  void add_node(const std::string& name, tinygltf::Primitive primitive) {
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(std::move(primitive));
    model.meshes.push_back(std::move(mesh));
    tinygltf::Node node;
    node.name = name;
    node.mesh = static_cast<int>(model.meshes.size()) - 1;
    model.nodes.push_back(std::move(node));
    model.nodes[0].children.push_back(static_cast<int>(model.nodes.size()) - 1);
  }
};

tinygltf::Node root_node(const Vec3& offset) {
  tinygltf::Node root;
  root.name = "unseen";
  root.rotation = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // x, y, z, w: −90° about x, z up becomes y up
  tinygltf::Value::Array entries;
  for (const double c : {offset.x(), offset.y(), offset.z()}) entries.emplace_back(c);
  root.extras = tinygltf::Value(tinygltf::Value::Object{{"offset", tinygltf::Value(std::move(entries))}});
  return root;
}

tinygltf::Material frame_material(int frame) {
  const auto c = linear(frame_color(frame));
  tinygltf::Material material;
  material.name = "frame " + std::to_string(frame);
  material.pbrMetallicRoughness.baseColorFactor = {c[0], c[1], c[2], 1.0};
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 0.9;
  material.doubleSided = true;
  return material;
}

tinygltf::Primitive surface_primitive(Builder& b, const Surface& surface, int frame) {
  tinygltf::Primitive primitive;
  primitive.material = frame;
  primitive.attributes["POSITION"] = b.add_positions(surface.vertices);
  primitive.mode = surface.triangles.empty() ? TINYGLTF_MODE_LINE : TINYGLTF_MODE_TRIANGLES;
  if (surface.triangles.empty()) return primitive;
  primitive.indices = b.add_accessor(surface.triangles, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER,
                                     TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR);
  b.model.accessors.back().count = surface.triangles.size() * 3;
  return primitive;
}

void add_points(Builder& b, const planes::Arrangement& a, const PointSample& points) {
  std::vector<std::array<std::uint8_t, 4>> colors;
  for (const int plane : points.plane_of_point) {
    const auto c =
        linear(plane_color(plane, plane < 0 ? -1 : a.planes[static_cast<std::size_t>(plane)].frame));
    const auto byte = [](double v) { return static_cast<std::uint8_t>(std::lround(255.0 * v)); };
    colors.push_back({byte(c[0]), byte(c[1]), byte(c[2]), 255});
  }
  tinygltf::Material unlit;
  unlit.name = "points";
  unlit.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object{});
  b.model.extensionsUsed.push_back("KHR_materials_unlit");
  b.model.materials.push_back(unlit);
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_POINTS;
  primitive.material = static_cast<int>(b.model.materials.size()) - 1;
  primitive.attributes["POSITION"] = b.add_positions(points.positions);
  primitive.attributes["COLOR_0"] = b.add_accessor(colors, TINYGLTF_TARGET_ARRAY_BUFFER,
                                                   TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4);
  b.model.accessors.back().normalized = true;
  b.add_node("points", std::move(primitive));
}

}  // namespace

std::string planes_glb(const planes::Arrangement& a, const PointSample& points) {
  const auto surfaces = surfaces_of(a);
  Builder b;
  b.offset = offset_of(surfaces, points);
  b.model.asset.version = "2.0";
  b.model.asset.generator = std::string("unseen ") + kVersion;
  b.model.buffers.emplace_back();
  b.model.nodes.push_back(root_node(b.offset));
  for (std::size_t f = 0; f < a.frames.size(); ++f)
    b.model.materials.push_back(frame_material(static_cast<int>(f)));
  for (std::size_t p = 0; p < surfaces.size(); ++p)
    if (!surfaces[p].triangles.empty() || surfaces[p].vertices.size() == 2)
      b.add_node(plane_name(a, p), surface_primitive(b, surfaces[p], a.planes[p].frame));
  if (!points.positions.empty()) add_points(b, a, points);
  if (b.model.buffers[0].data.empty()) b.model.buffers.clear();

  tinygltf::Scene scene;
  scene.nodes = {0};
  b.model.scenes.push_back(scene);
  b.model.defaultScene = 0;
  std::ostringstream out;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&b.model, out, false, true))
    throw std::runtime_error("cannot make scene.glb");
  return out.str();
}

}  // namespace unseen::report
