// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/usd_text.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/core/version.h"
#include "unseen/report/stage_files.h"

namespace unseen::report {
namespace {

using namespace collision;

/// "{0: …, 1: …}", a sample a frame; times as numbers of frames.
template <class Write>
std::string samples(const StagedShot& shot, Write write) {
  std::string text = "{";
  for (const StagedFrame& f : shot.frames) text += fmt::format("{}{}: {}", text.size() > 1 ? ", " : "", f.time * shot.fps, write(f));
  return text + "}";
}

void add_actor(UsdText& usd, const StagedShot& shot, std::size_t i) {
  const Actor& actor = shot.actors[i];
  const TriangleMesh mesh = body_mesh(actor.body, actor.name);
  usd.open("Mesh", fmt::format("body_{}", i));
  usd.line("double3 xformOp:translate.timeSamples = " + samples(shot, [&](const StagedFrame& f) { return tuple(f.bodies[i].p); }));
  Quat last = Quat::Identity();  // the sign of neighbouring quaternions is the same
  usd.line("quatf xformOp:orient.timeSamples = " + samples(shot, [&](const StagedFrame& f) {
             Quat q = f.bodies[i].q;
             if (q.dot(last) < 0) q.coeffs() *= -1.0;
             last = q;
             return fmt::format("({}, {}, {}, {})", static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()));
           }));
  usd.line("uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\"]");
  usd.line("uniform token subdivisionScheme = \"none\"");
  usd.line("point3f[] points = " + list(mesh.vertices, [](const Vec3& v) { return tuple(Vec3f(v.cast<float>())); }));
  usd.line("int[] faceVertexCounts = " + list(mesh.triangles, [](const auto&) { return "3"; }));
  usd.line("int[] faceVertexIndices = " + list(mesh.triangles, [](const auto& t) { return fmt::format("{}, {}, {}", t[0], t[1], t[2]); }));
  usd.primvar("color3f[] primvars:displayColor = [" + color(frame_color(static_cast<int>(i))) + "]", "constant");
  usd.line("custom string userProperties:name = " + quoted(actor.name));
  usd.close();
}

}  // namespace

std::string stage_usda(const StagedShot& shot) {
  UsdText usd(
      fmt::format("#usda 1.0\n(\n    defaultPrim = \"unseen\"\n    doc = \"staged collisions of unseen {}\"\n    endTimeCode = {}\n"
                  "    metersPerUnit = 1\n    startTimeCode = 0\n    timeCodesPerSecond = {}\n    upAxis = \"Z\"\n)\n\n",
                  kVersion, shot.frames.back().time * shot.fps, shot.fps));
  usd.open("Xform", "unseen");
  for (std::size_t i = 0; i < shot.actors.size(); ++i) add_actor(usd, shot, i);
  usd.close();
  return usd.text();
}

}  // namespace unseen::report
