// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/result_read.h"

#include "unseen/report/stored_run.h"

namespace unseen::report {

std::string read_result_text(const std::filesystem::path& path) {
  constexpr std::size_t kLargest = std::size_t{1} << 30;
  return io::read_text_file(path, kLargest);
}

Summary read_summary(const JsonField& json) {
  Summary summary;
  const std::string status = json["status"].text();
  bool known = false;
  for (const Status s : {Status::solved, Status::time_limit, Status::infeasible, Status::cancelled})
    if (status == to_string(s)) summary.status = s, known = true;
  if (!known) json["status"].fail("solved, time_limit, infeasible or cancelled");
  for (const auto& [name, value] : json["seconds"].members())
    summary.seconds.emplace_back(name, value.number(0));
  for (const auto& [name, value] : json["energy"].members())
    summary.energy.emplace_back(name, value.number());
  for (const auto& [name, value] : json["counts"].members()) summary.counts.emplace_back(name, value.count());
  for (const JsonField& warning : json["warnings"].list()) summary.warnings.push_back(warning.text());
  return summary;
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
