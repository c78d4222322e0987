// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/synth/synth_builder.h"

namespace unseen::planes {
namespace {

Mat3 about_z(double angle) {
  return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
}

}  // namespace

RigidTransform upright_pose(const Vec3& position, double angle) {
  return {about_z(angle), position};
}

SynthBuilder::SynthBuilder(double yaw) : yaw_(about_z(yaw)) {
  add_frame(Mat3::Identity());
}

int SynthBuilder::add_frame(const Mat3& rotation) {
  model_.axes.push_back(yaw_ * rotation);
  return static_cast<int>(model_.axes.size()) - 1;
}

int SynthBuilder::add_polygon(const std::vector<Vec3>& corners, int frame, int label) {
  const auto first = static_cast<std::uint32_t>(model_.mesh.vertices.size());
  for (const Vec3& corner : corners) model_.mesh.vertices.push_back(yaw_ * corner);
  const auto* v = model_.mesh.vertices.data() + first;
  if (label < 0) {
    label = static_cast<int>(model_.planes.size());
    const Vec3 normal = (v[1] - v[0]).cross(v[2] - v[0]).normalized();
    model_.planes.push_back({normal, normal.dot(v[0])});
    model_.frames.push_back(frame);
  }
  for (std::uint32_t k = 2; k < corners.size(); ++k) {
    model_.mesh.triangles.push_back({first, first + k - 1, first + k});
    model_.mesh.labels.push_back(label);
  }
  return label;
}

void SynthBuilder::add_box(const Vec3& low, const Vec3& high, const RigidTransform& pose, int frame,
                           bool turned) {
  const auto corner = [&](int x, int y, int z) {
    return pose * Vec3(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
  };
  const std::vector<std::vector<Vec3>> faces = {
      {corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)},
      {corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)},
      {corner(1, 1, 0), corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1)},
      {corner(0, 1, 0), corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1)},
      {corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)}};
  for (const auto& face : faces) {
    const int label = add_polygon(face, frame);
    if (turned) model_.turned.push_back(label);
  }
}

void SynthBuilder::add_wall(const Vec2& a, const Vec2& b, double low, double high, double thickness,
                            double door) {
  const double length = (b - a).norm();
  const Vec2 along = (b - a) / length, across(-along.y(), along.x());
  for (const double side : {-0.5, 0.5}) {
    int label = -1;
    const auto add = [&](double from, double to, double bottom, double top) {
      const Vec2 p = a + from * along + side * thickness * across,
                 q = a + to * along + side * thickness * across;
      label = add_polygon(
          {{p.x(), p.y(), bottom}, {q.x(), q.y(), bottom}, {q.x(), q.y(), top}, {p.x(), p.y(), top}}, 0,
          label);
    };
    if (door < 0) {
      add(0, length, low, high);
    } else {
      add(0, door, low, high);
      add(door + 0.9, length, low, high);
      add(door, door + 0.9, low + 2.1, high);
    }
  }
}

void SynthBuilder::add_segment(const Vec2& a, const Vec2& b, int frame, bool turned) {
  const int label =
      add_polygon({{a.x(), a.y(), -1}, {b.x(), b.y(), -1}, {b.x(), b.y(), 1}, {a.x(), a.y(), 1}}, frame);
  model_.segments.push_back({yaw_ * Vec3(a.x(), a.y(), 0), yaw_ * Vec3(b.x(), b.y(), 0)});
  if (turned) model_.turned.push_back(label);
}

void SynthBuilder::add_outline(const std::vector<Vec2>& corners, int frame, bool turned) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    add_segment(corners[i], corners[(i + 1) % corners.size()], frame, turned);
}

}  // namespace unseen::planes
