// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace unseen::io {

/// A result folder that appears as a whole. Files are written into a temporary folder beside the final one
/// (in it, if the place beside cannot be used, e.g. where the folder is a mount); commit() puts them into
/// place. An earlier result is exchanged for the new one in one step, so that a run that is killed leaves one
/// or the other. A hidden list, `.unseen-files`, says what in a folder is ours. Whatever is not stays: then
/// our files are put beside it one by one (result.json last), and a foreign file whose name we need is kept
/// as NAME~.
class OutputFolder {
 public:
  /// Throws InputError (path, reason) if the folder cannot be written. Makes missing parents.
  explicit OutputFolder(const std::filesystem::path& path);
  /// Removes what was not committed.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write the file or folder `name` until commit().
  std::filesystem::path file(const std::string& name) const { return temporary_ / name; }
  /// The folder itself, as the user named it.
  const std::filesystem::path& path() const { return path_; }
  /// Puts the result into place. Gives a line for each foreign file that had to be renamed.
  std::vector<std::string> commit();

 private:
  std::vector<std::string> move_in(const std::vector<std::string>& ours);

  std::filesystem::path path_, target_, temporary_;
  bool inside_ = false;
  bool committed_ = false;
};

/// A single file that appears as a whole: write to path(), then commit().
class AtomicFile {
 public:
  /// Throws InputError (path, reason) if the file cannot be written there.
  explicit AtomicFile(const std::filesystem::path& path);
  /// Removes what was not committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& path() const { return temporary_; }
  void commit();

 private:
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

/// Replaces the content of a file, or makes it, in one step. Throws InputError (path, reason).
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace unseen::io
