// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/output_folder.h"

#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <set>

#include "io/file_bytes.h"
#include "io/file_writer.h"
#include "io/output_place.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

namespace fs = std::filesystem;
constexpr const char* kList = ".unseen-files";
using Names = std::set<std::string>;

[[noreturn]] void fail(const fs::path& path, const std::string& found) {
  throw InputError(path.string(), "output", found, "a folder that can be written to");
}

/// The files below a folder, relative to it; symbolic links count as files.
Names files_below(const fs::path& folder) {
  Names names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_symlink() || !entry.is_directory())
      names.insert(entry.path().lexically_relative(folder).string());
  return names;
}

/// What an earlier run wrote into the folder.
Names listed_files(const fs::path& folder) {
  Names names;
  if (!fs::is_regular_file(fs::symlink_status(folder / kList))) return names;
  const auto bytes = FileBytes::open(folder / kList);
  Lines lines(bytes->view());
  std::string_view line;
  while (lines.next(line)) {
    const fs::path name(line);
    const bool below = name.is_relative() && std::find(name.begin(), name.end(), "..") == name.end();
    if (below && !name.empty()) names.insert(name.string());
  }
  return names;
}

void write_list(const fs::path& folder, const Names& names) {
  FileWriter writer(folder / kList);
  for (const std::string& name : names) writer.write(name + "\n");
  writer.close();
}

/// True if an earlier run wrote everything in the folder: no other file, no other folder.
bool all_ours(const fs::path& folder, const Names& listed) {
  Names parents;
  for (const std::string& name : listed)
    for (fs::path p = fs::path(name).parent_path(); !p.empty(); p = p.parent_path())
      parents.insert(p.string());
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    const bool is_folder = entry.is_directory() && !entry.is_symlink();
    if (name != kList && !(is_folder ? parents : listed).count(name)) return false;
  }
  return true;
}

bool same_device(const fs::path& a, const fs::path& b) {
  struct stat first {
  }, second{};
  return ::stat(a.c_str(), &first) == 0 && ::stat(b.c_str(), &second) == 0 && first.st_dev == second.st_dev;
}

}  // namespace

Names result_files(const fs::path& folder) {
  const Names names = listed_files(folder);
  return names.count("result.json") > 0 ? names : Names();
}

OutputFolder::OutputFolder(const fs::path& path) : path_(path) {
  try {
    target_ = resolved(path);
    const fs::path parent = target_.parent_path();
    fs::create_directories(parent);
    const bool exists = fs::exists(target_);
    if (!exists && fs::is_symlink(target_)) fail(path, "a link to what does not exist");
    if (exists && !fs::is_directory(target_)) fail(path, "a file of that name");
    if (exists && ::access(target_.c_str(), W_OK | X_OK) != 0) fail(path, "no permission to write");
    std::error_code error;
    inside_ = exists && !same_device(target_, parent);
    if (!inside_) {
      temporary_ = temporary_beside(target_);
      if (!fs::create_directory(temporary_, error) && exists) inside_ = true;
    }
    if (inside_) {
      temporary_ = temporary_beside(target_ / "result");
      fs::create_directory(temporary_, error);
    }
    if (error) fail(path, error.message());
  } catch (const fs::filesystem_error& fault) {
    fail(path, fault.code().message());
  }
}

OutputFolder::~OutputFolder() {
  std::error_code error;
  if (!committed_) fs::remove_all(temporary_, error);
}

std::vector<std::string> OutputFolder::commit() {
  std::vector<std::string> notes;
  try {
    const Names ours = files_below(temporary_);
    const bool exists = fs::exists(target_);
    const bool here = exists && fs::equivalent(target_, fs::current_path());
    const bool whole = !inside_ && !here && (!exists || all_ours(target_, listed_files(target_)));
    if (whole) write_list(temporary_, ours);
    if (whole && !exists) {
      fs::rename(temporary_, target_);
    } else if (whole) {
      fs::permissions(temporary_, fs::status(target_).permissions());
      const bool exchanged =
          ::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0;
      if (!exchanged) notes = move_in({ours.begin(), ours.end()});
      fs::remove_all(temporary_);  // the earlier result
    } else {
      notes = move_in({ours.begin(), ours.end()});
      fs::remove_all(temporary_);
    }
  } catch (const fs::filesystem_error& fault) {
    fail(path_, fault.code().message());
  }
  committed_ = true;
  return notes;
}

std::vector<std::string> OutputFolder::move_in(const std::vector<std::string>& ours) {
  std::vector<std::string> notes;
  const Names earlier = listed_files(target_), now(ours.begin(), ours.end());
  const auto make_way = [&](const std::string& name) {
    const fs::path place = target_ / name;
    if (earlier.count(name) || !fs::exists(fs::symlink_status(place))) return;
    fs::path kept = place;
    while (fs::exists(fs::symlink_status(kept))) kept += "~";
    fs::rename(place, kept);
    notes.push_back(name + " was there before and is not of this program: kept as " +
                    kept.lexically_relative(target_).string());
  };
  for (const std::string& name : ours) {
    for (fs::path p = fs::path(name).parent_path(); !p.empty(); p = p.parent_path())
      if (!fs::is_directory(target_ / p)) make_way(p.string());
    make_way(name);
  }
  // Until the end both results are ours, so that a run killed in between leaves nothing that nobody owns.
  Names both = earlier;
  both.insert(now.begin(), now.end());
  write_list(target_, both);
  const auto move = [&](const std::string& name) {
    fs::create_directories((target_ / name).parent_path());
    fs::rename(temporary_ / name, target_ / name);
  };
  for (const std::string& name : ours)
    if (name != "result.json") move(name);
  std::error_code error;
  for (const std::string& name : earlier)
    if (!now.count(name)) {
      fs::remove(target_ / name, error);
      for (fs::path p = fs::path(name).parent_path(); !p.empty(); p = p.parent_path()) {
        if (!fs::is_empty(target_ / p, error) || error) break;
        fs::remove(target_ / p, error);
      }
    }
  if (now.count("result.json")) move("result.json");
  write_list(target_, now);
  return notes;
}

}  // namespace unseen::io
