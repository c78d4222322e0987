// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/linear.h"
#include "report/interactions_motion.h"
#include "unseen/report/interactions_files.h"

namespace unseen::report {
namespace {

using namespace interactions;
using Eigen::Quaterniond;

const Vec3 kLeft = Vec3::UnitX(), kUp = Vec3::UnitY(), kForward = Vec3::UnitZ();  // of somebody at rest, in the file's axes

/// A joint of the file: where it stands, and where its bone from the parent points at rest (0: it stands in the parent's place).
struct Node {
  const char* name;
  int parent;
  Joint joint;
  Vec3 rest;
  Vec3 end = Vec3::Zero();  ///< m, of a joint that carries none: its end site
};

const std::vector<Node>& nodes() {
  static const std::vector<Node> list = {
      {"pelvis", -1, pelvis, Vec3::Zero()},
      {"right_pelvis", 0, pelvis, Vec3::Zero()},
      {"right_hip", 1, right_hip, -kLeft},
      {"right_knee", 2, right_knee, -kUp},
      {"right_ankle", 3, right_ankle, -kUp, 0.15 * kForward},
      {"left_pelvis", 0, pelvis, Vec3::Zero()},
      {"left_hip", 5, left_hip, kLeft},
      {"left_knee", 6, left_knee, -kUp},
      {"left_ankle", 7, left_ankle, -kUp, 0.15 * kForward},
      {"spine", 0, pelvis, Vec3::Zero()},
      {"thorax", 9, thorax, kUp},
      {"neck_base", 10, thorax, Vec3::Zero()},
      {"neck", 11, neck, kUp},
      {"head", 12, head, kUp, 0.1 * kUp},
      {"right_collar", 10, thorax, Vec3::Zero()},
      {"right_shoulder", 14, right_shoulder, -kLeft},
      {"right_elbow", 15, right_elbow, -kLeft},
      {"right_wrist", 16, right_wrist, -kLeft, -0.1 * kLeft},
      {"left_collar", 10, thorax, Vec3::Zero()},
      {"left_shoulder", 18, left_shoulder, kLeft},
      {"left_elbow", 19, left_elbow, kLeft},
      {"left_wrist", 20, left_wrist, kLeft, 0.1 * kLeft},
  };
  return list;
}

std::vector<int> children_of(int node) {
  std::vector<int> list;
  for (std::size_t i = 0; i < nodes().size(); ++i)
    if (nodes()[i].parent == node) list.push_back(static_cast<int>(i));
  return list;
}

/// World x, y, z to the file's axes.
Pose turned_up(const Pose& pose) {
  Pose out;
  out << pose.row(0), pose.row(2), -pose.row(1);
  return out;
}

/// A pose a frame from the first to the last, in the file's axes.
std::vector<Pose> every_pose(const Person& person) {
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < person.frames.size(); ++i) {
    const PersonFrame& to = person.frames[i];
    if (i > 0) {
      const PersonFrame& from = person.frames[i - 1];
      for (int f = from.frame + 1; f < to.frame; ++f) {
        const double t = static_cast<double>(f - from.frame) / (to.frame - from.frame);
        poses.push_back(turned_up((1.0 - t) * from.pose + t * to.pose));
      }
    }
    poses.push_back(turned_up(to.pose));
  }
  return poses;
}

/// The rotation that takes left at rest to `left` and up as near as can be to `up`; `otherwise` if they do not span a plane.
Quaterniond frame(const Vec3& left, const Vec3& up, const Quaterniond& otherwise) {
  Mat3 axes;
  axes.col(0) = left.normalized();
  axes.col(2) = left.cross(up).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return std::abs(axes.determinant() - 1.0) < 1e-6 ? Quaterniond(axes) : otherwise;
}

/// How each joint is turned against its parent. Joints that carry several are turned by those, others by the shortest way to where
/// their bone points.
std::vector<Quaterniond> rotations_of(const Pose& pose, const std::vector<Quaterniond>& last) {
  std::vector<Quaterniond> world(nodes().size()), local(nodes().size(), Quaterniond::Identity());
  for (std::size_t i = 0; i < nodes().size(); ++i) {
    const Node& node = nodes()[i];
    const Quaterniond parent = node.parent < 0 ? Quaterniond::Identity() : world[static_cast<std::size_t>(node.parent)];
    const std::vector<int> children = children_of(static_cast<int>(i));
    if (children.size() > 1) {
      const Vec3 left = node.joint == pelvis ? pose.col(left_hip) - pose.col(right_hip) : pose.col(left_shoulder) - pose.col(right_shoulder);
      const Vec3 up = node.joint == pelvis ? pose.col(thorax) - pose.col(pelvis) : pose.col(neck) - pose.col(thorax);
      world[i] = frame(left, up, parent * last[i]);
      local[i] = parent.conjugate() * world[i];
    } else if (children.size() == 1) {
      const Node& child = nodes()[static_cast<std::size_t>(children.front())];
      const Vec3 bone = pose.col(child.joint) - pose.col(node.joint);
      local[i] = bone.norm() > 1e-9 ? turn_between(child.rest, parent.conjugate() * bone) : last[i];
      world[i] = parent * local[i];
    } else {
      world[i] = parent;
    }
  }
  return local;
}

/// The multiple of a turn added that comes nearest to `last`, rad.
double near(double angle, double last) {
  return angle + 2.0 * kPi * std::round((last - angle) / (2.0 * kPi));
}

/// Angles about z, x, y, in this order from the left; of the two ways the one nearer to `last`.
Vec3 angles_of(const Mat3& R, const Vec3& last) {
  const double b = std::asin(std::clamp(R(2, 1), -1.0, 1.0));
  if (std::cos(b) < 1e-6) {  // only the sum or the difference of the others counts
    const double both = std::atan2(R(1, 0), R(0, 0)), sign = b > 0 ? 1.0 : -1.0;
    return {last.x(), near(b, last.y()), near(sign * (both - last.x()), last.z())};
  }
  const Vec3 one(std::atan2(-R(0, 1), R(1, 1)), b, std::atan2(-R(2, 0), R(2, 2)));
  const auto nearest = [&](const Vec3& a) { return Vec3(near(a.x(), last.x()), near(a.y(), last.y()), near(a.z(), last.z())); };
  const Vec3 first = nearest(one), second = nearest({one.x() + kPi, kPi - b, one.z() + kPi});
  return (first - last).squaredNorm() <= (second - last).squaredNorm() ? first : second;
}

std::string triple(const Vec3& v, int digits) {
  // Adding 0 makes −0 a plain 0.
  const double scale = std::pow(10.0, digits);
  const auto rounded = [&](double x) { return std::round(x * scale) / scale + 0.0; };
  return fmt::format("{:.{}f} {:.{}f} {:.{}f}", rounded(v.x()), digits, rounded(v.y()), digits, rounded(v.z()), digits);
}

/// The length of the bone that ends at a joint, m.
double length_to(Joint joint, const std::array<double, kBones.size()>& lengths) {
  for (std::size_t b = 0; b < kBones.size(); ++b)
    if (kBones[b][1] == joint) return lengths[b];
  return 0.0;
}

/// Parents stand before their children, so the file's order is that of the list.
void write_node(std::string& out, int index, int depth, const std::array<double, kBones.size()>& lengths) {
  const Node& node = nodes()[static_cast<std::size_t>(index)];
  const std::string indent(static_cast<std::size_t>(depth), '\t');
  const bool root = node.parent < 0;
  const Vec3 offset = 100.0 * length_to(node.joint, lengths) * node.rest;
  out += fmt::format("{}{} {}\n{}{{\n{}\tOFFSET {}\n", indent, root ? "ROOT" : "JOINT", node.name, indent, indent, triple(offset, 4));
  out += fmt::format("{}\tCHANNELS {}Zrotation Xrotation Yrotation\n", indent, root ? "6 Xposition Yposition Zposition " : "3 ");
  const std::vector<int> children = children_of(index);
  for (const int child : children) write_node(out, child, depth + 1, lengths);
  if (children.empty())
    out += fmt::format("{}\tEnd Site\n{}\t{{\n{}\t\tOFFSET {}\n{}\t}}\n", indent, indent, indent, triple(100.0 * node.end, 4), indent);
  out += indent + "}\n";
}

}  // namespace

std::string interactions_bvh(const Person& person, double fps) {
  if (person.frames.empty()) return "";
  if (static_cast<double>(person.frames.back().frame) - person.frames.front().frame >= static_cast<double>(kMostBvhFrames)) return "";
  const std::vector<Pose> poses = every_pose(person);
  std::string out = "HIERARCHY\n";
  write_node(out, 0, 0, bone_lengths(person));
  out += fmt::format("MOTION\nFrames: {}\nFrame Time: {:.9g}\n", poses.size(), 1.0 / fps);
  std::vector<Quaterniond> last(nodes().size(), Quaterniond::Identity());
  std::vector<Vec3> angles(nodes().size(), Vec3::Zero());
  for (const Pose& pose : poses) {
    last = rotations_of(pose, last);
    out += triple(100.0 * pose.col(pelvis), 4);
    for (std::size_t i = 0; i < nodes().size(); ++i) {
      angles[i] = angles_of(last[i].toRotationMatrix(), angles[i]);
      out += ' ';
      out += triple(180.0 / kPi * angles[i], 4);
    }
    out += "\n";
  }
  return out;
}

std::string bvh_name(std::size_t person) {
  return person == 0 ? "motion.bvh" : fmt::format("motion-{}.bvh", person);
}

}  // namespace unseen::report
