// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "report/cuboid_parts.h"
#include "report/palette.h"
#include "unseen/cuboids/engine_shapes.h"
#include "unseen/report/cuboids_files.h"

namespace unseen::report {
namespace {

using cuboids::Completion;

/// Roll, pitch and yaw as URDF has them: R = Rz(yaw) Ry(pitch) Rx(roll).
Vec3 roll_pitch_yaw(const Mat3& r) {
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  if (std::hypot(r(0, 0), r(1, 0)) < 1e-9) return {std::atan2(-r(1, 2), r(1, 1)), pitch, 0.0};
  return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
}

std::string origin_of(const RigidTransform& t) {
  return fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/>", attribute_of(t.translation), attribute_of(roll_pitch_yaw(t.rotation)));
}

/// A body of the tree: its name, its place in the world and its size.
struct Link {
  std::string name;
  RigidTransform T_world_link;
  Vec3 size;
  double mass = 0;  ///< 0 = none given: a support
  Rgb color;
};

std::string link_text(const Link& l, double friction) {
  const std::string shape = fmt::format("<geometry><box size=\"{}\"/></geometry>", attribute_of(l.size));
  std::string text = fmt::format("  <link name=\"{}\">\n", l.name);
  if (l.mass > 0) {
    const Vec3 s = l.size.cwiseAbs2() * (l.mass / 12.0);
    text += fmt::format(
        "    <inertial><mass value=\"{:.9g}\"/><inertia ixx=\"{:.9g}\" iyy=\"{:.9g}\" izz=\"{:.9g}\" ixy=\"0\" "
        "ixz=\"0\" iyz=\"0\"/></inertial>\n",
        l.mass, s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
  }
  text += fmt::format(
      "    <visual>{}<material name=\"{} colour\"><color rgba=\"{:.3f} {:.3f} {:.3f} 1\"/></material></visual>\n",
      shape, l.name, l.color[0] / 255.0, l.color[1] / 255.0, l.color[2] / 255.0);
  text += fmt::format("    <collision>{}</collision>\n", shape);
  text += fmt::format("    <contact><lateral_friction value=\"{:.9g}\"/></contact>\n  </link>\n", friction);
  return text;
}

std::string joint_text(const std::string& type, const Link* parent, const Link& child) {
  const RigidTransform place = parent ? parent->T_world_link.inverse() * child.T_world_link : child.T_world_link;
  const std::string parent_name = parent ? parent->name : "world";
  return fmt::format(
      "  <joint name=\"{}_to_{}\" type=\"{}\">\n    <parent link=\"{}\"/><child link=\"{}\"/>{}\n  </joint>\n",
      child.name, parent_name, type, parent_name, child.name, origin_of(place));
}

Link link_of(const cuboids::Cuboid& c, std::size_t index) {
  return {fmt::format("box_{}", c.id),
          {c.box.axes, c.box.center},
          2.0 * c.box.half_size,
          c.mass(),
          frame_color(static_cast<int>(index))};
}

/// URDF has no planes: a slab below the outline.
Link link_of(const cuboids::Support& s, const Completion& c) {
  const OrientedBox slab = cuboids::slab_behind(s.plane, polygon_of(s, c));
  return {fmt::format("support_{}", s.id), {slab.axes, slab.center}, 2.0 * slab.half_size, 0.0, {204, 204, 199}};
}

/// A joint for every box: fixed contacts as a tree from each group's root, whatever cycles they make.
std::string joints_of(const Completion& c, const std::vector<Link>& links,
                      const std::map<int, std::size_t>& link_of_id) {
  std::vector<std::vector<std::size_t>> fixed(links.size());
  for (const cuboids::Contact& contact : c.contacts) {
    if (contact.kind != cuboids::ContactKind::fixed) continue;
    fixed[link_of_id.at(contact.a)].push_back(link_of_id.at(contact.b));
    fixed[link_of_id.at(contact.b)].push_back(link_of_id.at(contact.a));
  }
  std::string text;
  std::vector<bool> joined(links.size(), false);
  for (std::size_t s = 0; s < c.supports.size(); ++s) {
    joined[s] = true;
    text += joint_text("fixed", nullptr, links[s]);
  }
  for (std::size_t root = 0; root < links.size(); ++root) {  // supports first, so that what hangs on them does
    if (!joined[root]) text += joint_text("floating", nullptr, links[root]);
    joined[root] = true;
    for (std::deque<std::size_t> open = {root}; !open.empty(); open.pop_front())
      for (const std::size_t next : fixed[open.front()]) {
        if (joined[next]) continue;
        joined[next] = true;
        text += joint_text("fixed", &links[open.front()], links[next]);
        open.push_back(next);
      }
  }
  return text;
}

}  // namespace

std::string cuboids_urdf(const Completion& c, double friction) {
  std::vector<Link> links;
  std::map<int, std::size_t> link_of_id;
  for (const cuboids::Support& support : c.supports) {
    link_of_id[support.id] = links.size();
    links.push_back(link_of(support, c));
  }
  for (std::size_t i = 0; i < c.cuboids.size(); ++i) {
    link_of_id[c.cuboids[i].id] = links.size();
    links.push_back(link_of(c.cuboids[i], i));
  }
  std::string text = "<?xml version=\"1.0\"?>\n<robot name=\"unseen\">\n  <link name=\"world\"/>\n";
  for (const Link& link : links) text += link_text(link, friction);
  return text + joints_of(c, links, link_of_id) + "</robot>\n";
}

}  // namespace unseen::report
