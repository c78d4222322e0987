// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/scenelets_file.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <tuple>

#include "interactions/scenelets_sample.h"
#include "unseen/core/error.h"

namespace unseen::report {
namespace {

using namespace interactions;

Database sample() {
  Recording second = simple_recording(3, 2, 10, "another");
  second.licence = "CC-BY-4.0";
  Context context;
  return build_database({simple_recording(4, 6), second}, {}, context);
}

void expect_same(const Database& a, const Database& b, double tolerance) {
  ASSERT_EQ(a.scenelets.size(), b.scenelets.size());
  ASSERT_EQ(a.recordings.size(), b.recordings.size());
  for (std::size_t i = 0; i < a.recordings.size(); ++i) {
    EXPECT_EQ(a.recordings[i].name, b.recordings[i].name);
    EXPECT_EQ(a.recordings[i].room, b.recordings[i].room);
    EXPECT_EQ(a.recordings[i].licence, b.recordings[i].licence);
  }
  for (std::size_t i = 0; i < a.scenelets.size(); ++i) {
    const Scenelet &s = a.scenelets[i], &t = b.scenelets[i];
    EXPECT_EQ(std::tie(s.recording, s.person, s.center, s.fps, s.middle), std::tie(t.recording, t.person, t.center, t.fps, t.middle));
    EXPECT_EQ(s.valid, t.valid);
    EXPECT_EQ(s.actions, t.actions);
    EXPECT_LE((s.origin.position - t.origin.position).norm(), tolerance);
    ASSERT_EQ(s.poses.size(), t.poses.size());
    for (std::size_t k = 0; k < s.poses.size(); ++k) EXPECT_LE((s.poses[k] - t.poses[k]).cwiseAbs().maxCoeff(), 5 * tolerance);
    ASSERT_EQ(s.objects.size(), t.objects.size());
    for (std::size_t k = 0; k < s.objects.size(); ++k) {
      EXPECT_EQ(s.objects[k].id, t.objects[k].id);
      EXPECT_EQ(s.objects[k].category, t.objects[k].category);
      ASSERT_EQ(s.objects[k].parts.size(), t.objects[k].parts.size());
      EXPECT_EQ(s.objects[k].parts[0].name, t.objects[k].parts[0].name);
      EXPECT_LE((s.objects[k].center() - t.objects[k].center()).norm(), 10 * tolerance);
      EXPECT_LE((s.objects[k].parts[0].box.axes - t.objects[k].parts[0].box.axes).norm(), 5 * tolerance);
      EXPECT_LE((s.objects[k].parts[0].box.half_size - t.objects[k].parts[0].box.half_size).norm(), tolerance);
    }
    EXPECT_LE((motion_descriptor(s.poses) - motion_descriptor(t.poses)).cwiseAbs().maxCoeff(), static_cast<float>(20 * tolerance));
    EXPECT_NEAR(s.highest_saliency, t.highest_saliency, 1e-6);
    for (std::size_t k = 0; k < s.layout.size(); ++k) {
      EXPECT_NEAR(s.layout[k], t.layout[k], 1e-5);
      EXPECT_NEAR(s.saliency[k], t.saliency[k], tolerance > 0 ? 0.003 : 0.0);
    }
  }
}

TEST(SceneletsFile, IsTheSameAfterWritingAndReading) {
  const Database database = sample();
  ASSERT_GT(database.scenelets.size(), 50u);
  const std::string bytes = database_bytes(database);
  const Database read = parse_database(bytes, "memory");
  expect_same(database, read, 1e-3);
  EXPECT_TRUE(database_bytes(read) == bytes);
}

TEST(SceneletsFile, OfNothingIsNothing) {
  EXPECT_TRUE(parse_database(database_bytes({}), "memory").scenelets.empty());
}

TEST(SceneletsFile, SharesPosesOfScenelets) {
  const std::string bytes = database_bytes(sample());
  std::size_t poses = 0;
  for (const Scenelet& s : sample().scenelets) poses += s.poses.size();
  EXPECT_LT(bytes.size(), poses * kJoints * 3 * sizeof(float) / 4);
}

std::string message_of(const std::string& bytes) {
  try {
    parse_database(bytes, "people.bin");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(SceneletsFile, SaysWhatIsWrong) {
  const std::string bytes = database_bytes(sample());
  const auto says = [](const std::string& text, const std::string& word) {
    EXPECT_NE(text.find("people.bin"), std::string::npos) << text;
    EXPECT_NE(text.find(word), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  };
  says(message_of(""), "another kind");
  says(message_of("PK" + bytes), "another kind");
  says(message_of(bytes.substr(0, 20)), "20 bytes");
  says(message_of(bytes.substr(0, bytes.size() - 1)), "checksum");
  std::string other = bytes;
  other[8] = 9;
  says(message_of(other), "version");
  other = bytes;
  other[bytes.size() / 2] ^= 1;
  says(message_of(other), "checksum");
  EXPECT_THROW(read_database("/nowhere/people.bin"), InputError);
}

TEST(SceneletsFile, AnyByteChangedIsNoticed) {
  const std::string bytes = database_bytes(sample());
  Random random(21);
  for (int i = 0; i < 500; ++i) {
    std::string broken = bytes;
    broken[random.index(bytes.size())] ^= static_cast<char>(1 + random.index(255));
    EXPECT_THROW(parse_database(broken, "memory"), InputError);
    EXPECT_THROW(parse_database(bytes.substr(0, random.index(bytes.size())), "memory"), InputError);
  }
}

/// The file taken apart, so that a test can damage what the checksum would guard.
struct Parts {
  std::string header, body;

  explicit Parts(const std::string& bytes) {
    std::uint32_t sizes[2];
    std::memcpy(sizes, bytes.data() + 12, sizeof(sizes));
    header = bytes.substr(24, sizes[0]);
    body.resize(sizes[1]);
    uLongf size = sizes[1];
    uncompress(reinterpret_cast<Bytef*>(body.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()) + 24 + sizes[0], bytes.size() - 24 - sizes[0]);
  }
  std::string bytes() const {
    uLongf size = compressBound(body.size());
    std::string rest(size, '\0');
    compress2(reinterpret_cast<Bytef*>(rest.data()), &size, reinterpret_cast<const Bytef*>(body.data()), body.size(), 1);
    rest = header + rest.substr(0, size);
    const std::uint32_t numbers[] = {1, static_cast<std::uint32_t>(header.size()), static_cast<std::uint32_t>(body.size()),
                                     static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(rest.data()), static_cast<uInt>(rest.size())))};
    return "unseenSC" + std::string(reinterpret_cast<const char*>(numbers), sizeof(numbers)) + rest;
  }
};

TEST(SceneletsFile, DamageBehindARightChecksumGivesSceneletsOrAnInputError) {
  const Parts whole(database_bytes(sample()));
  ASSERT_EQ(parse_database(whole.bytes(), "memory").scenelets.size(), sample().scenelets.size());
  Random random(22);
  int read_well = 0, refused = 0;
  for (int i = 0; i < 1500; ++i) {
    Parts broken = whole;
    std::string& text = i % 5 == 0 ? broken.header : broken.body;
    for (std::size_t edits = 1 + random.index(3); edits > 0; --edits) {
      const std::size_t at = random.index(i % 3 ? std::min<std::size_t>(text.size(), 4000) : text.size());
      switch (random.index(4)) {
        case 0: text[at] = static_cast<char>(random.index(256)); break;
        case 1: text.replace(at, std::min<std::size_t>(4, text.size() - at), "\xff\xff\xff\x7f"); break;
        case 2: text.resize(at); break;
        default: text.erase(at, random.index(20));
      }
      if (text.empty()) break;
    }
    try {
      parse_database(broken.bytes(), "memory");
      ++read_well;
    } catch (const InputError&) {
      ++refused;
    }
  }
  EXPECT_GT(read_well, 20);
  EXPECT_GT(refused, 500);
}

TEST(SceneletsFile, AClaimOfTooMuchIsRefusedBeforeItIsBelieved) {
  Parts parts(database_bytes(sample()));
  parts.body.replace(0, 4, "\xff\xff\xff\xff", 4);  // tracks
  EXPECT_NE(message_of(parts.bytes()).find("tracks"), std::string::npos);
  std::string bytes = database_bytes(sample());
  bytes.replace(16, 4, "\xff\xff\xff\xff", 4);  // size of the body
  EXPECT_NE(message_of(bytes).find("unpacked"), std::string::npos);
}

}  // namespace
}  // namespace unseen::report
