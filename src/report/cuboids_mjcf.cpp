// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>

#include "report/cuboid_parts.h"
#include "report/html.h"
#include "report/palette.h"
#include "unseen/cuboids/engine_shapes.h"
#include "unseen/report/cuboids_files.h"

namespace unseen::report {
namespace {

using cuboids::Completion;

std::string quaternion_of(const Mat3& rotation) {
  const Eigen::Quaterniond q(rotation);
  return fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}", q.w(), q.x(), q.y(), q.z());
}

/// The box as a geom, its place relative to `origin`.
std::string geom_of(const cuboids::Cuboid& c, const Vec3& origin, int color) {
  const Rgb rgb = frame_color(color);
  return fmt::format(
      "<geom name=\"{} geom\" type=\"box\" pos=\"{}\" quat=\"{}\" size=\"{}\" mass=\"{:.9g}\" rgba=\"{:.3f} {:.3f} "
      "{:.3f} 1\"/>\n",
      escape(name_of(c)), attribute_of(c.box.center - origin), quaternion_of(c.box.axes), attribute_of(cuboids::half_size_for_mujoco(c.box)), c.mass(),
      rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
}

/// MuJoCo's plane has a solid half space; what ends is a slab.
std::string support_geom(const Completion& c, std::size_t support, std::span<const OrientedBox> boxes) {
  const cuboids::Support& s = c.supports[support];
  const std::string name = escape(name_of(s));
  const std::string look = "rgba=\"0.8 0.8 0.78 1\"";
  if (cuboids::is_half_space(c.supports, support, boxes)) {
    Mat3 axes;
    axes.col(0) = any_orthogonal(s.plane.normal);
    axes.col(1) = s.plane.normal.cross(axes.col(0));
    axes.col(2) = s.plane.normal;
    return fmt::format("    <geom name=\"{}\" type=\"plane\" pos=\"{}\" quat=\"{}\" size=\"0 0 1\" {}/>\n", name,
                       attribute_of(s.plane.project(Vec3::Zero())), quaternion_of(axes), look);
  }
  const OrientedBox slab = cuboids::slab_behind(s.plane, s.outline);
  return fmt::format("    <geom name=\"{}\" type=\"box\" pos=\"{}\" quat=\"{}\" size=\"{}\" {}/>\n", name,
                     attribute_of(slab.center), quaternion_of(slab.axes), attribute_of(slab.half_size), look);
}

std::string group_body(const Completion& c, const RigidGroup& group) {
  const bool hangs = std::any_of(group.cuboids.begin(), group.cuboids.end(), [&](std::size_t i) { return c.hangs(c.cuboids[i].id); });
  Vec3 center = Vec3::Zero();
  double mass = 0;
  std::string name;
  for (const std::size_t i : group.cuboids) {
    center += c.cuboids[i].mass() * c.cuboids[i].box.center;
    mass += c.cuboids[i].mass();
    name += (name.empty() ? "" : " + ") + name_of(c.cuboids[i]);
  }
  center /= mass;
  std::string text;
  if (hangs) text += "    <!-- nothing in the scene can support this: held where it was seen -->\n";
  text += fmt::format("    <body name=\"{}\" pos=\"{}\">\n", escape(name), attribute_of(center));
  if (!hangs && group.support < 0) text += "      <freejoint/>\n";
  for (const std::size_t i : group.cuboids) text += "      " + geom_of(c.cuboids[i], center, static_cast<int>(i));
  return text + "    </body>\n";
}

}  // namespace

std::string cuboids_mjcf(const Completion& c, double friction) {
  // MuJoCo 2.2 wants to know before how much may touch. A box of a full wall has 10 contact points; its default memory
  // (nstack, numbers) grows with the square of all constraints and is far more than a sparse contact graph takes.
  const std::size_t boxes = c.cuboids.size(), contacts = 100 + 24 * boxes, constraints = 36 * boxes;
  const std::size_t numbers = 1'000'000 + 2 * constraints * constraints;
  std::string text = fmt::format(
      "<mujoco model=\"unseen\">\n"
      "  <compiler angle=\"radian\"/>\n"
      "  <option gravity=\"0 0 -9.81\" {}/>\n"
      "  <size nconmax=\"{}\" njmax=\"{}\" nstack=\"{}\"/>\n"
      "  <default>\n    <geom {}/>\n  </default>\n"
      "  <visual>\n    <global offwidth=\"1280\" offheight=\"960\"/>\n  </visual>\n"
      "  <worldbody>\n    <light directional=\"true\" pos=\"0 0 3\" dir=\"0.2 0.3 -1\"/>\n",
      cuboids::kMujocoOptions, contacts, 3 * contacts, numbers, cuboids::mujoco_contact(friction));
  std::vector<OrientedBox> all;
  for (const cuboids::Cuboid& cuboid : c.cuboids) all.push_back(cuboid.box);
  for (std::size_t i = 0; i < c.supports.size(); ++i) text += support_geom(c, i, all);
  for (const RigidGroup& group : rigid_groups(c)) text += group_body(c, group);
  return text + "  </worldbody>\n</mujoco>\n";
}

}  // namespace unseen::report
