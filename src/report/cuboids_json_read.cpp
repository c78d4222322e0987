// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <cmath>
#include <set>
#include <utility>

#include "report/result_read.h"
#include "unseen/report/cuboids_result.h"

namespace unseen::report {
namespace {

using Ids = std::set<int>;

std::vector<Vec3> vectors(const JsonField& json) {
  std::vector<Vec3> list;
  for (const JsonField& field : json.list()) list.push_back(field.vector());
  return list;
}

OrientedBox box(const JsonField& json, const std::string& prefix) {
  OrientedBox b;
  b.center = json[prefix + "center"].vector();
  b.axes = read_axes(json[prefix + "axes"]);
  b.half_size = 0.5 * json[prefix + "size"].vector();
  if (!(b.half_size.minCoeff() > 0.0)) json[prefix + "size"].fail("three sizes above 0");
  return b;
}

cuboids::Support support(const JsonField& json, Ids& ids) {
  cuboids::Support s;
  s.id = new_id(json["id"], ids);
  s.kind = kind_of<cuboids::SupportKind>(json["kind"], cuboids::kSupportKinds);
  s.plane = {json["normal"].unit_vector(), json["offset"].number()};
  if (!json.has("outline")) return s;
  s.outline = vectors(json["outline"]);
  if (s.outline.size() < 3) json["outline"].fail("at least three points");
  return s;
}

cuboids::Cuboid cuboid(const JsonField& json, Ids& ids) {
  cuboids::Cuboid c;
  c.id = new_id(json["id"], ids);
  c.box = box(json, "");
  c.initial = box(json, "initial_");
  c.visible_points = json["visible_points"].count();
  c.density = json["density"].number(0);
  const double mass = json["mass"].number(0);
  if (std::abs(mass - c.mass()) > 1e-6 * c.mass()) json["mass"].fail(fmt::format("{}, density times volume", c.mass()));
  if (json.has("label")) c.label = json["label"].text();
  if (json.has("by_symmetry")) c.by_symmetry = json["by_symmetry"].truth();
  return c;
}

cuboids::Contact contact(const JsonField& json, const Ids& ids) {
  cuboids::Contact c;
  c.a = known_id(json["a"], ids);
  c.b = known_id(json["b"], ids);
  if (c.a == c.b) json["b"].fail("another body than a");
  c.kind = kind_of<cuboids::ContactKind>(json["kind"], cuboids::kContactKinds);
  c.direction = json["direction"].unit_vector();
  c.points = vectors(json["points"]);
  c.forces = vectors(json["forces"]);
  if (!c.forces.empty() && (c.kind == cuboids::ContactKind::fixed || c.forces.size() != c.points.size()))
    json["forces"].fail("a force a point; none if fixed");
  return c;
}

}  // namespace

cuboids::Completion parse_cuboids_result(const std::string& text, const std::string& source) {
  const nlohmann::json parsed = parse_json(text, source);
  const JsonField json(parsed, source);
  if (json["schema"].count() != 1) json["schema"].fail("1");
  if (json["capability"].text() != "cuboids") json["capability"].fail("\"cuboids\"");
  cuboids::Completion c;
  Ids ids;
  c.summary = read_summary(json["summary"], text);
  c.T_world_camera = read_transform(json["T_world_camera"]);
  if (json.has("depth_noise")) c.depth_noise = json["depth_noise"].number(0);
  for (const JsonField& field : json["supports"].list()) c.supports.push_back(support(field, ids));
  const Ids supports = ids;
  for (const JsonField& field : json["cuboids"].list()) c.cuboids.push_back(cuboid(field, ids));
  std::set<std::pair<int, int>> pairs;
  for (const JsonField& field : json["contacts"].list()) {
    c.contacts.push_back(contact(field, ids));
    const auto [low, high] = std::minmax(c.contacts.back().a, c.contacts.back().b);
    if (supports.count(c.contacts.back().b) != 0) field["b"].fail("a cuboid; a support stands first");
    if (!pairs.emplace(low, high).second) field["b"].fail("a pair that no other contact has");
  }
  const JsonField stability = json["stability"], search = json["search"];
  c.stability = {stability["residual"].number(0), stability["stable"].truth(), stability["margin"].number(0),
                 stability["friction_needed"].number(0)};
  c.fixed_contacts = json["fixed_contacts"].index(c.contacts.size() + 1);
  c.extended_volume = json["extended_volume"].number(0);
  const auto read_cuboid_ids = [&](const JsonField& list, std::vector<int>& out) {
    for (const JsonField& field : list.list()) {
      out.push_back(known_id(field, ids));
      if (supports.count(out.back()) != 0) field.fail("the id of a cuboid");
    }
  };
  read_cuboid_ids(json["unsupported"], c.unsupported);
  if (json.has("held_outside")) read_cuboid_ids(json["held_outside"], c.held_outside);
  if (json.has("may_move")) read_cuboid_ids(json["may_move"], c.may_move);
  c.search = {search["nodes"].count(), search["pruned"].count(), search["optimal"].truth()};
  return c;
}

cuboids::Completion read_cuboids_result(const std::filesystem::path& path) {
  return parse_cuboids_result(read_result_text(path), path.string());
}

}  // namespace unseen::report
