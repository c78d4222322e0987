// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "io/json_field.h"
#include "io/polygon.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

constexpr std::size_t kLargest = std::size_t{64} << 20;  // bytes
constexpr std::size_t kMostBlocks = 2000;
constexpr std::size_t kMostVertices = 2000;  // a block
constexpr double kFarthest = 1e6;
constexpr const char* kExpectedAssembly = "an assembly: \"blocks\", or a compas assembly";

void require_count(const JsonField& field, std::size_t count, std::size_t least, std::size_t most) {
  if (count < least || count > most) field.fail(fmt::format("{} to {} entries", least, most));
}

Vec3 position_of(const JsonField& field) {
  const Vec3 v = field.vector();
  if (v.cwiseAbs().maxCoeff() > kFarthest) field.fail(fmt::format("coordinates within ±{:g}", kFarthest));
  return v;
}

void add_face(const JsonField& field, const std::vector<std::uint32_t>& corners, TriangleMesh& mesh) {
  const std::set<std::uint32_t> different(corners.begin(), corners.end());
  if (corners.size() < 3 || different.size() != corners.size() || corners.size() > kMostCorners)
    field.fail("a face of three or more different vertices");
  append_polygon(corners, mesh);
}

TriangleMesh box_mesh(const JsonField& block) {
  const Vec3 center = position_of(block["center"]), size = position_of(block["size"]);
  if (!(size.minCoeff() > 0.0)) block["size"].fail("three positive lengths");
  Mat3 axes = Mat3::Identity();
  if (block.has("axes")) {
    const auto rows = block["axes"].list();
    if (rows.size() != 3) block["axes"].fail("three rows");
    for (int i = 0; i < 3; ++i) axes.col(i) = rows[i].unit_vector();
    if (!((axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-6))
      block["axes"].fail("axes at right angles");
    if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);  // the same box
  }
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1) ? 0.5 : -0.5, (i & 2) ? 0.5 : -0.5, (i & 4) ? 0.5 : -0.5);
    mesh.vertices.push_back(center + axes * size.cwiseProduct(corner));
  }
  const std::vector<std::vector<std::uint32_t>> faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& face : faces) append_polygon(face, mesh);
  return mesh;
}

TriangleMesh solid_mesh(const JsonField& block) {
  TriangleMesh mesh;
  const auto vertices = block["vertices"].list();
  require_count(block["vertices"], vertices.size(), 4, kMostVertices);
  for (const JsonField& v : vertices) mesh.vertices.push_back(position_of(v));
  const auto faces = block["faces"].list();
  require_count(block["faces"], faces.size(), 4, 2 * kMostVertices);
  for (const JsonField& face : faces) {
    const std::vector<int> corners = face.indices(vertices.size());
    add_face(face, {corners.begin(), corners.end()}, mesh);
  }
  return mesh;
}

std::string id_of(const JsonField& field, const nlohmann::json& value) {
  if (value.is_number_unsigned()) return std::to_string(field.count());
  return field.text();
}

Assembly read_ours(const nlohmann::json& parsed, const JsonField& root) {
  Assembly assembly;
  const auto blocks = root["blocks"].list();
  require_count(root["blocks"], blocks.size(), 1, kMostBlocks);
  std::set<std::string> names;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const JsonField& block = blocks[i];
    NamedMesh named;
    const JsonField id = block["id"];
    named.name = id_of(id, parsed["blocks"][i]["id"]);
    if (!names.insert(named.name).second) id.fail("an id that no other block has");
    named.mesh = block.has("vertices") ? solid_mesh(block) : box_mesh(block);
    if (block.has("density")) named.density = block["density"].number(1e-6, 1e6);
    assembly.blocks.push_back(std::move(named));
  }
  if (!root.has("supports")) return assembly;
  const auto supports = root["supports"].list();
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const std::string name = id_of(supports[i], parsed["supports"][i]);
    if (!names.contains(name)) supports[i].fail("the id of a block");
    assembly.supports.push_back(name);
  }
  return assembly;
}

std::size_t key_of(const std::string& key, const JsonField& at) {
  std::size_t number = 0;
  if (!to_count(key, number)) at.fail("a whole number as its key");
  return number;
}

TriangleMesh compas_mesh(const JsonField& data) {
  TriangleMesh mesh;
  std::map<std::size_t, std::uint32_t> place;
  const auto vertices = data["vertex"].members();
  require_count(data["vertex"], vertices.size(), 4, kMostVertices);
  for (const auto& [key, v] : vertices) {
    place.emplace(key_of(key, v), static_cast<std::uint32_t>(mesh.vertices.size()));
    const Vec3 p(v["x"].number(-kFarthest, kFarthest), v["y"].number(-kFarthest, kFarthest),
                 v["z"].number(-kFarthest, kFarthest));
    mesh.vertices.push_back(p);
  }
  const auto faces = data["face"].members();
  require_count(data["face"], faces.size(), 4, 2 * kMostVertices);
  for (const auto& [key, face] : faces) {
    std::vector<std::uint32_t> corners;
    for (const JsonField& corner : face.list()) {
      const auto at = place.find(corner.count());
      if (at == place.end()) corner.fail("the key of a vertex");
      corners.push_back(at->second);
    }
    add_face(face, corners, mesh);
  }
  return mesh;
}

Assembly read_compas(const JsonField& root) {
  const JsonField nodes = root["data"]["graph"]["data"]["node"];
  std::map<std::size_t, NamedMesh> in_order;
  std::set<std::size_t> supports;
  const auto members = nodes.members();
  require_count(nodes, members.size(), 1, kMostBlocks);
  for (const auto& [key, node] : members) {
    const std::size_t number = key_of(key, node);
    in_order[number] = {key, compas_mesh(node["block"]["data"]), std::nullopt};
    if (node.has("is_support") && node["is_support"].truth()) supports.insert(number);
  }
  Assembly assembly;
  for (auto& [number, block] : in_order) {
    if (supports.contains(number)) assembly.supports.push_back(block.name);
    assembly.blocks.push_back(std::move(block));
  }
  return assembly;
}

}  // namespace

Assembly read_assembly_in_memory(const std::string& text, const std::string& name) {
  const nlohmann::json parsed = parse_json(text, name, kExpectedAssembly);
  const JsonField root(parsed, name);
  if (!parsed.is_object()) root.fail(kExpectedAssembly);
  if (root.has("blocks")) return read_ours(parsed, root);
  if (root.has("data")) return read_compas(root);
  throw InputError(name, "", "neither \"blocks\" nor \"data\"", kExpectedAssembly);
}

Assembly read_assembly(const std::filesystem::path& path) {
  return read_assembly_in_memory(read_text_file(path, kLargest), path.string());
}

}  // namespace unseen::io
