// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/result_read.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

#include "unseen/io/sha256.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {

std::string read_result_text(const std::filesystem::path& path) {
  constexpr std::size_t kLargest = std::size_t{1} << 30;
  return io::read_text_file(path, kLargest);
}

namespace {

/// Names in each object of the summary in the order of the file, which a parsed object does not keep.
std::map<std::string, std::vector<std::string>> names_in_order(const std::string& text) {
  using Event = nlohmann::json::parse_event_t;
  std::map<std::string, std::vector<std::string>> names;
  bool in_summary = false;
  std::string object;
  const nlohmann::json whole = nlohmann::json::parse(text, [&](int depth, Event event, const nlohmann::json& parsed) {
    if (event != Event::key) return true;
    const std::string& key = parsed.get_ref<const std::string&>();
    if (depth == 1) in_summary = key == "summary";
    if (depth == 2) object = key;
    if (depth == 3 && in_summary) names[object].push_back(key);
    return true;
  });
  return names;
}

}  // namespace

Summary read_summary(const JsonField& json, const std::string& text) {
  Summary summary;
  const std::string status = json["status"].text();
  bool known = false;
  for (const Status s : {Status::solved, Status::time_limit, Status::infeasible, Status::cancelled})
    if (status == to_string(s)) summary.status = s, known = true;
  if (!known) json["status"].fail("solved, time_limit, infeasible or cancelled");
  for (const char* object : {"seconds", "energy", "counts"}) (void)json[object].members();  // an object, or an error
  auto names = names_in_order(text);
  for (const std::string& name : names["seconds"]) summary.seconds.emplace_back(name, json["seconds"][name].number(0));
  for (const std::string& name : names["energy"]) summary.energy.emplace_back(name, json["energy"][name].number());
  for (const std::string& name : names["counts"]) summary.counts.emplace_back(name, json["counts"][name].count());
  for (const JsonField& warning : json["warnings"].list()) summary.warnings.push_back(warning.text());
  return summary;
}

RigidTransform read_transform(const JsonField& json) {
  const auto rows = json.list();
  if (rows.size() != 4) json.fail("four rows");
  RigidTransform t;
  for (std::size_t r = 0; r < 4; ++r) {
    const auto row = rows[r].list();
    if (row.size() != 4) rows[r].fail("four numbers");
    for (std::size_t c = 0; c < 4; ++c) {
      const double v = row[c].number();
      const auto i = static_cast<Eigen::Index>(r), j = static_cast<Eigen::Index>(c);
      if (r == 3 && v != (c == 3 ? 1.0 : 0.0)) rows[r].fail("0, 0, 0, 1");
      if (r < 3 && c < 3) t.rotation(i, j) = v;
      if (r < 3 && c == 3) t.translation[i] = v;
    }
  }
  if (!t.is_rigid(1e-6)) json.fail("a rigid motion");
  return t;
}

Mat3 read_axes(const JsonField& json) {
  if (json.size() != 3) json.fail("three axes");
  const auto rows = json.list();
  Mat3 axes;
  for (Eigen::Index a = 0; a < 3; ++a) axes.col(a) = rows[static_cast<std::size_t>(a)].vector();
  if (!RigidTransform{axes, Vec3::Zero()}.is_rigid(1e-6)) json.fail("three right-handed axes of length 1");
  return axes;
}

Camera read_camera(const JsonField& json) {
  constexpr std::size_t kMostPixels = 1'000'000'000;
  return {json["fx"].number(0), json["fy"].number(0), json["cx"].number(), json["cy"].number(), json["width"].index(kMostPixels),
          json["height"].index(kMostPixels)};
}

constexpr std::size_t kMostIds = 1'000'000'000;

int new_id(const JsonField& json, std::set<int>& ids) {
  const int id = json.index(kMostIds);
  if (!ids.insert(id).second) json.fail("an id of its own");
  return id;
}

int known_id(const JsonField& json, const std::set<int>& ids) {
  const int id = json.index(kMostIds);
  if (ids.count(id) == 0) json.fail("the id of a support or cuboid");
  return id;
}

std::filesystem::path find_input(const std::filesystem::path& result, const InputRecord& input, const Context& context) {
  const std::filesystem::path path = input.path, file = std::filesystem::absolute(result).lexically_normal();
  std::vector<std::filesystem::path> candidates = {path}, there;
  for (std::filesystem::path folder = file.parent_path(); folder != folder.root_path(); folder = folder.parent_path()) candidates.push_back(folder / path);
  if (path.has_filename()) candidates.push_back(file.parent_path() / path.filename());
  std::error_code error;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(there), [&](const auto& candidate) { return std::filesystem::exists(candidate, error); });
  if (there.size() > 1 && !input.sha256.empty())
    for (const std::filesystem::path& candidate : there)
      if (io::sha256(candidate, context) == input.sha256) return candidate;
  return there.empty() ? path : there.front();
}

StoredRun read_stored_run(const std::filesystem::path& path) {
  const nlohmann::json parsed = parse_json(read_result_text(path), path.string());
  const JsonField json(parsed, path.string());
  StoredRun run;
  run.capability = json["capability"].text();
  run.input.path = json["input"]["path"].text();
  if (const JsonField sha = json["input"]["sha256"]; !sha.is_null()) run.input.sha256 = sha.text();
  for (const auto& [name, field] : json["options"].members())
    if (auto value = field.option()) run.options.emplace_back(name, std::move(*value));
  return run;
}

}  // namespace unseen::report
