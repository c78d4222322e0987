// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <mujoco/mujoco.h>

#include <algorithm>
#include <iomanip>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "cuboids/engines.h"

namespace unseen::test {
namespace {

std::string numbers(const Vec3& v) {
  std::ostringstream s;
  s << std::setprecision(17) << v.x() << ' ' << v.y() << ' ' << v.z();
  return s.str();
}

std::string rotation(const Mat3& m) {
  const Eigen::Quaterniond q(m);
  std::ostringstream s;
  s << std::setprecision(17) << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z();
  return s.str();
}

std::string box_geom(const RigidBox& b, const Vec3& origin) {
  std::ostringstream s;
  s << "<geom type=\"box\" pos=\"" << numbers(b.box.center - origin) << "\" quat=\"" << rotation(b.box.axes) << "\" size=\""
    << numbers(b.box.half_size) << "\" density=\"" << b.density << "\"/>";
  return s.str();
}

Vec3 centre_of_mass(const RigidScene& scene, const std::vector<int>& bodies, int body) {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i] != body) continue;
    const double m = scene.boxes[i].density * scene.boxes[i].box.volume();
    sum += m * scene.boxes[i].box.center;
    mass += m;
  }
  return sum / mass;
}

/// Bodies keep the world's axes, each about its own centre of mass: turned about another place they gain energy with every step.
std::string mjcf(const RigidScene& scene, const std::vector<int>& bodies) {
  std::ostringstream s;
  s << "<mujoco><option timestep=\"0.001\" cone=\"elliptic\" impratio=\"20\" solver=\"Newton\" noslip_iterations=\"5\""
    << " gravity=\"0 0 -9.81\"/><size nconmax=\"2000\" njmax=\"6000\"/><default><geom friction=\"" << scene.friction
    << " 0 0\" condim=\"3\"/></default><worldbody>";
  for (const Plane& p : scene.planes) {
    const Mat3 turn = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), p.normal).toRotationMatrix();
    s << "<geom type=\"plane\" size=\"50 50 1\" pos=\"" << numbers(p.offset * p.normal) << "\" quat=\""
      << rotation(turn) << "\"/>";
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i] < 0) s << box_geom(scene.boxes[i], Vec3::Zero());
  for (int body = 0; std::find(bodies.begin(), bodies.end(), body) != bodies.end(); ++body) {
    const Vec3 centre = centre_of_mass(scene, bodies, body);
    s << "<body name=\"" << body << "\" pos=\"" << numbers(centre) << "\"><freejoint/>";
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (bodies[i] == body) s << box_geom(scene.boxes[i], centre);
    s << "</body>";
  }
  s << "</worldbody></mujoco>";
  return s.str();
}

}  // namespace

Settled settle_mujoco(const RigidScene& scene, double seconds) {
  const std::vector<int> bodies = rigid_bodies(scene);
  const std::string xml = mjcf(scene, bodies);
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(xml.size()));
  std::copy(xml.begin(), xml.end(), static_cast<char*>(files->filedata[0]));
  char error[1000] = "";
  const std::unique_ptr<mjModel, decltype(&mj_deleteModel)> model(
      mj_loadXML("scene.xml", files.get(), error, sizeof error), mj_deleteModel);
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(error);
  const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(mj_makeData(model.get()), mj_deleteData);
  while (data->time < seconds) mj_step(model.get(), data.get());
  mj_kinematics(model.get(), data.get());
  std::vector<RigidTransform> poses;
  for (const int body : bodies) {
    RigidTransform pose;
    if (body >= 0) {
      const int id = mj_name2id(model.get(), mjOBJ_BODY, std::to_string(body).c_str());
      pose.rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data->xmat + 9 * id);
      pose.translation = Vec3::Map(data->xpos + 3 * id) - pose.rotation * centre_of_mass(scene, bodies, body);
    }
    poses.push_back(pose);
  }
  return settled_from(scene, std::move(poses));
}

}  // namespace unseen::test
