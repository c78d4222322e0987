// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/cuboids_structures.h"

#include <fmt/format.h>

#include "unseen/io/write_image.h"

namespace unseen::report {
namespace {

using cuboids::Completion;

constexpr std::array<std::uint8_t, 3> kPlainSupport = {176, 176, 170};

struct Poses {
  std::vector<Vec3> centers, sizes;
  std::vector<float> rotations;  ///< w, x, y, z

  void add(const OrientedBox& box) {
    centers.push_back(box.center);
    sizes.push_back(2.0 * box.half_size);
    const Eigen::Quaterniond q(box.axes);
    for (const double c : {q.w(), q.x(), q.y(), q.z()}) rotations.push_back(static_cast<float>(c));
  }
};

void write_poses(SceneBuilder& scene, const Poses& poses, Json& to) {
  to["centers"] = scene.positions(poses.centers);
  to["rotations"] = scene.quaternions(poses.rotations);
  to["sizes"] = scene.vectors(poses.sizes);
}

/// The initial axes in the order and with the signs that come nearest to the completed ones, so that a box does not
/// turn over between before and after.
OrientedBox aligned(const OrientedBox& initial, const OrientedBox& to) {
  OrientedBox box = initial;
  std::array<bool, 3> used = {};
  for (int a = 0; a < 2; ++a) {
    int best = -1;
    for (int k = 0; k < 3; ++k)
      if (!used[k] && (best < 0 || std::abs(initial.axes.col(k).dot(to.axes.col(a))) >
                                       std::abs(initial.axes.col(best).dot(to.axes.col(a)))))
        best = k;
    used[best] = true;
    const double sign = initial.axes.col(best).dot(to.axes.col(a)) < 0 ? -1.0 : 1.0;
    box.axes.col(a) = sign * initial.axes.col(best);
    box.half_size[a] = initial.half_size[best];
  }
  for (int k = 0; k < 3; ++k)
    if (!used[k]) box.half_size[2] = initial.half_size[k];
  box.axes.col(2) = box.axes.col(0).cross(box.axes.col(1));
  return box;
}

/// Where a support stands in the graph: amid the places where it carries.
Vec3 place_of(const cuboids::Support& support, const Completion& c) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (const cuboids::Contact& contact : c.contacts)
    if (contact.a == support.id || contact.b == support.id)
      for (const Vec3& p : contact.points) sum += p, count += 1;
  if (count > 0) return support.plane.project(sum / count);
  for (const cuboids::Cuboid& cuboid : c.cuboids) sum += cuboid.box.center, count += 1;
  return support.plane.project(count > 0 ? Vec3(sum / count) : sum);
}

}  // namespace

std::vector<CarriedContact> carried_contacts(const Completion& c) {
  std::map<int, std::size_t> node;
  for (const cuboids::Support& s : c.supports) node.emplace(s.id, node.size());
  for (const cuboids::Cuboid& cuboid : c.cuboids) node.emplace(cuboid.id, node.size());
  std::vector<CarriedContact> carried;
  for (const cuboids::Contact& contact : c.contacts) {
    CarriedContact k = {node.at(contact.a), node.at(contact.b), Vec3::Zero()};
    for (const Vec3& f : contact.forces) k.force += f;
    const double upward = contact.forces.empty() ? contact.direction.z() : k.force.z();
    if (k.from >= c.supports.size() && upward < 0) {
      std::swap(k.from, k.to);
      k.force = -k.force;
    }
    carried.push_back(k);
  }
  return carried;
}

std::string name_of(const cuboids::Contact& contact, const CarriedContact& carried) {
  if (contact.kind == cuboids::ContactKind::fixed) return "fixed";
  return contact.forces.empty() ? "touching" : fmt::format("{:.3g} N, touching", carried.force.norm());
}

void add_boxes(SceneBuilder& scene, const Completion& c) {
  Poses after, before;
  std::vector<float> seen, hidden;
  std::vector<int> own;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < c.cuboids.size(); ++i) {
    const cuboids::Cuboid& cuboid = c.cuboids[i];
    after.add(cuboid.box);
    before.add(aligned(cuboid.initial, cuboid.box));
    const SeenPart part = seen_part(cuboid);
    for (const Vec3& end : {part.low, part.high})
      for (int a = 0; a < 3; ++a) seen.push_back(static_cast<float>(end[a]));
    hidden.push_back(static_cast<float>(100.0 * (1.0 - seen_box(cuboid).volume() / cuboid.box.volume())));
    own.push_back(static_cast<int>(i));
    names.push_back(name_of(cuboid));
  }
  Json& boxes = scene.add("boxes", "boxes", "Boxes (dashed: inferred)");
  write_poses(scene, after, boxes);
  boxes["seen"] = scene.ranges(seen);
  write_poses(scene, before, boxes["before"]);
  Json box = quantity("box", "Box", "label", scene.integers(own));
  box["names"] = names;
  Json share = quantity("hidden", "Share that was not seen", "scalar", scene.scalars(hidden), "%");
  share["low"] = 0.0;
  share["high"] = 100.0;
  boxes["quantities"] = {box, share};
}

void add_contact_graph(SceneBuilder& scene, const Completion& c) {
  std::vector<std::string> nodes, edge_names;
  std::vector<Vec3> places, forces;
  Json of_node = Json::array();
  for (const cuboids::Support& s : c.supports) {
    nodes.push_back(name_of(s));
    places.push_back(place_of(s, c));
    of_node.push_back(Json::array());
  }
  for (std::size_t i = 0; i < c.cuboids.size(); ++i) {
    nodes.push_back(name_of(c.cuboids[i]));
    places.push_back(c.cuboids[i].box.center);
    of_node.push_back({i});
  }
  std::vector<std::array<int, 2>> edges;
  const std::vector<CarriedContact> carried = carried_contacts(c);
  for (std::size_t k = 0; k < carried.size(); ++k) {
    edges.push_back({static_cast<int>(carried[k].from), static_cast<int>(carried[k].to)});
    edge_names.push_back(name_of(c.contacts[k], carried[k]));
    forces.push_back(carried[k].force);
  }
  Json& graph = scene.add("graph", "contacts", "Who carries whom");
  graph["node_names"] = nodes;
  graph["edge_names"] = edge_names;
  graph["edges"] = scene.pairs(edges);
  graph["elements"] = {{"structure", "boxes"}, {"of_node", std::move(of_node)}};
  graph["positions"] = scene.positions(places);
  graph["vectors"] = scene.vectors(forces);
}

void add_supports(SceneBuilder& scene, const Completion& c) {
  std::vector<Vec3> vertices, normals;
  std::vector<std::array<int, 2>> rings;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> owner;
  for (std::size_t s = 0; s < c.supports.size(); ++s) {
    const std::vector<Vec3> polygon = polygon_of(c.supports[s], c);
    const int first = static_cast<int>(vertices.size());
    rings.push_back({first, static_cast<int>(s)});
    vertices.insert(vertices.end(), polygon.begin(), polygon.end());
    for (int k = 2; k < static_cast<int>(polygon.size()); ++k) {  // outlines are convex
      triangles.push_back({first, first + k - 1, first + k});
      owner.push_back(static_cast<int>(s));
    }
    normals.push_back(c.supports[s].plane.normal);
  }
  Json& planes = scene.add("planes", "supports", "Supports");
  planes["vertices"] = scene.positions(vertices);
  planes["rings"] = scene.pairs(rings);
  planes["triangles"] = scene.triples(triangles);
  planes["triangle_plane"] = scene.integers(owner);
  planes["normals"] = scene.vectors(normals);
  const std::vector<std::array<std::uint8_t, 3>> plain(c.supports.size(), kPlainSupport);
  planes["quantities"].push_back(quantity("plain", "Plain", "color", scene.colors(plain)));
}

void add_depth(SceneBuilder& scene, const Completion& c, const DepthPoints& points) {
  const std::vector<int> owner = cuboid_of_point(points.positions, c.cuboids);
  // What lies on a box hides its face, and is hidden by it, pixel by pixel: it starts out of sight.
  for (const bool on_boxes : {false, true}) {
    std::vector<Vec3> positions;
    std::vector<std::array<std::uint8_t, 3>> colors;
    std::vector<int> boxes;
    for (std::size_t i = 0; i < owner.size(); ++i) {
      if ((owner[i] >= 0) != on_boxes) continue;
      positions.push_back(points.positions[i]);
      if (!points.colors.empty()) colors.push_back(points.colors[i]);
      boxes.push_back(owner[i]);
    }
    if (positions.empty()) continue;
    Json& cloud =
        scene.add("points", on_boxes ? "points" : "surroundings", on_boxes ? "Points on boxes" : "Other points");
    cloud["visible"] = !on_boxes;
    cloud["positions"] = scene.point_positions(positions);
    if (!colors.empty())
      cloud["quantities"].push_back(quantity("photograph", "Photograph", "color", scene.colors(colors)));
    Json box = quantity("box", "Box", "label", scene.integers(boxes));
    box["structure"] = "boxes";
    cloud["quantities"].push_back(box);
  }
}

void add_camera(SceneBuilder& scene, const Completion& c, const RgbdFrame& frame) {
  if (frame.is_fused()) return;
  if (!frame.color.empty()) {
    Json& image = scene.add("image", "photograph", "Photograph");
    image["width"] = frame.camera.width;
    image["height"] = frame.camera.height;
    image["format"] = "image/jpeg";
    image["data"] = scene.bytes(io::jpeg_of(frame.color, frame.camera.width, frame.camera.height));
  }
  Json& camera = scene.add("camera", "camera", "Camera");
  write_camera(camera, c.T_world_camera, frame.camera);
  if (!frame.color.empty()) camera["image"] = "photograph";
}

}  // namespace unseen::report
