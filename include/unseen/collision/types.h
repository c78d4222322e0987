// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/core/mesh.h"
#include "unseen/core/summary.h"

namespace unseen::collision {

using Quat = Eigen::Quaterniond;

/// How a body is known: by a closed mesh, a box, a sphere, one length, or as something that never moves.
enum class Shape { mesh, box, sphere, size, fixed };

struct Body {
  std::string name;
  Shape shape = Shape::sphere;
  TriangleMesh mesh;          ///< closed, in the file's own axes, m
  Vec3 box = Vec3::Zero();    ///< edge lengths, m
  double radius = 0;          ///< of the sphere, m
  double size = 0;            ///< Shape::size: the largest extent, m
  std::optional<Vec3> normal;  ///< of something fixed: unit, camera coordinates, towards the free body
  std::optional<double> mass;  ///< kg; serves drag, and the mass ratio if asked to
};

/// The camera of a shot. The image size is known once the video is open.
struct ShotCamera {
  Camera camera;                 ///< width and height 0 = from the video; fx 0 = from `hfov`
  std::optional<double> hfov;    ///< horizontal field of view, rad; then the principal point is in the middle
  std::array<double, 5> distortion = {};  ///< k1, k2, p1, p2, k3 as OpenCV has them
  bool assumed = false;          ///< the intrinsics are a guess
  std::optional<double> readout;  ///< s that a rolling shutter takes from the first row to the last, below 0 upward; 0 = a global one
};

/// A body's centre as seen in one frame.
struct Sighting {
  int frame = 0;    ///< decoded frames, from 0
  Vec2 pixel = Vec2::Zero();
  double radius = 0;  ///< of the projected body, px; 0 = unknown
  int body = -1;      ///< index into Shot::bodies; −1 = not labelled
};

/// An orientation that a person gave: body (file's axes) to camera, 5° of noise.
struct OrientationHint {
  int body = 0;
  double time = 0;  ///< s
  Quat q = Quat::Identity();
};

/// A SHOT.json: what is filmed, with which camera, and what is known beside.
struct Shot {
  std::string name;   ///< the file, for messages
  std::string video;  ///< its path; empty if `observations` replace it
  std::optional<double> fps;  ///< overrides the file's
  ShotCamera camera;
  double gravity = 9.81;     ///< m/s²; 0 = planar and gravity-free
  std::optional<Vec3> down;  ///< unit, camera coordinates
  std::vector<Body> bodies;  ///< two; at most one of them fixed
  std::optional<std::array<int, 4>> roi;     ///< x, y, width, height, px
  std::optional<std::array<int, 2>> frames;  ///< first and last
  std::vector<Sighting> observations;
  std::vector<OrientationHint> orientations;
  std::optional<double> metres_per_pixel;  ///< gravity-free shots
  std::optional<Plane> floor;              ///< camera coordinates, the normal towards the free body
};

/// A value with its standard deviation, and the interval that covers 95 %.
struct Estimate {
  double value = 0;
  double sd = 0;
  double low = 0, high = 0;
};

/// A body's state at one instant. World coordinates; `q` maps the mesh file's (or box's) axes to the world.
struct BodyState {
  Vec3 p = Vec3::Zero();  ///< centre of mass, m
  Vec3 v = Vec3::Zero();  ///< m/s
  Vec3 k = Vec3::Zero();  ///< angular momentum about the centre, kg m²/s with the mass of the first body as 1
  Quat q = Quat::Identity();
};

/// One collision found in the shot.
struct Impact {
  double time = 0;   ///< s
  double frame = 0;  ///< the same in frames
  Estimate restitution;
  std::optional<double> tangential_restitution;
  std::optional<double> friction;  ///< |J_t| / J_n; the coefficient itself if it slid, a lower bound if it stuck
  Vec3 impulse = Vec3::Zero();     ///< on the first body, m/s with its mass as 1
  Vec3 contact_point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();     ///< unit, from the second body (or what is fixed) to the first
  std::array<int, 2> between = {0, 1};
};

struct BodyResult {
  std::string name;
  bool fixed = false;
  Vec3 inertia = Vec3::Zero();  ///< principal, of unit mass, m²
  BodyState before, after;      ///< at the first impact that counts
};

/// Where the bodies are in one frame; nothing for what is fixed or not yet (no longer) in flight.
struct FramePose {
  int frame = 0;
  double time = 0;
  std::array<std::optional<BodyState>, 2> bodies;
};

/// What one kind of evidence says of the solution.
struct Term {
  std::string name;
  double residual = 0;  ///< root mean square, in units of its noise
  double weight = 1;
};

/// A body's centre in a frame: where it was seen, and where the solution has it. Pixels.
struct Residual {
  int frame = 0;
  int body = 0;
  Vec2 seen = Vec2::Zero(), predicted = Vec2::Zero();
  bool used = true;  ///< false: held out, or an outlier
};

/// What was seen to move in a frame of a video. Pixels of the picture.
struct Sighted {
  int frame = 0;
  std::optional<int> body;  ///< none: it is in no flight
  Vec2 center = Vec2::Zero();
  double diameter = 0;
};

/// A solution that explains the data nearly as well.
struct Alternative {
  std::string what;
  double restitution = 0, mass_ratio = 0, excess = 0;  ///< mass_ratio: means nothing with a fixed partner; excess: by how much χ² is larger
};

/// Both motions and what they tell. World: z up, origin at the camera's centre.
struct Reconstruction {
  RigidTransform T_world_camera;
  Camera camera;
  double fps = 0;
  Vec3 gravity_direction = -Vec3::UnitZ();
  std::vector<Impact> impacts;
  std::optional<Estimate> restitution;  ///< none when no confident value exists
  std::optional<Estimate> mass_ratio;   ///< second to first; none with a fixed partner
  std::string fixed;                    ///< name of the fixed partner, or empty
  bool fits = false;
  std::vector<Alternative> ambiguous;
  std::vector<BodyResult> bodies;
  double energy_before = 0, energy_after = 0;  ///< kinetic, J with the first body's mass as 1 kg
  std::vector<Term> terms;
  std::vector<std::string> observability;
  std::vector<FramePose> frames;
  std::vector<Residual> residuals;
  std::vector<Sighted> sighted;  ///< if nothing was solved, of a video
  double reprojection_rms = 0;  ///< px, of what was used
  double held_out_rms = 0;      ///< px, of what was held out
  std::optional<double> drag;   ///< Cd·A·ρ/(2m), 1/m, if drag took part
  Summary summary;
  std::optional<double> slowing;  ///< m/s², by friction of what the bodies slide on, without gravity
};

}  // namespace unseen::collision
