// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/core/summary.h"
#include "unseen/interactions/skeleton.h"

namespace unseen::interactions {

enum class Superclass { sit, table, shelf, other };
inline constexpr const char* kSuperclasses[] = {"sit", "table", "shelf", "other"};

/// Categories with a place of their own in descriptors; anything else is "other".
inline constexpr std::array<const char*, 8> kCategories = {"chair", "couch", "stool", "bed", "table", "desk", "shelf", "other"};
/// Index into kCategories; 7 for a name that is not among them.
int category_index(const std::string& category);
Superclass superclass_of(const std::string& category);

enum class Action { stand, walk, sit, stand_up, reach, lie };
inline constexpr const char* kActions[] = {"standing", "walking", "sitting", "standing up", "reaching", "lying"};

struct Part {
  std::string name;  ///< seat, back, arm, leg, top, shelf, bottom; with -N where there are more
  OrientedBox box;   ///< axes: columns, the last one up
};

/// Named seat, top or shelf: what people use, and what says where the object is.
bool is_main(const Part& part);

/// A piece of furniture: one box a part. Its main part (seat, top, shelves) says where it is.
struct Object {
  int id = -1;
  std::string category;
  std::vector<Part> parts;

  Superclass superclass() const { return superclass_of(category); }
  /// Mean centre of the parts named seat, top or shelf, of all parts if there is none of them.
  Vec3 center() const;
};
Object operator*(const Placement& placement, const Object& object);

/// A person as a detector sees it in one frame.
struct Detection {
  int frame = 0;
  int person = -1;  ///< who it is, if the file says so; −1 = unknown
  Pixels pixels = Pixels::Zero();
  PerJoint confidence = PerJoint::Zero();  ///< in [0,1]; 0 = not detected, then the pixel says nothing
  std::optional<Pose> local;               ///< 3D, pelvis at the origin, camera axes, m
};

/// A person marked by hand: whoever is at this pixel in this frame has this number.
struct Label {
  int frame = 0, person = 0;
  Vec2 pixel = Vec2::Zero();
};

/// Where things of a category are seen in the picture.
struct Mask {
  std::string category;
  int width = 0, height = 0;
  std::vector<std::uint8_t> inside;  ///< row by row, not 0 = inside
};

/// A TAKE.json: what a static camera's pose detector saw.
struct Take {
  std::string name;  ///< the file, for messages
  Camera camera;
  bool camera_assumed = false;  ///< the intrinsics are a guess
  double fps = 30;
  int people = 1;
  std::vector<Detection> detections;    ///< by frame
  std::optional<Vec3> up;               ///< unit, camera coordinates
  std::optional<double> camera_height;  ///< m above the floor
  std::vector<Label> labels;
  std::vector<Mask> masks;
  std::vector<std::string> remarks;  ///< what was odd about the input, for the summary's warnings
};

/// One person's poses, and what is around. World: z up, floor at z = 0.
struct RecordedFrame {
  int frame = 0;
  Pose pose = Pose::Zero();
  std::array<bool, kJoints> occluded = {};
  Action action = Action::stand;
  bool has_action = false;
};
struct Recording {
  std::string name, room, licence;  ///< recordings of one room are not independent
  double fps = 10;
  RigidTransform T_world_camera;
  std::vector<std::vector<RecordedFrame>> people;  ///< each by frame; only frames whose pose is valid
  std::vector<Object> objects;
  std::vector<int> interacted;  ///< ids of the objects that somebody uses
  bool uses_known = false;      ///< an empty list of these means that nobody uses any; else that it is not known
};

struct FoundObject {
  Object object;
  double confidence = 0;     ///< in [0,1], calibrated: the share of such objects that exist
  std::vector<int> windows;  ///< indices into Reconstruction::windows that prove it
};

enum class PoseSource { scenelet, pose };
inline constexpr const char* kPoseSources[] = {"scenelet", "pose"};

struct PersonFrame {
  int frame = 0;
  Pose pose = Pose::Zero();  ///< world
  PoseSource source = PoseSource::pose;
  Action action = Action::stand;
  PerJoint confidence = PerJoint::Zero();
};

struct Person {
  int id = 0;
  std::vector<PersonFrame> frames;
  std::vector<double> likelihood;  ///< of an interaction, in [0,1], one a frame
};

/// Frames that one scenelet explains.
struct Window {
  int person = 0;
  int first = 0, last = 0;  ///< frames
  std::string scenelet;     ///< recording and frame it came from
  double likelihood = 0, energy = 0;
  Placement placement;
};

/// How likely a bit of floor is under an object of a superclass that is turned a certain way.
struct EvidenceMap {
  static constexpr int kTurns = 16;  ///< headings of 2π/16
  Vec2 origin = Vec2::Zero();        ///< world, of the first cell's corner, m
  double cell = 0.1;                 ///< m
  int columns = 0, rows = 0;         ///< along x and y
  std::vector<float> probability;    ///< [superclass][turn][row][column]; 3 superclasses
};

struct Ground {
  double camera_height = 0;  ///< m
  double pitch = 0, roll = 0;  ///< rad, of the camera; pitch > 0 looks down
  std::string source;        ///< "feet", "given" or "assumed"
};

/// What people did and with what. World: z up, floor z = 0, the camera above the origin looking along +y.
struct Reconstruction {
  RigidTransform T_world_camera;
  Camera camera;
  double fps = 0;
  Ground ground;
  std::vector<FoundObject> objects;
  std::vector<Person> people;
  std::vector<Window> windows;
  EvidenceMap evidence;
  Summary summary;
};

}  // namespace unseen::interactions
