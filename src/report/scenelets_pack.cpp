// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/scenelets_pack.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "io/bytes_out.h"

namespace unseen::report {
namespace {

using namespace interactions;

/// The nearest multiple of a unit, as a number of units. Round numbers that scenelets share come back from their frames with different
/// last digits; the small shift keeps them from being halfway between two multiples.
std::int32_t units(double value, double per_one) { return io::clamped<std::int32_t>(value * per_one - 1e-3); }

PackedPose packed(const Pose& pose) {
  PackedPose p;
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = units(pose.reshaped()[static_cast<Eigen::Index>(i)], kPerMetre);
  return p;
}

std::uint8_t flags(const Scenelet& s, std::size_t i) {
  return static_cast<std::uint8_t>(static_cast<int>(s.actions[i]) | (s.valid[i] ? kRecorded : 0));
}

/// Adds the poses of a scenelet to a track that they continue or are in already; false if they differ from what it has.
bool extend(PackedTrack& track, int first_frame, const std::vector<PackedPose>& poses, const std::vector<std::uint8_t>& flags) {
  const auto at = static_cast<std::size_t>(first_frame - track.first_frame);
  if (first_frame < track.first_frame || at > track.poses.size()) return false;
  const std::size_t shared = std::min(track.poses.size() - at, poses.size());
  for (std::size_t i = 0; i < shared; ++i)
    if (track.poses[at + i] != poses[i] || track.flags[at + i] != flags[i]) return false;
  track.poses.insert(track.poses.end(), poses.begin() + static_cast<std::ptrdiff_t>(shared), poses.end());
  track.flags.insert(track.flags.end(), flags.begin() + static_cast<std::ptrdiff_t>(shared), flags.end());
  return true;
}

void append_text(std::string& to, const std::string& text) {
  const std::string shortened = text.substr(0, 255);
  to += static_cast<char>(shortened.size());
  to += shortened;
}

/// An object as the file has it.
std::string bytes_of(const Object& object) {
  std::string bytes;
  io::append_little(bytes, static_cast<std::int32_t>(object.id));
  append_text(bytes, object.category);
  io::append_little(bytes, static_cast<std::uint32_t>(object.parts.size()));
  for (const Part& part : object.parts) {
    append_text(bytes, part.name);
    for (const double x : part.box.center) io::append_little(bytes, units(x, kBoxPerMetre));
    for (const double x : part.box.axes.reshaped()) io::append_little(bytes, units(x, kAxesPerOne));
    for (const double x : part.box.half_size) io::append_little(bytes, units(x, kBoxPerMetre));
  }
  return bytes;
}

/// A small number takes one byte: sign last, seven bits a byte, the highest bit says that more follow.
void append_varint(std::string& to, std::int64_t value) {
  auto bits = (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
  for (; bits >= 128; bits >>= 7) to += static_cast<char>(bits | 128);
  to += static_cast<char>(bits);
}

/// Poses joint by joint as what constant speed does not explain.
void append_poses(std::string& to, const std::vector<PackedPose>& poses) {
  for (std::size_t k = 0; k < PackedPose{}.size(); ++k) {
    std::int64_t before = 0, speed = 0;
    for (const PackedPose& pose : poses) {
      append_varint(to, pose[k] - before - speed);
      speed = &pose == &poses.front() ? 0 : pose[k] - before;
      before = pose[k];
    }
  }
}

template <class T>
void append_shares(std::string& to, const std::vector<float>& shares) {
  for (const float share : shares) io::append_little(to, io::clamped<T>(static_cast<double>(share) * std::numeric_limits<T>::max()));
}

}  // namespace

PackedDatabase pack(const Database& database) {
  PackedDatabase all;
  std::map<std::tuple<int, int, double>, std::size_t> open;  // the track that a person's next scenelet may continue
  std::map<std::pair<int, std::string>, std::uint32_t> known;
  for (const Scenelet& s : database.scenelets) {
    std::vector<PackedPose> poses;
    std::vector<std::uint8_t> flag;
    for (std::size_t i = 0; i < s.poses.size(); ++i) {
      poses.push_back(packed(s.origin * s.poses[i]));
      flag.push_back(flags(s, i));
    }
    const int first_frame = s.center - s.middle;
    const auto [at, added] = open.try_emplace({s.recording, s.person, s.fps}, all.tracks.size());
    if (added || !extend(all.tracks[at->second], first_frame, poses, flag)) {
      at->second = all.tracks.size();
      all.tracks.push_back({s.recording, s.person, first_frame, s.fps, poses, flag});
    }
    PackedScenelet& p = all.scenelets.emplace_back();
    p.track = static_cast<std::uint32_t>(at->second);
    p.first = static_cast<std::uint32_t>(first_frame - all.tracks[at->second].first_frame);
    p.count = static_cast<std::uint32_t>(poses.size());
    p.middle = static_cast<std::uint32_t>(s.middle);
    for (const Object& object : s.objects) {
      const Object placed = s.origin * object;
      const auto [entry, is_new] = known.try_emplace({s.recording, bytes_of(placed)}, static_cast<std::uint32_t>(all.objects.size()));
      if (is_new) all.objects.emplace_back(s.recording, placed);
      p.objects.push_back(entry->second);
    }
  }
  return all;
}

std::string body_of(const PackedDatabase& packed, const Database& database) {
  std::string body;
  const auto count = [&](std::size_t n) { io::append_little(body, static_cast<std::uint32_t>(n)); };
  count(packed.tracks.size());
  for (const PackedTrack& track : packed.tracks) {
    for (const int number : {track.recording, track.person, track.first_frame}) io::append_little(body, static_cast<std::int32_t>(number));
    io::append_little(body, track.fps);
    count(track.poses.size());
    body.append(track.flags.begin(), track.flags.end());
    append_poses(body, track.poses);
  }
  count(packed.objects.size());
  for (const auto& [recording, object] : packed.objects) {
    io::append_little(body, static_cast<std::int32_t>(recording));
    body += bytes_of(object);
  }
  count(packed.scenelets.size());
  for (std::size_t i = 0; i < packed.scenelets.size(); ++i) {
    const PackedScenelet& p = packed.scenelets[i];
    for (const std::uint32_t number : {p.track, p.first, p.count, p.middle}) io::append_little(body, number);
    count(p.objects.size());
    for (const std::uint32_t object : p.objects) io::append_little(body, object);
    io::append_little(body, static_cast<float>(database.scenelets[i].highest_saliency));
    append_shares<std::uint16_t>(body, database.scenelets[i].layout);
    append_shares<std::uint8_t>(body, database.scenelets[i].saliency);
  }
  return body;
}

}  // namespace unseen::report
