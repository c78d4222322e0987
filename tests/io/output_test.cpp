// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/output_folder.h"

#include "io/samples.h"

namespace unseen::io {
namespace {

namespace fs = std::filesystem;

void run(const fs::path& path, const std::vector<std::string>& names, const std::string& content) {
  OutputFolder out(path);
  for (const std::string& name : names) {
    fs::create_directories(out.file(name).parent_path());
    write_file(out.file(name), content);
  }
  out.commit();
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(OutputFolder, AppearsAsAWholeOrNotAtAll) {
  const ScratchFolder folder;
  {
    OutputFolder out(folder / "deep/out/");
    write_file(out.file("a"), "1");
    EXPECT_FALSE(fs::exists(folder / "deep/out"));
  }
  EXPECT_TRUE(fs::is_empty(folder / "deep"));
  run(folder / "deep/out", {"a", "sub/b"}, "1");
  EXPECT_EQ(read_file(folder / "deep/out/sub/b"), "1");
  EXPECT_EQ(entries(folder / "deep"), 1u);
}

TEST(OutputFolder, ANewResultReplacesTheOldOneAsAWhole) {
  const ScratchFolder folder;
  run(folder / "out", {"a", "old", "sub/old"}, "1");
  run(folder / "out", {"a", "new"}, "2");
  EXPECT_EQ(read_file(folder / "out/a"), "2");
  EXPECT_FALSE(fs::exists(folder / "out/old") || fs::exists(folder / "out/sub"));
  EXPECT_EQ(entries(folder.path), 1u);
}

TEST(OutputFolder, ForeignFilesStay) {
  const ScratchFolder folder;
  run(folder / "out", {"a", "result.json", "old", "sub/old"}, "1");
  write_file(folder / "out/mine.txt", "mine");
  run(folder / "out", {"a", "result.json"}, "2");
  EXPECT_EQ(read_file(folder / "out/mine.txt"), "mine");
  EXPECT_EQ(read_file(folder / "out/a"), "2");
  EXPECT_EQ(read_file(folder / "out/result.json"), "2");
  EXPECT_FALSE(fs::exists(folder / "out/old") || fs::exists(folder / "out/sub"));
  EXPECT_EQ(entries(folder / "out"), 4u);  // with the list
}

TEST(OutputFolder, AForeignFileOfOurNameIsKept) {
  const ScratchFolder folder;
  fs::create_directory(folder / "out");
  write_file(folder / "out/points.ply", "the scan");
  OutputFolder out(folder / "out");
  write_file(out.file("points.ply"), "ours");
  EXPECT_EQ(out.commit().size(), 1u);
  EXPECT_EQ(read_file(folder / "out/points.ply"), "ours");
  EXPECT_EQ(read_file(folder / "out/points.ply~"), "the scan");
  run(folder / "out", {"points.ply"}, "again");
  EXPECT_EQ(read_file(folder / "out/points.ply"), "again");
  EXPECT_EQ(read_file(folder / "out/points.ply~"), "the scan");
}

TEST(OutputFolder, UnwritablePlacesAreKnownAtOnce) {
  const ScratchFolder folder;
  write_file(folder / "file", "");
  expect_error([&] { OutputFolder out(folder / "file"); }, {"file", "output"});
  expect_error([&] { OutputFolder out(folder / "file/out"); }, {"out", "output"});
  expect_error([&] { OutputFolder out("/proc/unseen"); }, {"/proc/unseen", "output"});
  fs::create_symlink(folder / "gone", folder / "link");
  expect_error([&] { OutputFolder out(folder / "link"); }, {"link", "output", "a link to what does not exist"});
}

TEST(AtomicFile, ReplacesOrLeavesAlone) {
  const ScratchFolder folder;
  write_file_atomically(folder / "a", "1");
  {
    AtomicFile file(folder / "a");
    write_file(file.path(), "2");
  }
  EXPECT_EQ(read_file(folder / "a"), "1");
  write_file_atomically(folder / "a", "3");
  EXPECT_EQ(read_file(folder / "a"), "3");
  EXPECT_EQ(entries(folder.path), 1u);
  expect_error([&] { write_file_atomically(folder.path, ""); }, {folder.path.string(), "output"});
}

}  // namespace
}  // namespace unseen::io
