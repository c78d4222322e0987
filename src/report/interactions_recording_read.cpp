// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "io/text.h"
#include "report/i3db_parts.h"
#include "unseen/core/error.h"
#include "unseen/core/level.h"
#include "unseen/core/quantile.h"
#include "unseen/report/interactions_recording.h"

namespace unseen::report {
namespace {

namespace fs = std::filesystem;
using namespace interactions;

constexpr std::size_t kLargestText = std::size_t{8} << 20;
constexpr double kAnkleHeight = 0.1;  // m, of the ankle's joint above the floor
constexpr double kDefaultFps = 10.0;  // of i3DB

Action read_action(std::string_view text, const std::string& source, const std::string& field) {
  for (std::size_t a = 0; a < std::size(kActions); ++a)
    if (text == kActions[a]) return static_cast<Action>(a);
  if (text == "standing(from sitting)") return Action::stand_up;  // as i3DB calls it
  std::string all = "standing(from sitting)";
  for (const char* name : kActions) all += std::string(", ") + name;
  throw InputError(source, field, io::shown(text), "one of " + all);
}

/// Enters the actions of a file into the frames; frames that it does not name have none.
void read_actions(const fs::path& path, std::vector<RecordedFrame>& frames) {
  std::error_code error;
  if (!fs::exists(path, error)) return;
  const std::string text = io::read_text_file(path, kLargestText);
  std::map<int, Action> actions;
  io::Lines lines(text);
  for (std::string_view line; lines.next_filled(line);) {
    const std::string field = fmt::format("line {}", lines.number());
    line = io::trim(line);
    const std::string_view number = line.substr(0, line.find_first_of(" \t"));
    std::size_t frame = 0;
    if (!io::to_count(number, frame) || frame >= kMostFrames) throw InputError(path.string(), field, io::shown(line), "a frame and an action");
    actions[static_cast<int>(frame)] = read_action(io::trim(line.substr(number.size())), path.string(), field);
  }
  for (RecordedFrame& f : frames)
    if (const auto at = actions.find(f.frame); at != actions.end()) f.action = at->second, f.has_action = true;
}

std::map<int, std::array<bool, kJoints>> read_occluded(const JsonField& json) {
  std::map<int, std::array<bool, kJoints>> all;
  for (const auto& [key, field] : json.members()) {
    std::size_t frame = 0;
    if (!io::to_count(key, frame) || frame >= kMostFrames) field.fail("the number of a frame");
    const auto flags = field.list(kJoints);
    if (flags.size() != kJoints) field.fail(fmt::format("{} flags", kJoints));
    std::array<bool, kJoints>& joints = all[static_cast<int>(frame)];
    for (std::size_t j = 0; j < kJoints; ++j) joints[j] = flags[j].index(2) == 1;
  }
  return all;
}

/// A person's true poses in camera coordinates.
std::vector<RecordedFrame> read_person(const fs::path& path) {
  const nlohmann::json parsed = parse_joint_file(path, "the truth of a scene");
  const JsonField json(parsed, path.string());
  const auto poses = read_i3db_poses(json["3d"]);
  const auto confidence = json.has("confidence") ? read_i3db_values(json["confidence"]) : std::map<int, PerJoint>{};
  const auto occluded = json.has("occluded") ? read_occluded(json["occluded"]) : std::map<int, std::array<bool, kJoints>>{};
  std::vector<RecordedFrame> frames;
  for (const auto& [frame, pose] : poses) {
    if (const auto c = confidence.find(frame); c != confidence.end() && !(c->second > 0.0).any()) continue;
    RecordedFrame f;
    f.frame = frame;
    f.pose = pose;
    if (const auto o = occluded.find(frame); o != occluded.end()) f.occluded = o->second;
    frames.push_back(f);
  }
  if (frames.empty()) throw InputError(path.string(), "3d", "no frame whose pose is valid", "at least one");
  return frames;
}

/// Up in camera coordinates: each box's axis nearest to the image's up; the mean of those that agree with their median, because some
/// parts are mounted at a slant.
Vec3 up_of(const std::vector<Object>& objects) {
  std::vector<Vec3> axes;
  for (const Object& object : objects)
    for (const Part& part : object.parts) {
      Eigen::Index up = 0;
      const double y = part.box.axes.row(1).cwiseAbs().maxCoeff(&up) * (part.box.axes(1, up) > 0.0 ? 1.0 : -1.0);
      axes.push_back(part.box.axes.col(up) * (y > 0.0 ? -1.0 : 1.0));
    }
  if (axes.empty()) return -Vec3::UnitY();
  Vec3 middle, sum = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    std::vector<double> values;
    for (const Vec3& a : axes) values.push_back(a[i]);
    middle[i] = median(std::move(values));
  }
  for (const Vec3& a : axes)
    if (line_angle(a, middle) < radians(2.0)) sum += a;
  return sum.norm() > 0.0 ? Vec3(sum.normalized()) : Vec3(middle.normalized());
}

/// The floor's height in a world that is level but not yet at its origin. What stands on it says it to a centimetre; ankles only to
/// a decimetre (in i3DB the two differ by 8 to 18 cm), so these only tell which boxes stand and which hang.
double floor_of(const Recording& r) {
  std::vector<double> ankles, bottoms;
  for (const auto& person : r.people)
    for (const RecordedFrame& f : person) ankles.push_back(std::min(f.pose(2, right_ankle), f.pose(2, left_ankle)));
  const double below_feet = quantile(std::move(ankles), 0.05) - kAnkleHeight;
  constexpr double kStands = 0.25;  // m
  for (const Object& object : r.objects) {
    double bottom = below_feet + kStands;
    for (const Part& part : object.parts)
      bottom = std::min(bottom, part.box.center.z() - part.box.axes.row(2).cwiseAbs() * part.box.half_size);
    if (std::abs(bottom - below_feet) < kStands) bottoms.push_back(bottom);
  }
  return bottoms.empty() ? below_feet : median(std::move(bottoms));
}

/// Turns everything upright, then lowers it to the floor.
void bring_to_world(Recording& r) {
  r.T_world_camera.rotation = level_rotation(up_of(r.objects));
  for (Object& object : r.objects)
    for (Part& part : object.parts) part.box = upright(r.T_world_camera, part.box);
  for (auto& person : r.people)
    for (RecordedFrame& f : person) f.pose = r.T_world_camera.rotation * f.pose;
  const Vec3 rise(0.0, 0.0, -floor_of(r));
  r.T_world_camera.translation = rise;
  for (Object& object : r.objects)
    for (Part& part : object.parts) part.box.center += rise;
  for (auto& person : r.people)
    for (RecordedFrame& f : person) f.pose.colwise() += rise;
}

std::string first_line(const fs::path& path, const std::string& otherwise) {
  std::error_code error;
  if (!fs::exists(path, error)) return otherwise;
  const std::string text = io::read_text_file(path, kLargestText);
  std::string_view line;
  io::Lines lines(text);
  return lines.next_filled(line) ? std::string(io::trim(line)) : otherwise;
}

double read_fps(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return kDefaultFps;
  const nlohmann::json parsed = io::parse_json(io::read_text_file(path, kLargestText), path.string(), "a take");
  const JsonField json(parsed, path.string());
  return json.has("fps") ? json["fps"].number(0.1, 1e4) : kDefaultFps;
}

std::vector<Object> read_objects(const fs::path& truth) {
  const auto folders = paths_named(truth, "", "_objects");
  if (folders.size() > 1) throw InputError(folders[1].string(), "", "a second folder of objects", "one");
  if (folders.empty()) return {};
  std::vector<Object> objects = read_i3db_objects(folders[0]);
  for (std::size_t i = 1; i < objects.size(); ++i)
    if (objects[i].id == objects[i - 1].id)
      throw InputError(folders[0].string(), fmt::format("{:02}", objects[i].id), objects[i - 1].category + " and " + objects[i].category, "one label an object");
  return objects;
}

/// None without such a file.
std::optional<std::vector<int>> read_interacted(const fs::path& path, const std::vector<Object>& objects) {
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  const nlohmann::json parsed = io::parse_json(io::read_text_file(path, kLargestText), path.string(), "a list of ids");
  std::set<int> known, ids;
  for (const Object& object : objects) known.insert(object.id);
  for (const JsonField& field : JsonField(parsed, path.string()).list()) {
    const int id = field.index(kMostFrames);
    if (known.count(id) == 0) field.fail("the id of an object");
    ids.insert(id);
  }
  return std::vector<int>(ids.begin(), ids.end());
}

}  // namespace

Recording read_recording(const fs::path& folder) {
  const fs::path truth = folder / "gt";
  std::error_code error;
  if (!fs::is_directory(truth, error)) throw InputError(folder.string(), "gt", "nothing", "a scene folder with the truth in its gt/");
  Recording r;
  r.name = fs::weakly_canonical(folder, error).filename().string();
  r.room = first_line(truth / "room.txt", r.name);
  r.licence = first_line(truth / "licence.txt", "");
  r.fps = read_fps(folder / "take.json");
  const auto people = paths_named(truth, "skel_", "_GT.json");
  if (people.empty()) throw InputError(truth.string(), "", "no skel_NAME_GT.json", "one a person");
  for (std::size_t p = 0; p < people.size(); ++p) {
    r.people.push_back(read_person(people[p]));
    read_actions(truth / (p == 0 ? "actions.txt" : fmt::format("actions-{}.txt", p)), r.people.back());
  }
  r.objects = read_objects(truth);
  const std::optional<std::vector<int>> used = read_interacted(truth / "interacted.json", r.objects);
  r.uses_known = used.has_value();
  r.interacted = used.value_or(std::vector<int>{});
  bring_to_world(r);
  return r;
}

}  // namespace unseen::report
