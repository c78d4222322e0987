// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/overlay.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "collision/overlay_draw.h"
#include "io/clip.h"
#include "io/codecs.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

constexpr int kMostPictures = 150, kPictureWidth = 640, kQuality = 75;

/// First and last frame that is shown: those with a flight or, without one, in which something moves, and half a second around.
std::array<int, 2> shown_frames(const Shot& shot, const Reconstruction& r) {
  const int around = static_cast<int>(std::lround(0.5 * r.fps));
  const auto around_all = [&](const auto& seen) { return std::array{std::max(0, seen.front().frame - around), seen.back().frame + around}; };
  std::array<int, 2> range = r.frames.empty() ? around_all(r.sighted) : around_all(r.frames);
  if (shot.frames) range = {std::max(range[0], (*shot.frames)[0]), std::min(range[1], (*shot.frames)[1])};
  return range;
}

/// Every how manyth frame becomes a picture, counted from the first impact so that this is among them.
struct PictureChoice {
  int step = 1, from = 0;
  bool takes(int frame) const { return (frame - from) % step == 0; }
};

PictureChoice choose_pictures(const Reconstruction& r, const std::array<int, 2>& range) {
  PictureChoice choice;
  choice.step = std::max(1, (range[1] - range[0] + kMostPictures) / kMostPictures);
  choice.from = r.impacts.empty() ? range[0] : static_cast<int>(std::lround(r.impacts.front().frame));
  return choice;
}

/// s: by the time stamps of the frames in flight, which may be uneven; of others by the frame rate from the nearest of these.
double time_of(const Reconstruction& r, int frame) {
  if (r.frames.empty()) return frame / r.fps;
  auto at = std::lower_bound(r.frames.begin(), r.frames.end(), frame, [](const FramePose& f, int value) { return f.frame < value; });
  if (at == r.frames.end() || (at != r.frames.begin() && frame - (at - 1)->frame < at->frame - frame)) --at;
  return at->time + (frame - at->frame) / r.fps;
}

OverlayPicture picture_of(const cv::Mat& frame, double time) {
  cv::Mat small = frame;
  if (frame.cols > kPictureWidth)
    cv::resize(frame, small, {kPictureWidth, std::max(1, frame.rows * kPictureWidth / frame.cols)}, 0, 0, cv::INTER_AREA);
  std::vector<unsigned char> bytes;
  io::codecs().encode(".jpg", small, bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return {time, small.cols, small.rows, {bytes.begin(), bytes.end()}};
}

}  // namespace

std::vector<OverlayPicture> write_overlay(const Shot& shot, const Reconstruction& r, const std::filesystem::path& video, Context& context) {
  constexpr double kFast = 60.0, kSlow = 30.0;  // frames/s
  if (shot.video.empty() || (r.frames.empty() && r.sighted.empty()) || !(r.fps > 0)) return {};
  io::Clip clip(shot.video);
  const OverlayPen pen(shot, r);
  const std::array<int, 2> range = shown_frames(shot, r);
  const PictureChoice choice = choose_pictures(r, range);
  std::vector<OverlayPicture> pictures;
  std::unique_ptr<cv::VideoWriter> writer;
  cv::Mat frame;
  for (int f = 0; f <= range[1] && clip.next(frame); ++f) {
    context.progress(static_cast<double>(f) / (range[1] + 1));
    if (f < range[0]) continue;
    pen.draw(f, frame);
    if (!video.empty() && !writer) {
      writer = io::codecs().video_writer(video.string(), io::fourcc('m', 'p', '4', 'v'), r.fps > kFast ? kSlow : r.fps, frame.size());
      if (!writer->isOpened()) throw InputError(video.string(), "", "no video can be written", "OpenCV with FFmpeg, and a file that can be written");
    }
    if (writer) writer->write(frame);
    if (choice.takes(f)) pictures.push_back(picture_of(frame, time_of(r, f)));
  }
  return pictures;
}

}  // namespace unseen::collision
