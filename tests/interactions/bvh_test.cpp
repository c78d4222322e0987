// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "interactions/page_sample.h"
#include "unseen/report/interactions_files.h"

namespace unseen::report {
namespace {

using namespace interactions;

/// A BVH file as any reader takes it: nothing of the writer's is used.
struct Bvh {
  struct Node {
    std::string name;
    int parent;
    Vec3 offset;
    std::vector<std::string> channels;
  };
  std::vector<Node> nodes;
  double frame_time = 0;
  std::vector<std::vector<double>> frames;

  std::map<std::string, Vec3> places(std::size_t frame) const {
    std::vector<Eigen::Affine3d> world;
    std::map<std::string, Vec3> places;
    std::size_t at = 0;
    for (const Node& node : nodes) {
      Eigen::Affine3d T = node.parent < 0 ? Eigen::Affine3d::Identity() : world[static_cast<std::size_t>(node.parent)];
      T.translate(node.offset);
      for (const std::string& channel : node.channels) {
        const double value = frames[frame].at(at++);
        const Vec3 axis = channel[0] == 'X' ? Vec3::UnitX() : channel[0] == 'Y' ? Vec3::UnitY() : Vec3::UnitZ();
        if (channel.substr(1) == "position")
          T.translate(value * axis);
        else
          T.rotate(Eigen::AngleAxisd(value * kPi / 180.0, axis));
      }
      world.push_back(T);
      places[node.name] = T.translation();
    }
    EXPECT_EQ(at, frames[frame].size());
    return places;
  }
};

Bvh parse(const std::string& text) {
  Bvh bvh;
  std::istringstream in(text);
  std::vector<int> open;
  std::string word;
  bool end = false;
  while (in >> word && word != "MOTION") {
    if (word == "ROOT" || word == "JOINT") {
      in >> word;
      bvh.nodes.push_back({word, open.empty() ? -1 : open.back(), Vec3::Zero(), {}});
    } else if (word == "End") {
      end = true;
    } else if (word == "{") {
      open.push_back(end ? -2 : static_cast<int>(bvh.nodes.size()) - 1);
    } else if (word == "}") {
      open.pop_back();
      end = false;
    } else if (word == "OFFSET") {
      Vec3 v;
      in >> v.x() >> v.y() >> v.z();
      if (!end) bvh.nodes.back().offset = v;
    } else if (word == "CHANNELS") {
      int count = 0;
      in >> count;
      for (int c = 0; c < count; ++c) bvh.nodes.back().channels.emplace_back(), in >> bvh.nodes.back().channels.back();
    }
  }
  std::size_t frames = 0;
  in >> word >> frames >> word >> word >> bvh.frame_time;
  std::getline(in, word);
  for (std::string line; std::getline(in, line);) {
    std::istringstream numbers(line);
    bvh.frames.emplace_back();
    for (double v; numbers >> v;) bvh.frames.back().push_back(v);
  }
  EXPECT_EQ(bvh.frames.size(), frames);
  return bvh;
}

std::string file_name(int joint) {
  std::string name = kJointNames[static_cast<std::size_t>(joint)];
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

/// World metres to the file's centimetres: y up.
Vec3 in_file(const Vec3& p) {
  return 100.0 * Vec3(p.x(), p.z(), -p.y());
}

double median_length(const Person& person, Joint from, Joint to) {
  std::vector<double> all;
  for (const PersonFrame& f : person.frames) all.push_back((f.pose.col(from) - f.pose.col(to)).norm());
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

/// The pose with each bone of constant length in its own direction, from the pelvis outwards.
Pose with_lengths(const Pose& pose, const std::map<Joint, double>& lengths) {
  Pose out = pose;
  for (const auto& [from, to] : kBones) out.col(to) = out.col(from) + lengths.at(to) * (pose.col(to) - pose.col(from)).normalized();
  return out;
}

std::map<Joint, double> lengths_of(const Person& person) {
  std::map<Joint, double> lengths;
  for (const auto& [from, to] : kBones) lengths[to] = median_length(person, from, to);
  return lengths;
}

TEST(InteractionsBvh, ForwardKinematicsGiveThePosesWithConstantLimbs) {
  for (const int seed : {4, 7}) {
    const PageSample s = page_sample(1, 24, seed);
    const Person& person = s.result.people[0];
    const Bvh bvh = parse(interactions_bvh(person, s.result.fps));
    EXPECT_NEAR(bvh.frame_time, 1.0 / s.result.fps, 1e-9);
    ASSERT_EQ(static_cast<int>(bvh.frames.size()), person.frames.back().frame - person.frames.front().frame + 1);
    const auto lengths = lengths_of(person);
    for (const PersonFrame& f : person.frames) {
      const auto places = bvh.places(static_cast<std::size_t>(f.frame - person.frames.front().frame));
      const Pose wanted = with_lengths(f.pose, lengths);
      for (int j = 0; j < kJoints; ++j) {
        ASSERT_LT((places.at(file_name(j)) - in_file(wanted.col(j))).norm(), 0.05)
            << f.frame << " " << kJointNames[static_cast<std::size_t>(j)];  // cm
        ASSERT_LT((places.at(file_name(j)) - in_file(f.pose.col(j))).norm(), 3.0) << f.frame << " " << kJointNames[static_cast<std::size_t>(j)];
      }
    }
  }
}

TEST(InteractionsBvh, AnglesDoNotJumpFromFrameToFrame) {
  const PageSample s = page_sample(1, 24, 4);
  const Bvh bvh = parse(interactions_bvh(s.result.people[0], s.result.fps));
  for (std::size_t f = 1; f < bvh.frames.size(); ++f)
    for (std::size_t c = 3; c < bvh.frames[f].size(); ++c) ASSERT_LT(std::abs(bvh.frames[f][c] - bvh.frames[f - 1][c]), 150) << f << " " << c;
}

TEST(InteractionsBvh, WhoStandsAsAtRestIsTurnedNowhere) {
  // Arms stretched out, facing the file's +z: −y of the world.
  Person person;
  PersonFrame frame;
  const auto put = [&](Joint joint, double left, double up) { frame.pose.col(joint) = Vec3(left, 0, up); };
  put(pelvis, 0, 1), put(thorax, 0, 1.5), put(neck, 0, 1.6), put(head, 0, 1.75);
  put(left_hip, 0.1, 1), put(left_knee, 0.1, 0.5), put(left_ankle, 0.1, 0.1), put(right_hip, -0.1, 1), put(right_knee, -0.1, 0.5),
      put(right_ankle, -0.1, 0.1);
  put(left_shoulder, 0.2, 1.5), put(left_elbow, 0.5, 1.5), put(left_wrist, 0.75, 1.5);
  put(right_shoulder, -0.2, 1.5), put(right_elbow, -0.5, 1.5), put(right_wrist, -0.75, 1.5);
  person.frames = {frame};
  const Bvh bvh = parse(interactions_bvh(person, 25));
  ASSERT_EQ(bvh.frames.size(), 1u);
  EXPECT_EQ(bvh.frames[0][1], 100);  // cm
  for (std::size_t c = 3; c < bvh.frames[0].size(); ++c) EXPECT_EQ(bvh.frames[0][c], 0) << c;
  // Turned to the left (from above, counter-clockwise) by 90°, only the pelvis turns, about y.
  person.frames[0].pose = Placement{Vec3::Zero(), kPi / 2} * frame.pose;
  const Bvh turned = parse(interactions_bvh(person, 25));
  for (std::size_t c = 3; c < turned.frames[0].size(); ++c) EXPECT_NEAR(turned.frames[0][c], c == 5 ? 90 : 0, 1e-4) << c;
}

TEST(InteractionsBvh, FramesThatAreMissingLieBetween) {
  const PageSample s = page_sample();
  Person person = s.result.people[0];
  person.frames.resize(2);
  person.frames[1].frame = person.frames[0].frame + 4;
  const Bvh bvh = parse(interactions_bvh(person, 10));
  ASSERT_EQ(bvh.frames.size(), 5u);
  const Vec3 a = in_file(person.frames[0].pose.col(pelvis)), b = in_file(person.frames[1].pose.col(pelvis));
  EXPECT_LT((bvh.places(1).at("pelvis") - (0.75 * a + 0.25 * b)).norm(), 1e-3);
}

TEST(InteractionsBvh, OfNobodyOrOfEndlessFramesIsEmpty) {
  EXPECT_EQ(interactions_bvh({}, 10), "");
  Person person = page_sample().result.people[0];
  person.frames.resize(2);
  person.frames[0].frame = -2'000'000'000;
  person.frames[1].frame = 2'000'000'000;
  EXPECT_EQ(interactions_bvh(person, 10), "");
  for (PersonFrame& f : person.frames) f.pose.setZero();  // no direction at all
  person.frames[1].frame = person.frames[0].frame + 1;
  EXPECT_EQ(interactions_bvh(person, 10).find("nan"), std::string::npos);
}

}  // namespace
}  // namespace unseen::report
