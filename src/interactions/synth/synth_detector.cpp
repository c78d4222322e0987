// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "interactions/synth/synth_sight.h"

namespace unseen::interactions {
namespace {

/// Marsaglia and Tsang (2000); shape ≥ 1.
double draw_gamma(double shape, Random& random) {
  const double d = shape - 1.0 / 3.0, c = 1.0 / std::sqrt(9.0 * d);
  while (true) {
    const double x = random.normal(), v = std::pow(1.0 + c * x, 3);
    if (v > 0 && std::log(1.0 - random.uniform()) < 0.5 * x * x + d - d * v + d * std::log(v)) return d * v;
  }
}

double draw_beta(double a, double b, Random& random) {
  const double x = draw_gamma(a, random), y = draw_gamma(b, random);
  return x / (x + y);
}

/// A value that wanders slowly around 0, standard deviation 1.
class Wander {
 public:
  explicit Wander(Random& random) {
    for (auto& [hertz, phase] : waves_) {
      hertz = random.uniform(0.1, 0.9);
      phase = random.uniform(0.0, 2.0 * kPi);
    }
  }
  double at(double t) const {
    double sum = 0;
    for (const auto& [hertz, phase] : waves_) sum += std::sin(2.0 * kPi * hertz * t + phase);
    return sum * std::sqrt(2.0 / static_cast<double>(waves_.size()));
  }

 private:
  std::array<std::pair<double, double>, 5> waves_;
};

/// A lifting network: every bone turned a little, slowly changing; limbs that are not seen hang straight down as in somebody who stands, or stick out.
class Lifter {
 public:
  explicit Lifter(Random& random) : bias_(random.uniform(0.02, 0.06)), distorted_(random.direction()) {
    for (std::size_t i = 0; i < 3 * (kBones.size() + 1); ++i) wanders_.emplace_back(random);
  }

  Pose lift(const Pose& camera_pose, const std::array<bool, kJoints>& hidden, const Vec3& down, double t) {
    const auto turn = [&](std::size_t i, double size) {
      const Vec3 axis(wanders_[3 * i].at(t), wanders_[3 * i + 1].at(t), wanders_[3 * i + 2].at(t));
      return axis.norm() > 1e-9 ? Mat3(Eigen::AngleAxisd(size * axis.norm(), axis.normalized())) : Mat3(Mat3::Identity());
    };
    const Mat3 whole = turn(kBones.size(), bias_);
    Pose local = Pose::Zero();
    for (std::size_t b = 0; b < kBones.size(); ++b) {
      const auto& [from, to] = kBones[b];
      const Vec3 bone = camera_pose.col(to) - camera_pose.col(from);
      Vec3 lifted = whole * turn(b, 0.045) * bone;
      const bool limb = from != pelvis && from != thorax && from != neck;
      double& doubt = doubts_[b];  // follows what is seen within some tenths of a second
      doubt += 0.35 * ((limb && hidden[static_cast<std::size_t>(to)] ? 1.0 : 0.0) - doubt);
      if (doubt > 0.01) {
        const Vec3 guess = (down + 0.35 * distorted_ + 0.25 * Vec3(wanders_[3 * b].at(0.3 * t), 0, wanders_[3 * b + 2].at(0.3 * t))).normalized();
        lifted = ((1.0 - 0.85 * doubt) * lifted.normalized() + 0.85 * doubt * guess).normalized() * bone.norm();
      }
      local.col(to) = local.col(from) + lifted;
    }
    return local;
  }

 private:
  double bias_;
  Vec3 distorted_;
  std::vector<Wander> wanders_;
  std::array<double, kBones.size()> doubts_ = {};
};

/// A joint that is not seen: where the detector thinks it is. Errors last for a while, for detectors err alike in frames that look alike.
struct Guess {
  Vec2 offset = Vec2::Zero();  ///< share of the person's height in the picture
  bool confident = false;
  int until = 0;  ///< frame
};

}  // namespace

std::vector<Detection> detect(const View& view, const std::vector<RecordedFrame>& frames, const DetectorOptions& options, Random& random) {
  constexpr double kWrong = 0.1;  // of hidden joints
  const RigidTransform to_camera = view.T_world_camera.inverse();
  const Vec3 down = to_camera.rotation * -Vec3::UnitZ();
  Lifter lifter(random);
  std::array<Guess, kJoints> guesses = {};
  std::vector<Detection> detections;
  for (const RecordedFrame& frame : frames) {
    Detection d;
    d.frame = frame.frame;
    const Pose pose = (to_camera.rotation * frame.pose).colwise() + to_camera.translation;
    const double size = 1.7 * view.camera.fy / pose(2, pelvis);  // px, of a person
    int seen = 0;
    for (int j = 0; j < kJoints; ++j) {
      const bool hidden = frame.occluded[static_cast<std::size_t>(j)];
      Guess& guess = guesses[static_cast<std::size_t>(j)];
      if (frame.frame >= guess.until) {
        guess.until = frame.frame + static_cast<int>(options.fps * random.uniform(0.3, 1.0)) + 1;
        guess.confident = random.uniform() < kWrong;
        const double angle = random.uniform(0.0, 2.0 * kPi), far = guess.confident ? random.uniform(0.06, 0.15) : random.uniform(0.0, 0.06);
        guess.offset = far * Vec2(std::cos(angle), std::sin(angle));
      }
      const bool sure = !hidden || guess.confident;
      double confidence = sure ? draw_beta(17.0, 3.0, random) : draw_beta(3.0, 12.0, random);
      const Vec2 error = options.noise * Vec2{random.normal(), random.normal()};
      if (pose(2, j) < 0.1) continue;
      const Vec2 pixel = view.camera.project(pose.col(j)) + error + (hidden ? Vec2(size * guess.offset) : Vec2::Zero());
      if (pixel.x() < -0.5 || pixel.y() < -0.5 || pixel.x() > view.camera.width - 0.5 || pixel.y() > view.camera.height - 0.5) continue;
      d.pixels.col(j) = pixel;
      d.confidence[j] = confidence;
      seen += !hidden;
    }
    std::array<bool, kJoints> unseen = {};
    for (int j = 0; j < kJoints; ++j) unseen[static_cast<std::size_t>(j)] = d.confidence[j] < 0.5;
    const Pose local = lifter.lift(pose, unseen, down, frame.frame / options.fps);
    if (options.lifted) d.local = local;
    if (seen >= 4) detections.push_back(d);
  }
  return detections;
}

}  // namespace unseen::interactions
