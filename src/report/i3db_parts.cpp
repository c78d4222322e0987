// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/i3db_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/linear.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::report {
namespace {

namespace fs = std::filesystem;
using namespace interactions;

constexpr std::size_t kLargestBox = 1 << 16, kMostBoxes = 10'000;  // bytes, files
constexpr double kFarthest = 1e6;                                  // m or px

/// [x, y, z] or [[x], [y], [z]].
Vec3 column(const JsonField& json) {
  const auto rows = json.list(3);
  if (rows.size() != 3) json.fail("three numbers");
  Vec3 v;
  for (int i = 0; i < 3; ++i) {
    JsonField row = rows[static_cast<std::size_t>(i)];
    if (const auto inner = row.is_array() ? row.list(1) : std::vector<JsonField>{}; inner.size() == 1) row = inner.front();
    v[i] = row.number(-kFarthest, kFarthest);
  }
  return v;
}

/// Columns of the file are the box's axes; files hold them in single precision, so they are made orthonormal.
Mat3 read_axes(const JsonField& json) {
  const auto rows = json.list(3);
  if (rows.size() != 3) json.fail("three rows");
  Mat3 axes;
  for (int r = 0; r < 3; ++r) axes.row(r) = rows[static_cast<std::size_t>(r)].vector();
  if (!((axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-3)) json.fail("columns of length 1 at right angles");
  axes = nearest_orthonormal(axes);
  if (axes.determinant() < 0.0) axes.col(0) = -axes.col(0);
  return axes;
}

OrientedBox read_box(const fs::path& path) {
  const nlohmann::json parsed = io::parse_json(io::read_text_file(path, kLargestBox), path.string(), "a box");
  const JsonField json(parsed, path.string());
  OrientedBox box;
  box.center = column(json["centroid"]);
  box.axes = read_axes(json["axes"]);
  box.half_size = 0.5 * column(json["scales"]);
  if (!(box.half_size.minCoeff() > 0.0)) json["scales"].fail("three extents above 0");
  return box;
}

/// A frame's joints by their numbers, each handed to `take`.
template <class Take>
void for_each_joint(const JsonField& json, Take take) {
  for (const auto& [key, field] : json.members()) {
    std::size_t joint = 0;
    if (!io::to_count(key, joint) || joint >= kJoints) field.fail(fmt::format("joints 0 to {}", kJoints - 1));
    take(static_cast<Eigen::Index>(joint), field);
  }
}

}  // namespace

nlohmann::json parse_joint_file(const fs::path& path, const std::string& expected) {
  return io::parse_json(io::read_text_file(path, kLargestJoints), path.string(), expected);
}

std::vector<fs::path> paths_named(const fs::path& folder, const std::string& begin, const std::string& end) {
  std::error_code error;
  fs::directory_iterator at(folder, error);
  if (error) throw InputError(folder.string(), "", error.message(), "a folder");
  std::vector<fs::path> paths;
  for (; !error && at != fs::directory_iterator(); at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.size() >= begin.size() + end.size() && name.starts_with(begin) && name.ends_with(end)) paths.push_back(at->path());
  }
  if (error) throw InputError(folder.string(), "", error.message(), "a folder that can be read");
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::map<int, Pose> read_i3db_poses(const JsonField& json) {
  std::map<int, Pose> poses;
  for (const auto& [key, field] : json.members()) {
    std::size_t frame = 0;
    if (!io::to_count(key, frame) || frame >= kMostFrames) field.fail(fmt::format("the number of a frame below {}", kMostFrames));
    Pose pose = Pose::Constant(std::numeric_limits<double>::quiet_NaN());
    for_each_joint(field, [&](Eigen::Index joint, const JsonField& at) { pose.col(joint) = column(at); });
    if (!pose.allFinite()) field.fail(fmt::format("{} joints", kJoints));
    if (!poses.emplace(static_cast<int>(frame), pose).second) field.fail("a frame of its own");
  }
  return poses;
}

std::map<int, PerJoint> read_i3db_values(const JsonField& json) {
  std::map<int, PerJoint> all;
  const auto frames = json["frame_ids"].list(kMostFrames), values = json["values"].list(kMostFrames);
  if (frames.size() != values.size()) json["values"].fail(fmt::format("{}, one a frame", frames.size()));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    PerJoint joints = PerJoint::Constant(std::numeric_limits<double>::quiet_NaN());
    for_each_joint(values[i], [&](Eigen::Index joint, const JsonField& at) { joints[joint] = at.number(); });
    if (!all.emplace(frames[i].index(kMostFrames), joints).second) frames[i].fail("a frame of its own");
  }
  return all;
}

std::vector<Object> read_i3db_objects(const fs::path& folder) {
  std::map<std::pair<int, std::string>, Object> objects;
  const auto files = paths_named(folder, "", ".json");
  if (files.size() > kMostBoxes) throw InputError(folder.string(), "", fmt::format("{} boxes", files.size()), fmt::format("at most {}", kMostBoxes));
  for (const fs::path& file : files) {
    const std::string name = file.stem().string();
    const std::size_t first = name.find('_'), second = first == std::string::npos ? first : name.find('_', first + 1);
    std::size_t id = 0;
    if (second == std::string::npos || !io::to_count(std::string_view(name).substr(0, first), id) || id >= kMostFrames)
      throw InputError(file.string(), "", name, "NN_label_part.json, NN the number of the object");
    const std::string category = name.substr(first + 1, second - first - 1);
    Object& object = objects[{static_cast<int>(id), category}];
    object.id = static_cast<int>(id);
    object.category = category;
    object.parts.push_back({name.substr(second + 1), read_box(file)});
  }
  std::vector<Object> list;
  for (auto& [key, object] : objects) list.push_back(std::move(object));
  return list;
}

OrientedBox upright(const RigidTransform& T, const OrientedBox& box) {
  OrientedBox b = {T * box.center, T.rotation * box.axes, box.half_size};
  Eigen::Index up = 0;
  b.axes.row(2).cwiseAbs().maxCoeff(&up);
  const Mat3 axes = b.axes;
  const Vec3 half = b.half_size;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Index from = (up + 1 + i) % 3;  // a rotation of the columns keeps them right-handed
    b.axes.col(i) = axes.col(from);
    b.half_size[i] = half[from];
  }
  if (b.axes(2, 2) < 0.0) b.axes.rightCols<2>() *= -1.0;
  return b;
}

}  // namespace unseen::report
