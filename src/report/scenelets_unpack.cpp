// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <limits>

#include "report/scenelets_pack.h"
#include "unseen/core/error.h"

namespace unseen::report {
namespace {

using namespace interactions;

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie in memory");

constexpr std::size_t kMostPoses = 2'000'000, kMostParts = 2'000'000;  ///< of all scenelets together: some 1 GB
constexpr std::int64_t kFarthestJoint = 1'000'000;                          ///< mm
constexpr std::size_t kActions = std::size(interactions::kActions);

/// Reads numbers off bytes and never beyond their end.
class Bytes {
 public:
  Bytes(std::string_view bytes, const std::string& source) : bytes_(bytes), source_(source) {}

  [[noreturn]] void fail(const std::string& field, const std::string& found, const std::string& expected) const { throw InputError(source_, field, found, expected); }

  std::string_view take(std::size_t size) {
    if (size > bytes_.size() - at_) fail("body", "its end", "the rest of a scenelet database");
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  /// How many things follow that take at least `smallest` bytes each.
  std::size_t count(const std::string& field, std::size_t smallest) {
    const auto n = number<std::uint32_t>();
    if (n > (bytes_.size() - at_) / smallest) fail(field, fmt::format("{} of them", n), "no more than the file has room for");
    return n;
  }
  std::size_t index(const std::string& field, std::size_t size) {
    const auto i = number<std::uint32_t>();
    if (i >= size) fail(field, fmt::format("{}", i), fmt::format("below {}", size));
    return i;
  }
  double share(const std::string& field) {
    const auto value = static_cast<double>(number<float>());
    if (!(value >= 0 && value <= 1)) fail(field, fmt::format("{}", value), "0 to 1");
    return value;
  }
  std::string text() { return std::string(take(number<std::uint8_t>())); }
  std::int64_t varint() {
    std::uint64_t bits = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const auto byte = number<std::uint8_t>();
      bits |= static_cast<std::uint64_t>(byte & 127) << shift;
      if (byte < 128) return static_cast<std::int64_t>(bits >> 1) ^ -static_cast<std::int64_t>(bits & 1);
    }
    fail("poses", "a number of more than 64 bits", "millimetres");
  }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::string_view bytes_;
  std::string source_;
  std::size_t at_ = 0;
};

void read_poses(Bytes& bytes, std::vector<PackedPose>& poses) {
  for (std::size_t k = 0; k < PackedPose{}.size(); ++k) {
    std::int64_t before = 0, speed = 0;
    for (PackedPose& pose : poses) {
      const std::int64_t rest = bytes.varint();
      if (rest < -4 * kFarthestJoint || rest > 4 * kFarthestJoint) bytes.fail("poses", fmt::format("a leap of {} mm", rest), "a person's motion");
      const std::int64_t value = before + speed + rest;
      if (value < -kFarthestJoint || value > kFarthestJoint) bytes.fail("poses", fmt::format("{} mm", value), "within 1 km");
      speed = &pose == &poses.front() ? 0 : value - before;
      before = value;
      pose[k] = static_cast<std::int32_t>(value);
    }
  }
}

int recording_index(Bytes& bytes, std::size_t recordings) { return static_cast<int>(bytes.index("recording", recordings)); }

PackedTrack read_track(Bytes& bytes, std::size_t recordings) {
  PackedTrack track;
  track.recording = recording_index(bytes, recordings);
  track.person = bytes.number<std::int32_t>();
  track.first_frame = bytes.number<std::int32_t>();
  track.fps = bytes.number<double>();
  if (!(track.fps > 0 && track.fps <= 1000)) bytes.fail("fps", fmt::format("{}", track.fps), "above 0, at most 1000");
  if (track.person < 0) bytes.fail("person", fmt::format("{}", track.person), "0 or more");
  track.poses.resize(bytes.count("poses", 1 + PackedPose{}.size()));
  if (track.first_frame > std::numeric_limits<int>::max() - static_cast<int>(track.poses.size())) bytes.fail("frame", fmt::format("{}", track.first_frame), "a smaller number");
  for (std::size_t i = 0; i < track.poses.size(); ++i) {
    track.flags.push_back(bytes.number<std::uint8_t>());
    if ((track.flags.back() & ~kRecorded) >= static_cast<int>(kActions)) bytes.fail("action", fmt::format("{}", track.flags.back()), fmt::format("below {}", kActions));
  }
  read_poses(bytes, track.poses);
  return track;
}

Object read_object(Bytes& bytes) {
  Object object;
  object.id = bytes.number<std::int32_t>();
  object.category = bytes.text();
  object.parts.resize(bytes.count("parts", 1 + 15 * sizeof(std::int32_t)));
  for (Part& part : object.parts) {
    part.name = bytes.text();
    for (double& x : part.box.center) x = bytes.number<std::int32_t>() / kBoxPerMetre;
    for (double& x : part.box.axes.reshaped()) x = bytes.number<std::int32_t>() / kAxesPerOne;
    for (double& x : part.box.half_size) x = bytes.number<std::int32_t>() / kBoxPerMetre;
    if (part.box.half_size.minCoeff() < 0) bytes.fail("size", "less than nothing", "0 or more");
    if (!RigidTransform{part.box.axes, part.box.center}.is_rigid()) bytes.fail("axes", "not a rotation", "three unit vectors at right angles");
  }
  return object;
}

Pose pose_of(const PackedPose& packed) {
  Pose pose;
  for (std::size_t i = 0; i < packed.size(); ++i) pose.reshaped()[static_cast<Eigen::Index>(i)] = packed[i] / kPerMetre;
  return pose;
}

template <class T>
std::vector<float> read_shares(Bytes& bytes) {
  std::vector<float> shares(kCategories.size() * kGrid * kGrid);
  for (float& share : shares) share = static_cast<float>(bytes.number<T>()) / static_cast<float>(std::numeric_limits<T>::max());
  return shares;
}

constexpr std::size_t kScenelet = 6 * sizeof(std::uint32_t) + 3 * 200;  ///< bytes of one without objects

/// How much the scenelets take once unpacked, for they share what the file has once.
struct Room {
  std::size_t poses = kMostPoses, parts = kMostParts;
  void take(std::size_t& of, std::size_t size, const Bytes& bytes) const {
    if (size > of) bytes.fail("scenelets", "more than 2 million poses or boxes", "a database that fits into memory");
    of -= size;
  }
};

Scenelet read_scenelet(Bytes& bytes, const std::vector<PackedTrack>& tracks, const std::vector<std::pair<int, Object>>& objects, Room& room) {
  Scenelet s;
  const PackedTrack& track = tracks[bytes.index("track", tracks.size())];
  const auto first = bytes.number<std::uint32_t>(), count = bytes.number<std::uint32_t>();
  if (count == 0 || first >= track.poses.size() || count > track.poses.size() - first)
    bytes.fail("poses", fmt::format("{} from {}", count, first), fmt::format("of a track of {}", track.poses.size()));
  room.take(room.poses, count, bytes);
  s.recording = track.recording;
  s.person = track.person;
  s.fps = track.fps;
  s.middle = static_cast<int>(bytes.index("middle", count));
  s.center = track.first_frame + static_cast<int>(first) + s.middle;
  s.origin = frame_of(pose_of(track.poses[first + static_cast<std::size_t>(s.middle)]));
  const Placement to_local = s.origin.inverse();
  for (std::size_t i = first; i < first + count; ++i) {
    s.poses.push_back(to_local * pose_of(track.poses[i]));
    s.valid.push_back((track.flags[i] & kRecorded) != 0);
    s.actions.push_back(static_cast<Action>(track.flags[i] & ~kRecorded));
  }
  const std::size_t object_count = bytes.count("objects", sizeof(std::uint32_t));
  for (std::size_t i = 0; i < object_count; ++i) {
    const auto& [recording, object] = objects[bytes.index("object", objects.size())];
    if (recording != s.recording) bytes.fail("object", fmt::format("one of recording {}", recording), fmt::format("one of {}", s.recording));
    room.take(room.parts, object.parts.size() + 1, bytes);
    s.objects.push_back(to_local * object);
  }
  s.highest_saliency = bytes.share("saliency");
  s.layout = read_shares<std::uint16_t>(bytes);
  s.saliency = read_shares<std::uint8_t>(bytes);
  return s;
}

}  // namespace

std::vector<Scenelet> scenelets_of(std::string_view body, std::size_t recordings, const std::string& source) {
  Bytes bytes(body, source);
  std::vector<PackedTrack> tracks;
  for (std::size_t left = bytes.count("tracks", 24); left > 0; --left) tracks.push_back(read_track(bytes, recordings));
  std::vector<std::pair<int, Object>> objects;
  for (std::size_t left = bytes.count("objects", 13); left > 0; --left) {
    const int recording = recording_index(bytes, recordings);
    objects.emplace_back(recording, read_object(bytes));
  }
  std::vector<Scenelet> scenelets;
  Room room;
  const std::size_t count = bytes.count("scenelets", kScenelet);
  scenelets.reserve(count);
  for (std::size_t i = 0; i < count; ++i) scenelets.push_back(read_scenelet(bytes, tracks, objects, room));
  if (!bytes.at_end()) bytes.fail("body", "more than its scenelets", "nothing behind them");
  return scenelets;
}

}  // namespace unseen::report
