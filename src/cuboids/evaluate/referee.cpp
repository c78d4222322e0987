// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/evaluate/referee.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#ifdef UNSEEN_HAS_MUJOCO
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <cstring>
#include <iterator>
#include <memory>
#include <string>

#include "cuboids/synth/synth_builder.h"
#include "unseen/cuboids/engine_shapes.h"
#endif

namespace unseen::cuboids {

std::vector<int> bodies_of(const RefereeScene& scene) {
  std::vector<int> body(scene.boxes.size());
  std::iota(body.begin(), body.end(), 0);
  for (const auto& [a, b] : scene.fixed) {
    const int first = a < 0 ? -1 : body[a], second = b < 0 ? -1 : body[b];
    for (int& of : body)
      if (of == first || of == second) of = std::min(first, second);
  }
  return body;
}

#ifndef UNSEEN_HAS_MUJOCO

bool has_referee() { return false; }
std::vector<double> simulate(const RefereeScene&, const Vec3&, double, Context&) {
  throw std::logic_error("built without MuJoCo");
}

#else

namespace {

constexpr double kGravity = 9.81;
constexpr int kStepsBetweenLooks = 10;
constexpr double kFlungApart = 1.0;  // share of its longest side that each box counts as moved if the simulation blows up

std::string quaternion_text(const Mat3& rotation) {
  const Eigen::Quaterniond q(rotation);
  return fmt::format("{} {} {} {}", q.w(), q.x(), q.y(), q.z());
}

std::string vector_text(const Vec3& v) {
  return fmt::format("{} {} {}", v.x(), v.y(), v.z());
}

/// Axes whose third is `normal`.
Mat3 upright_on(const Vec3& normal) {
  Mat3 axes;
  axes.col(0) = any_orthogonal(normal);
  axes.col(1) = normal.cross(axes.col(0));
  axes.col(2) = normal;
  return axes;
}

std::string support_text(const RefereeScene& scene, std::size_t support) {
  const Plane& plane = scene.supports[support].plane;
  if (is_half_space(scene.supports, support, scene.boxes))
    return fmt::format("<geom type=\"plane\" size=\"0 0 1\" pos=\"{}\" quat=\"{}\"/>", vector_text(plane.offset * plane.normal),
                       quaternion_text(upright_on(plane.normal)));
  const OrientedBox slab = slab_behind(plane, scene.supports[support].outline);
  return fmt::format("<geom type=\"box\" size=\"{}\" pos=\"{}\" quat=\"{}\"/>", vector_text(slab.half_size), vector_text(slab.center),
                     quaternion_text(slab.axes));
}

/// Where the mass of a body's boxes has its centre. A body that MuJoCo turns about another place gains energy with every step, and may fly apart.
Vec3 centre_of_mass(const RefereeScene& scene, const std::vector<int>& body, int of) {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < scene.boxes.size(); ++i)
    if (body[i] == of) sum += scene.masses[i] * scene.boxes[i].center, mass += scene.masses[i];
  return sum / mass;
}

/// Bodies keep the world's axes, each about its own centre of mass.
std::string model_text(const RefereeScene& scene, const std::vector<int>& body, const Vec3& down) {
  std::string text;
  auto out = std::back_inserter(text);
  const std::size_t points = 24 * (scene.boxes.size() + 1);  // MuJoCo's memory grows with the square of this
  fmt::format_to(out,
                 "<mujoco><size nconmax=\"{}\" njmax=\"{}\" nstack=\"{}\"/>"
                 "<option {} gravity=\"{}\"/><default><geom {}/></default><worldbody>",
                 points, 3 * points, 2'000'000 + 700'000 * scene.boxes.size(), kMujocoOptions, vector_text(kGravity * down), mujoco_contact(scene.friction));
  for (std::size_t i = 0; i < scene.supports.size(); ++i) text += support_text(scene, i);
  const auto add_boxes = [&](int of, const Vec3& origin) {
    for (std::size_t i = 0; i < scene.boxes.size(); ++i)
      if (body[i] == of)
        fmt::format_to(out, "<geom name=\"box{}\" type=\"box\" size=\"{}\" pos=\"{}\" quat=\"{}\" mass=\"{}\"/>", i,
                       vector_text(half_size_for_mujoco(scene.boxes[i])), vector_text(scene.boxes[i].center - origin),
                       quaternion_text(scene.boxes[i].axes), scene.masses[i]);
  };
  add_boxes(-1, Vec3::Zero());
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    if (body[i] != static_cast<int>(i)) continue;
    const Vec3 centre = centre_of_mass(scene, body, body[i]);
    fmt::format_to(out, "<body pos=\"{}\"><freejoint/>", vector_text(centre));
    add_boxes(body[i], centre);
    text += "</body>";
  }
  return text + "</worldbody></mujoco>";
}

using Model = std::unique_ptr<mjModel, decltype(&mj_deleteModel)>;
using State = std::unique_ptr<mjData, decltype(&mj_deleteData)>;

Model load(const std::string& text) {
  constexpr const char* kName = "scene.xml";
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(text.size()));
  const int at = mj_findFileVFS(files.get(), kName);
  std::memcpy(files->filedata[at], text.data(), text.size());
  char error[500] = "";
  Model model(mj_loadXML(kName, files.get(), error, sizeof error), mj_deleteModel);
  mj_deleteVFS(files.get());
  if (!model) throw std::logic_error(std::string("MuJoCo: ") + error);
  return model;
}

OrientedBox place_of(const mjModel* model, const mjData* data, const RefereeScene& scene, std::size_t i) {
  const int geom = mj_name2id(model, mjOBJ_GEOM, fmt::format("box{}", i).c_str());
  OrientedBox box = scene.boxes[i];
  for (int r = 0; r < 3; ++r) {
    box.center[r] = data->geom_xpos[3 * geom + r];
    for (int c = 0; c < 3; ++c) box.axes(r, c) = data->geom_xmat[9 * geom + 3 * r + c];
  }
  return box;
}

/// Share of its longest side that the corner of a box that went farthest went.
double move_of(const OrientedBox& from, const OrientedBox& to) {
  const auto before = corners_of(from), after = corners_of(to);
  double farthest = 0;
  for (int k = 0; k < 8; ++k) farthest = std::max(farthest, (after[k] - before[k]).norm());
  return farthest / (2.0 * from.half_size.maxCoeff());
}

}  // namespace

bool has_referee() { return true; }

std::vector<double> simulate(const RefereeScene& scene, const Vec3& down, double seconds, Context& context) {
  mju_user_warning = [](const char*) {};  // else it writes a file beside the user's own
  const Model model = load(model_text(scene, bodies_of(scene), down));
  const State data(mj_makeData(model.get()), mj_deleteData);
  std::vector<double> moved(scene.boxes.size(), 0.0);
  while (data->time < seconds) {
    context.check();
    for (int i = 0; i < kStepsBetweenLooks; ++i) mj_step(model.get(), data.get());
    if (data->warning[mjWARN_BADQACC].number > 0) {  // MuJoCo has begun again by itself: nothing is shown to stand
      for (double& m : moved) m = std::max(m, kFlungApart);
      break;
    }
    mj_kinematics(model.get(), data.get());
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = move_of(scene.boxes[i], place_of(model.get(), data.get(), scene, i));
  }
  return moved;
}

#endif

}  // namespace unseen::cuboids
