// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "cuboids/synth/synth_builder.h"
#include "cuboids/synth/synth_sensor.h"

namespace unseen::cuboids {
namespace {

constexpr Camera kCamera = {525.0, 525.0, 319.5, 239.5, 640, 480};
constexpr double kBorder = 24.0;                 // pixels around the boxes
constexpr double kNearest = 0.75;                // m, of any corner: nearer a depth camera sees nothing
constexpr double kWallHeight = 2.4;              // m
constexpr int kFaceSamples = 24;                 // a side, for the hidden share of a face

/// A camera at `position` that looks at `target`, upright.
RigidTransform looking(const Vec3& position, const Vec3& target) {
  const Vec3 forward = (target - position).normalized(), right = forward.cross(Vec3::UnitZ()).normalized();
  RigidTransform pose;
  pose.rotation.col(0) = right;
  pose.rotation.col(1) = forward.cross(right);
  pose.rotation.col(2) = forward;
  pose.translation = position;
  return pose;
}

bool sees_all(const RigidTransform& T_scene_camera, const std::vector<OrientedBox>& boxes) {
  const RigidTransform T_camera_scene = T_scene_camera.inverse();
  for (const OrientedBox& box : boxes)
    for (const Vec3& corner : corners_of(box)) {
      const Vec3 p = T_camera_scene * corner;
      if (p.z() < kNearest) return false;
      const Vec2 pixel = kCamera.project(p);
      if (pixel.x() < kBorder || pixel.y() < kBorder || pixel.x() > kCamera.width - 1 - kBorder ||
          pixel.y() > kCamera.height - 1 - kBorder)
        return false;
    }
  return true;
}

/// As near as all boxes are in the picture, at the model's height, from `azimuth` counter-clockwise from the front.
RigidTransform place_camera(const SynthModel& model, double azimuth) {
  constexpr double kStep = 0.02, kFarthest = 8.0;
  Eigen::AlignedBox3d all;
  for (const OrientedBox& box : model.boxes)
    for (const Vec3& corner : corners_of(box)) all.extend(corner);
  const Vec3 target = all.center();
  const Vec3 away(std::sin(azimuth), -std::cos(azimuth), 0.0);
  RigidTransform pose;
  for (double distance = 0.5; distance < kFarthest; distance += kStep) {
    const Vec3 position = Vec3(target.x(), target.y(), model.camera_height) + distance * away;
    pose = looking(position, target);
    if (sees_all(pose, model.boxes)) break;
  }
  return pose;
}

/// Outlines of the supports, as far as they reach around the boxes.
void bound_supports(SynthModel& model) {
  Eigen::AlignedBox3d all;
  for (const OrientedBox& box : model.boxes)
    for (const Vec3& corner : corners_of(box)) all.extend(corner);
  const double reach = model.ground_margin;
  const Vec3 low = all.min() - Vec3::Constant(reach), high = all.max() + Vec3::Constant(reach);
  const double back = model.supports.size() > 1 ? -model.supports[1].plane.offset : high.y();
  model.supports[0].outline = {{low.x(), low.y(), 0}, {high.x(), low.y(), 0}, {high.x(), back, 0}, {low.x(), back, 0}};
  if (model.supports.size() > 1)
    model.supports[1].outline = {{low.x(), back, 0},
                                 {high.x(), back, 0},
                                 {high.x(), back, kWallHeight},
                                 {low.x(), back, kWallHeight}};
}

/// Everything moved to where the result has its world.
SynthModel moved(const SynthModel& model, const RigidTransform& T) {
  SynthModel out = model;
  for (OrientedBox& box : out.boxes) {
    box.center = T * box.center;
    box.axes = T.rotation * box.axes;
  }
  for (Support& support : out.supports) {
    for (Vec3& corner : support.outline) corner = T * corner;
    support.plane.normal = T.rotation * support.plane.normal;
    support.plane.offset += support.plane.normal.dot(T.translation);
  }
  return out;
}

/// Notes the share of each face that no ray from the camera reaches, and how much of each dimension the rest spans.
void look_at_faces(TrueCuboid& cuboid, const SynthModel& model, const std::vector<bool>& shown,
                   const RigidTransform& T_world_camera) {
  const OrientedBox& box = *cuboid.box;
  const RayScene scene(model, shown);
  const RigidTransform T_camera_world = T_world_camera.inverse();
  const Vec3& eye = T_world_camera.translation;
  Eigen::AlignedBox3d span;
  for (int f = 0; f < 6; ++f) {
    const int k = f / 2, i = (k + 1) % 3, j = (k + 2) % 3;
    const double sign = f % 2 == 0 ? -1.0 : 1.0;
    int seen = 0;
    for (int a = 0; a < kFaceSamples; ++a)
      for (int b = 0; b < kFaceSamples; ++b) {
        Vec3 at = Vec3::Zero();
        at[k] = sign * box.half_size[k];
        at[i] = ((a + 0.5) / kFaceSamples * 2.0 - 1.0) * box.half_size[i];
        at[j] = ((b + 0.5) / kFaceSamples * 2.0 - 1.0) * box.half_size[j];
        const Vec3 p = box.center + box.axes * at, ray = p - eye;
        if (sign * box.axes.col(k).dot(ray) >= 0) continue;
        const Vec3 in_camera = T_camera_world * p;
        const Vec2 pixel = kCamera.project(in_camera);
        const bool inside = in_camera.z() > 0 && pixel.x() > -0.5 && pixel.y() > -0.5 &&
                            pixel.x() < kCamera.width - 0.5 && pixel.y() < kCamera.height - 0.5;
        if (inside && scene.first_hit(eye, ray).distance > 1.0 - 1e-9) {
          ++seen;
          // A sample stands for its cell.
          Vec3 cell = box.half_size / kFaceSamples;
          cell[k] = 0.0;
          span.extend(at - cell);
          span.extend(at + cell);
        }
      }
    cuboid.hidden[f] = 1.0 - seen / static_cast<double>(kFaceSamples * kFaceSamples);
  }
  cuboid.seen = span.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(span.sizes().cwiseQuotient(cuboid.size));
}

Truth truth_of(const SynthModel& model, const std::vector<bool>& shown, const RigidTransform& T_world_camera,
               const std::string& family) {
  Truth truth;
  truth.family = family;
  truth.stands = model.stands;
  truth.T_world_camera = T_world_camera;
  truth.supports = model.supports;
  const auto is_shown = [&](int id) {
    const auto support_count = static_cast<int>(model.supports.size());
    return id < support_count || shown[static_cast<std::size_t>(id - support_count)];
  };
  for (std::size_t i = 0; i < model.boxes.size(); ++i) {
    if (!shown[i]) continue;
    TrueCuboid cuboid;
    cuboid.id = model.id_of_box(i);
    cuboid.box = model.boxes[i];
    cuboid.size = 2.0 * model.boxes[i].half_size;
    look_at_faces(cuboid, model, shown, T_world_camera);
    truth.cuboids.push_back(cuboid);
  }
  for (const Contact& contact : model.contacts)
    if (is_shown(contact.a) && is_shown(contact.b)) truth.contacts.push_back(contact);
  return truth;
}

}  // namespace

SynthView photograph(const SynthModel& built, const std::vector<bool>& shown, double azimuth,
                     const SynthOptions& options, Context& context) {
  SynthModel model = built;
  bound_supports(model);
  const RigidTransform T_scene_camera = place_camera(model, azimuth);
  const Vec3& eye = T_scene_camera.translation;
  const Vec3 forward = T_scene_camera.rotation.col(2);
  RigidTransform T_world_scene;
  T_world_scene.rotation =
      Eigen::AngleAxisd(kPi / 2 - std::atan2(forward.y(), forward.x()), Vec3::UnitZ()).toRotationMatrix();
  T_world_scene.translation = -(T_world_scene.rotation * Vec3(eye.x(), eye.y(), 0.0));
  model = moved(model, T_world_scene);

  SynthView view;
  view.azimuth = azimuth;
  view.camera = kCamera;
  const RigidTransform T_world_camera = T_world_scene * T_scene_camera;
  view.truth = truth_of(model, shown, T_world_camera, options.scene);
  render(model, shown, T_world_camera, view, context);
  // Different noise from each azimuth, the same whichever views are asked for.
  const auto turn = static_cast<std::uint64_t>(std::llround(degrees(azimuth) * 1000.0) + 1'000'000);
  Random random(static_cast<std::uint64_t>(options.seed) * 3'000'017 + turn);
  view.depth = measure(view.exact_depth, view.camera, options.noise, options.dropout, random);
  return view;
}

}  // namespace unseen::cuboids
