// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "collision/video/background.h"
#include "collision/video/covered.h"
#include "collision/video/foreground.h"
#include "collision/video/repeats.h"
#include "collision/video/stabilise.h"
#include "collision/video/time_stamps.h"
#include "io/clip.h"
#include "unseen/core/error.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr int kLargestWidth = 1400;    // px: wider pictures are worked on at a half, a third, …
constexpr int kTrackedWidth = 640;     // px: the camera's motion is found at
constexpr std::size_t kBatch = 8;      // frames
constexpr double kOtherRate = 0.01;    // of the frame rate that the file states: worth a word
constexpr double kBlack = 0.4;         // of the typical brightness: a frame that shows nothing
constexpr double kNothing = 8.0;       // of 255, mean brightness: the same, where nothing else is known
constexpr double kCompression = 12.0;  // grey levels that it changes what stands still by, at most
constexpr double kFarMove = 0.06;      // of the picture's diagonal: more than hand-held
constexpr double kLostMotion = 0.3;    // share of the frames
constexpr double kEdgeSlack = 0.5;     // px, of a background that is moved

/// What the first pass over a clip finds out.
struct Survey {
  cv::Size size;         ///< of a decoded frame
  cv::Rect view;         ///< the part that is worked on
  int scale = 1;         ///< decoded pixels to one that is worked on
  int first = 0, last = 0;
  std::vector<double> stamps, change, brightness, moved;
  FrameSample sample;    ///< of the view, scaled
  Stabiliser stabiliser;
};

/// The frame that is worked on: cut to the view and made smaller.
cv::Mat working_copy(const cv::Mat& frame, const Survey& survey) {
  if (survey.scale == 1) return frame(survey.view);
  cv::Mat small;
  cv::resize(frame(survey.view), small, survey.view.size() / survey.scale, 0, 0, cv::INTER_AREA);
  return small;
}

void set_view(const Shot& shot, cv::Size size, Survey& survey) {
  survey.size = size;
  survey.view = {0, 0, size.width, size.height};
  if (shot.roi) {
    const auto& r = *shot.roi;
    const cv::Rect roi = cv::Rect(r[0], r[1], r[2], r[3]) & survey.view;
    if (r[2] <= 0 || r[3] <= 0 || roi.width < 8 || roi.height < 8)
      throw InputError(shot.name, "roi", fmt::format("{}, {}, {}, {}", r[0], r[1], r[2], r[3]),
                       fmt::format("x, y, width, height inside {} × {}", size.width, size.height));
    survey.view = roi;
  }
  survey.scale = (survey.view.width + kLargestWidth - 1) / kLargestWidth;
  survey.view.width -= survey.view.width % survey.scale;
  survey.view.height -= survey.view.height % survey.scale;
}

int tracked_scale(cv::Size size) { return std::max(1, (size.width + kTrackedWidth - 1) / kTrackedWidth); }

/// Mean difference of two pictures, grey levels, but for the light, if that explains a part of it: lamps flicker.
double change_between(const cv::Mat& before, const cv::Mat& after) {
  cv::Mat as_bright;
  cv::addWeighted(after, 1.0, before, -cv::mean(after)[0] / std::max(1.0, cv::mean(before)[0]), 0.0, as_bright, CV_32F);
  return std::min(cv::norm(after, before, cv::NORM_L1), cv::norm(as_bright, cv::NORM_L1)) / static_cast<double>(after.total());
}

/// The mean of what two pictures differ by beyond the noise of compression, grey levels.
double moved_between(const cv::Mat& before, const cv::Mat& after) {
  cv::Mat difference;
  cv::absdiff(before, after, difference);
  cv::subtract(difference, cv::Scalar(kCompression), difference);
  return cv::mean(difference)[0];
}

/// First pass: time stamps, changes, the camera's motion, and frames for the background.
Survey survey_clip(const Shot& shot, io::Clip& clip, Context& context) {
  Survey survey;
  survey.first = shot.frames ? (*shot.frames)[0] : 0;
  cv::Mat frame, gray, small, before;
  double lit = 0;  // brightness of the first frame that shows anything
  for (int k = 0; (!shot.frames || k <= (*shot.frames)[1]) && clip.next(frame); ++k) {
    context.check();
    if (clip.announced() > 0) context.progress(std::min(0.3, 0.3 * k / clip.announced()));
    if (k == 0) set_view(shot, frame.size(), survey);
    if (frame.size() != survey.size)
      throw InputError(shot.video, "frames", fmt::format("frame {} of another size", k), "frames of one size");
    const int scale = tracked_scale(frame.size());
    cv::resize(frame, small, frame.size() / scale, 0, 0, cv::INTER_AREA);
    cv::cvtColor(small, gray, cv::COLOR_BGR2GRAY);
    survey.stamps.push_back(clip.stamp());
    survey.brightness.push_back(cv::mean(gray)[0]);
    survey.change.push_back(before.empty() ? 0.0 : change_between(before, gray));
    survey.moved.push_back(before.empty() ? 0.0 : moved_between(before, gray));
    const bool black = survey.brightness.back() < std::max(kNothing, kBlack * lit);
    if (!black && lit == 0.0) lit = survey.brightness.back();
    survey.stabiliser.add(gray, !black);
    if (k >= survey.first) survey.sample.add(working_copy(frame, survey));
    cv::swap(gray, before);
  }
  survey.last = static_cast<int>(survey.stamps.size()) - 1;
  return survey;
}

/// Throws for what cannot be used at all, warns of what can.
void check_file(const Shot& shot, const io::Clip& clip, const Survey& survey, Context& context) {
  const int decoded = static_cast<int>(survey.stamps.size());
  if (decoded < 2)
    throw InputError(shot.video, "frames", decoded == 0 ? "no frame that can be decoded" : "one frame", "a video of several frames");
  if (!shot.fps && clip.fps() <= 0.0) throw InputError(shot.video, "fps", "no frame rate", "one in the file, or \"fps\" in the shot");
  if (shot.fps && clip.fps() > 0.0 && std::abs(*shot.fps / clip.fps() - 1.0) > kOtherRate)
    context.message(fmt::format("{}: the file states {:.4g} frames a second; {:.4g}, as the shot says, are taken", shot.video, clip.fps(), *shot.fps));
  if (decoded - survey.first < 2)
    throw InputError(shot.name, "frames", fmt::format("{} frames in the video", decoded), fmt::format("more than {}", survey.first + 1));
  const bool to_the_end = !shot.frames || (*shot.frames)[1] >= decoded;
  if (to_the_end && clip.announced() > decoded && !lasts_as_announced(survey.stamps, clip.announced(), clip.fps()))
    context.warn(fmt::format("{}: {} of {} announced frames could be decoded; the file may be cut short", shot.video, decoded, clip.announced()));
  if (clip.turn() % 360 != 0)
    context.warn(fmt::format("{}: the file asks to be turned by {}° clockwise, and is; if the picture stands on its head, set \"down\"", shot.video, clip.turn()));
}

/// A transform of decoded pixels as one of the pixels that are worked on: x = scale · u + o.
cv::Mat in_working_pixels(const cv::Mat& shift, const Survey& survey) {
  cv::Mat m = shift.clone();
  const double o[2] = {survey.view.x + 0.5 * (survey.scale - 1), survey.view.y + 0.5 * (survey.scale - 1)};
  for (int r = 0; r < 2; ++r)
    m.at<double>(r, 2) = (m.at<double>(r, 0) * o[0] + m.at<double>(r, 1) * o[1] + m.at<double>(r, 2) - o[r]) / survey.scale;
  return m;
}

/// The background as `frame` would see it: moved back by the camera's motion, with the frame's brightness.
Background seen_by(const cv::Mat& frame, const Background& background, const cv::Mat& shift, const Survey& survey) {
  Background seen;
  if (shift.empty()) {
    seen = background;
  } else {
    const cv::Mat m = in_working_pixels(shift, survey);
    cv::warpAffine(background.picture, seen.picture, m, frame.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
    cv::warpAffine(background.noise, seen.noise, m, frame.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT, cv::Scalar(80));
  }
  cv::Mat brightened;  // not in place: the picture may be the background's own
  cv::multiply(seen.picture, gain_of(frame, seen.picture), brightened);
  seen.picture = brightened;
  return seen;
}

std::vector<Region> regions_in(const cv::Mat& frame, int index, const Background& background, const Footage& footage, const Survey& survey) {
  const cv::Mat shift = footage.shift.empty() ? cv::Mat() : footage.shift[index];
  const Background seen = seen_by(frame, background, shift, survey);
  std::vector<Region> regions;
  for (const Part& part : find_parts(frame, seen, shift.empty() ? 0.0 : kEdgeSlack))
    regions.push_back(describe_part(part, frame, index, survey.scale, survey.view.tl()));
  std::stable_sort(regions.begin(), regions.end(), [](const Region& a, const Region& b) { return a.area > b.area; });
  return regions;
}

/// Frames of the sample brought to the first frame's place.
std::vector<cv::Mat> registered(const Survey& survey, const Footage& footage) {
  std::vector<cv::Mat> frames;
  for (std::size_t i = 0; i < survey.sample.frames().size(); ++i) {
    const int index = survey.first + survey.sample.indices()[i];
    if (footage.doubled[index]) continue;
    cv::Mat frame = survey.sample.frames()[i];
    if (!footage.shift.empty()) {
      cv::Mat moved;
      cv::warpAffine(frame, moved, in_working_pixels(footage.shift[index], survey), frame.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
      frame = moved;
    }
    frames.push_back(frame);
  }
  return frames.empty() ? survey.sample.frames() : frames;
}

/// Second pass: the regions of each frame that shows something.
void second_pass(const Shot& shot, const Survey& survey, const Background& background, Footage& footage, Context& context) {
  io::Clip clip(shot.video);
  const double black = kBlack * median(survey.brightness);
  cv::Mat frame;
  std::vector<std::pair<int, cv::Mat>> batch;
  const auto work = [&] {
    parallel_blocks(context, batch.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        footage.regions[batch[i].first] = regions_in(batch[i].second, batch[i].first, background, footage, survey);
    });
    batch.clear();
  };
  for (int k = 0; k <= survey.last && clip.next(frame); ++k) {
    if (k >= survey.first && survey.brightness[k] >= black) batch.emplace_back(k, working_copy(frame, survey).clone());
    if (batch.size() == kBatch) work();
    context.progress(0.4 + 0.6 * k / (survey.last + 1));
  }
  work();
}

}  // namespace

Footage find_regions(const Shot& shot, Context& context) {
  io::Clip clip(shot.video);
  const Survey survey = survey_clip(shot, clip, context);
  check_file(shot, clip, survey, context);
  Footage footage;
  footage.width = survey.size.width;
  footage.height = survey.size.height;
  footage.turn = clip.turn();
  footage.fps = shot.fps.value_or(clip.fps());
  footage.times = frame_times(survey.stamps, clip.fps(), shot.fps, shot.video, context);
  const Repeats found = find_repeats(survey.change, survey.brightness, survey.moved);
  footage.doubled = found.doubled;
  const bool converted = share_out_times(found, footage.times);
  footage.regions.resize(footage.times.size());
  const Stabiliser::Motion motion = survey.stabiliser.finish(tracked_scale(survey.size));
  footage.shift = motion.shift;
  footage.moving_camera = motion.largest > kFarMove * std::hypot(footage.width, footage.height) ||
                          (!motion.shift.empty() && motion.lost > kLostMotion);
  if (footage.moving_camera)
    context.warn(fmt::format("{}: the camera moves, by up to {:.0f} px; a camera on a stand is expected", shot.video, motion.largest));
  const auto repeats = std::count(footage.doubled.begin(), footage.doubled.end(), 1);
  if (converted)
    context.warn(fmt::format("{}: {} frames repeat the one before at regular places, as conversion to a higher rate leaves them; left out, and the others spaced evenly", shot.video, repeats));
  else if (repeats > 0) context.warn(fmt::format("{}: {} repeat{} the one before; left out", shot.video, repeats == 1 ? "1 frame" : fmt::format("{} frames", repeats), repeats == 1 ? "s" : ""));
  const Background background = find_background(registered(survey, footage), context);
  second_pass(shot, survey, background, footage, context);
  mark_covered(background, survey.view.tl(), survey.scale, footage, context);
  return footage;
}

}  // namespace unseen::collision
