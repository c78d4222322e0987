// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/interactions_take_parts.h"
#include "unseen/core/error.h"
#include "unseen/core/quantile.h"

namespace unseen::report {
namespace {

using namespace interactions;

constexpr double kSure = 0.3;  // confidence of a joint that tells where the picture is

/// The places of all sure joints, one coordinate of them.
std::vector<double> sure_places(const std::vector<Detection>& detections, int row) {
  std::vector<double> places;
  for (const Detection& d : detections)
    for (int j = 0; j < kJoints; ++j)
      if (d.confidence[j] > kSure) places.push_back(d.pixels(row, j));
  return places;
}

/// Nearly the largest: a few joints may be anywhere.
int reach_of(std::vector<double> places) {
  return static_cast<int>(std::clamp(quantile(std::move(places), 0.99), 0.0, 1e5));
}

/// The smallest usual picture, lying or upright, in which the joints are.
PictureSize guess_size(const std::vector<Detection>& detections) {
  const int x = reach_of(sure_places(detections, 0)), y = reach_of(sure_places(detections, 1));
  for (const auto& [longer, shorter] : {std::pair{640, 480}, {1280, 720}, {1920, 1080}, {2560, 1440}, {3840, 2160}, {7680, 4320}}) {
    if (x < longer && y < shorter) return {longer, shorter};
    if (x < shorter && y < longer) return {shorter, longer};
  }
  return {x + 1, y + 1};
}

}  // namespace

PictureSize picture_size(const GivenCamera& given, const JointFile* joints, std::vector<std::string>& remarks) {
  const Camera& c = given.camera;
  if (c.width > 0) return {c.width, c.height};
  if (joints && joints->width > 0 && joints->height > 0) return {joints->width, joints->height};
  PictureSize size = kUsualPicture;
  if (c.fx > 0.0 && c.cx > 1.0 && c.cy > 1.0) {
    size = {2 * static_cast<int>(std::lround(c.cx)), 2 * static_cast<int>(std::lround(c.cy))};  // even; centres are given as half of it or half a pixel less
  } else if (joints) {
    size = guess_size(joints->detections);
  }
  remarks.push_back(fmt::format("the camera has no size: a picture of {} x {} is assumed", size.width, size.height));
  return size;
}

Camera resolved_camera(const GivenCamera& given, const PictureSize& size) {
  Camera c = given.camera;
  c.width = size.width;
  c.height = size.height;
  if (c.fx > 0.0) return c;
  c.fx = c.fy = 0.5 * size.width / std::tan(0.5 * *given.hfov);
  c.cx = 0.5 * (size.width - 1);
  c.cy = 0.5 * (size.height - 1);
  return c;
}

void check_pixels(const std::vector<Detection>& detections, const std::string& source) {
  constexpr double kMostShare = 2.0;  // of the picture: what a detector guesses outside it counts, too
  bool seen = false;
  for (const Detection& d : detections)
    for (int j = 0; j < kJoints; ++j) {
      if (d.confidence[j] <= 0.0) continue;
      if (!(d.pixels.col(j).cwiseAbs().maxCoeff() < kMostShare)) return;
      seen = true;
    }
  if (seen) throw InputError(source, "joints", "coordinates within 0…1", "pixels");
}

void remark_on_places(Take& take) {
  constexpr double kMargin = 0.05;  // of the size: a detector's joints may lie a little outside
  constexpr double kErrors = 0.1;   // of the detections
  const double across = kMargin * take.camera.width, along = kMargin * take.camera.height;
  std::size_t outside = 0;
  for (const Detection& d : take.detections) {
    bool out = false;
    for (int j = 0; j < kJoints; ++j) {
      const Vec2 p = d.pixels.col(j);
      out = out || (d.confidence[j] > kSure && (p.x() < -across || p.y() < -along || p.x() > take.camera.width + across || p.y() > take.camera.height + along));
    }
    outside += out;
  }
  if (static_cast<double>(outside) > kErrors * static_cast<double>(take.detections.size()))
    take.remarks.push_back(fmt::format("joints lie outside the picture in {} of {} detections: {} x {} may be the wrong size", outside,
                                       take.detections.size(), take.camera.width, take.camera.height));
}

}  // namespace unseen::report
