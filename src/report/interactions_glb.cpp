// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <cmath>

#include "core/linear.h"
#include "report/glb_boxes.h"
#include "report/interactions_motion.h"
#include "report/interactions_structures.h"
#include "report/motion_glb.h"
#include "unseen/report/interactions_files.h"

namespace unseen::report {
namespace {

using namespace interactions;

constexpr double kLimb = 0.035, kHead = 0.1;    ///< m, radii
constexpr std::uint32_t kSides = 12, kCap = 4;  ///< of a capsule, around and from its equator to its pole

/// Along +z from 0 to `length`, with round ends around both.
TriangleMesh capsule(double radius, double length) {
  TriangleMesh mesh;
  for (std::uint32_t ring = 0; ring <= 2 * kCap + 1; ++ring) {
    const bool upper = ring > kCap;
    const double latitude = 0.5 * kPi * (static_cast<double>(upper ? ring - 1 : ring) / kCap - 1.0);
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const double angle = 2.0 * kPi * s / kSides;
      mesh.vertices.push_back({radius * std::cos(latitude) * std::cos(angle), radius * std::cos(latitude) * std::sin(angle),
                               radius * std::sin(latitude) + (upper ? length : 0.0)});
    }
  }
  for (std::uint32_t ring = 0; ring <= 2 * kCap; ++ring)
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const std::uint32_t a = ring * kSides + s, b = ring * kSides + (s + 1) % kSides;
      mesh.triangles.push_back({a, b, b + kSides});
      mesh.triangles.push_back({a, b + kSides, a + kSides});
    }
  return mesh;
}

/// Where a joint goes. Seconds of the file are those of the take.
Motion joint_motion(const Person& person, double fps, Joint joint) {
  Motion motion;
  for (const PersonFrame& f : person.frames) {
    motion.times.push_back(f.frame / fps);
    motion.positions.push_back(f.pose.col(joint));
  }
  return motion;
}

/// +z along the bone, turned from frame to frame by the shortest way.
Motion bone_motion(const Person& person, double fps, Joint from, Joint to) {
  Motion motion = joint_motion(person, fps, from);
  Vec3 last = Vec3::UnitZ();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  for (const PersonFrame& f : person.frames) {
    const Vec3 bone = f.pose.col(to) - f.pose.col(from);
    if (bone.norm() > 1e-9) {
      turn = (turn_between(last, bone) * turn).normalized();
      last = bone;
    }
    motion.rotations.push_back(turn);
  }
  keep_signs(motion);
  return motion;
}

void add_person(GlbBuilder& b, const Person& person, double fps, const Rgb& color) {
  if (person.frames.empty()) return;
  const std::string name = name_of(person);
  for (int j = 0; j < kJoints; ++j) {
    if (j == head) continue;
    const Motion motion = joint_motion(person, fps, static_cast<Joint>(j));
    b.add_motion(b.add_empty_node(fmt::format("{} {}", name, kJointNames[static_cast<std::size_t>(j)]), motion.positions.front()), motion.times,
                 motion.positions, {});
  }
  add_moving(b, name + " head", capsule(kHead, 0.0), joint_motion(person, fps, head), color);
  const auto lengths = bone_lengths(person);
  for (std::size_t i = 0; i < kBones.size(); ++i) {
    const auto [from, to] = kBones[i];
    add_moving(b, fmt::format("{} {} to {}", name, kJointNames[from], kJointNames[to]), capsule(kLimb, lengths[i]),
               bone_motion(person, fps, from, to), color);
  }
}

void add_object(GlbBuilder& b, const FoundObject& found) {
  std::vector<OrientedBox> boxes;
  for (const Part& part : found.object.parts) boxes.push_back(part.box);
  if (boxes.empty()) return;
  const int material = b.add_material(name_of(found), frame_color(static_cast<int>(found.object.superclass())));
  b.add_node(name_of(found), boxes_primitive(b, boxes, material));
}

}  // namespace

std::string interactions_glb(const Reconstruction& r) {
  GlbBuilder b(Vec3::Zero());
  for (const FoundObject& found : r.objects) add_object(b, found);
  for (std::size_t p = 0; p < r.people.size(); ++p) add_person(b, r.people[p], r.fps, frame_color(person_label(p)));
  add_camera(b, r.T_world_camera, r.camera);
  return b.finish();
}

}  // namespace unseen::report
