// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <map>

#include "interactions/sample_files.h"
#include "unseen/interactions/skeleton.h"

// Somebody whose joints are at known places, as the four formats have it.
namespace unseen::interactions::test {

/// Where a keypoint of that name is: left is at x > 500, ears and eyes near the nose. Confidence falls with the height in the picture.
inline const std::map<std::string, std::array<double, 3>> kPerson = {
    {"nose", {500, 100, 0.9}},   {"neck", {500, 160, 0.88}},  {"mid hip", {500, 360, 0.7}},  {"r eye", {490, 95, 0.91}},    {"l eye", {510, 95, 0.92}},
    {"r ear", {480, 97, 0.93}},  {"l ear", {520, 97, 0.94}},  {"r shoulder", {440, 162, 0.86}}, {"l shoulder", {560, 158, 0.84}}, {"r elbow", {430, 250, 0.8}},
    {"l elbow", {570, 251, 0.81}}, {"r wrist", {425, 330, 0.78}}, {"l wrist", {575, 331, 0.77}}, {"r hip", {460, 362, 0.69}},  {"l hip", {540, 358, 0.71}},
    {"r knee", {462, 470, 0.6}}, {"l knee", {541, 471, 0.61}}, {"r ankle", {463, 580, 0.5}},   {"l ankle", {542, 581, 0.51}}};

/// Keypoints in the order of `names`, moved by `dx`; unknown names are far away and confident, so that using them shows.
inline Json keypoints(const std::vector<std::string>& names, double dx = 0) {
  Json values = Json::array();
  for (const std::string& name : names) {
    const auto at = kPerson.find(name);
    const std::array<double, 3> p = at == kPerson.end() ? std::array<double, 3>{900, 900, 1} : at->second;
    for (const double v : {p[0] + dx, p[1], p[2]}) values.push_back(v);
  }
  return values;
}

/// https://github.com/CMU-Perceptual-Computing-Lab/openpose/blob/master/doc/02_output.md
inline const std::vector<std::string> kBody25 = {"nose", "neck", "r shoulder", "r elbow", "r wrist", "l shoulder", "l elbow", "l wrist", "mid hip",
                                                 "r hip", "r knee", "r ankle", "l hip", "l knee", "l ankle", "r eye", "l eye", "r ear", "l ear",
                                                 "big toe", "small toe", "heel", "big toe", "small toe", "heel"};
inline const std::vector<std::string> kCoco18 = {"nose", "neck", "r shoulder", "r elbow", "r wrist", "l shoulder", "l elbow", "l wrist", "r hip",
                                                 "r knee", "r ankle", "l hip", "l knee", "l ankle", "r eye", "l eye", "r ear", "l ear"};
inline const std::vector<std::string> kCoco17 = {"nose", "l eye", "r eye", "l ear", "r ear", "l shoulder", "r shoulder", "l elbow", "r elbow",
                                                 "l wrist", "r wrist", "l hip", "r hip", "l knee", "r knee", "l ankle", "r ankle"};
inline const std::vector<std::string> kPose33 = {"nose", "l eye", "l eye", "l eye", "r eye", "r eye", "r eye", "l ear", "r ear", "mouth", "mouth",
                                                 "l shoulder", "r shoulder", "l elbow", "r elbow", "l wrist", "r wrist", "pinky", "pinky", "index",
                                                 "index", "thumb", "thumb", "l hip", "r hip", "l knee", "r knee", "l ankle", "r ankle", "heel", "heel",
                                                 "foot", "foot"};

inline Json openpose_person(const std::vector<std::string>& names, double dx = 0) { return {{"person_id", {-1}}, {"pose_keypoints_2d", keypoints(names, dx)}}; }
inline Json openpose_frame(const Json& people) { return {{"version", 1.3}, {"people", people}}; }

inline Json coco_person(int image, double dx = 0) { return {{"image_id", image}, {"category_id", 1}, {"keypoints", keypoints(kCoco17, dx)}, {"score", 0.9}}; }

/// Landmarks in shares of 1920 × 1080, or as metres: pixels / 100 around the hips, y down, z = 0.01 × index.
inline Json landmarks(double dx = 0, bool world = false) {
  Json list = Json::array();
  const Json values = keypoints(kPose33, dx);
  for (std::size_t i = 0; i < kPose33.size(); ++i) {
    const double x = values[3 * i].get<double>(), y = values[3 * i + 1].get<double>();
    if (world) list.push_back({{"x", (x - 500) / 100}, {"y", (y - 360) / 100}, {"z", 0.01 * static_cast<double>(i)}, {"visibility", values[3 * i + 2]}});
    else list.push_back({{"x", x / 1920}, {"y", y / 1080}, {"z", 0.1}, {"visibility", values[3 * i + 2]}});
  }
  return list;
}

inline Json camera() { return {{"fx", 1500}, {"fy", 1500}, {"cx", 960}, {"cy", 540}, {"width", 1920}, {"height", 1080}}; }
inline Json take(const std::string& format, const std::string& joints) { return {{"camera", camera()}, {"fps", 25}, {"joints", joints}, {"format", format}, {"people", 1}}; }

/// The same person in 16 joints, zero-padded frames as i3DB has them. `score`: confidence as written.
inline Json i3db_detections(const std::vector<int>& frames, double score, bool normalized) {
  const std::array<const char*, kJoints> names = {"r ankle", "r knee", "r hip", "l hip", "l knee", "l ankle", "mid hip", "neck",
                                                  "neck", "nose", "r wrist", "r elbow", "r shoulder", "l shoulder", "l elbow", "l wrist"};
  Json places = Json::object(), values = Json::array();
  for (const int frame : frames) {
    Json joints = Json::object(), scores = Json::object();
    for (std::size_t j = 0; j < kJoints; ++j) {
      const auto& p = kPerson.at(names[j]);
      joints[std::to_string(j)] = {p[0] * 368 / 1080, p[1] * 368 / 1080, 0.0};
      if (j != pelvis && j != neck) scores[std::to_string(j)] = j == left_hip ? 0.9 * score : score;
    }
    std::string key = std::to_string(frame);
    places[std::string(5 - key.size(), '0') + key] = joints;
    values.push_back(scores);
  }
  Json json = {{"3d", places}, {"confidence", {{"frame_ids", frames}, {"values", values}}}};
  if (normalized) json["confidence_normalized"] = true;
  return json;
}

}  // namespace unseen::interactions::test
