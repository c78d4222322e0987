// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/background.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "collision/video/lasting.h"
#include "collision/video/mask_shape.h"
#include "collision/video/resting.h"
#include "collision/video/worst_channel.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kSample = 48;    // frames
constexpr double kLeastNoise = 1.2;    // grey levels
constexpr int kGainStep = 7;           // pixels between those that the gain is taken from
constexpr double kGainSpread = 0.25;   // of a pixel's brightness: farther off is something else
constexpr double kDark = 6.0;          // grey levels: too dark to tell a gain from

/// Comparators of Batcher's odd-even merge sort for `n` values, in order.
std::vector<std::pair<int, int>> sorting_network(int n) {
  std::vector<std::pair<int, int>> network;
  for (int p = 1; p < n; p *= 2)
    for (int k = p; k >= 1; k /= 2)
      for (int j = k % p; j + k < n; j += 2 * k)
        for (int i = 0; i < std::min(k, n - j - k); ++i)
          if ((i + j) / (2 * p) == (i + j + k) / (2 * p)) network.emplace_back(i + j, i + j + k);
  return network;
}

/// Value by value median of rows of bytes; sorts them on the way.
void median_row(std::vector<cv::Mat>& rows, const std::vector<std::pair<int, int>>& network, cv::Mat& buffer, cv::Mat out) {
  for (const auto& [i, j] : network) {
    cv::min(rows[i], rows[j], buffer);
    cv::max(rows[i], rows[j], rows[j]);
    std::swap(rows[i], buffer);
  }
  rows[rows.size() / 2].copyTo(out);
}

/// Median picture and, into `deviation` if it is not null, the median absolute deviation from it.
cv::Mat median_picture(const std::vector<cv::Mat>& frames, cv::Mat* deviation, const Context& context) {
  const cv::Mat& first = frames.front();
  cv::Mat median(first.size(), first.type());
  if (deviation) deviation->create(first.size(), first.type());
  const auto network = sorting_network(static_cast<int>(frames.size()));
  parallel_blocks(context, static_cast<std::size_t>(first.rows), 16, [&](std::size_t begin, std::size_t end) {
    std::vector<cv::Mat> rows(frames.size());
    cv::Mat buffer;
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (std::size_t k = 0; k < frames.size(); ++k) frames[k].row(y).copyTo(rows[k]);
      median_row(rows, network, buffer, median.row(y));
      if (!deviation) continue;
      for (std::size_t k = 0; k < frames.size(); ++k) cv::absdiff(frames[k].row(y), median.row(y), rows[k]);
      median_row(rows, network, buffer, deviation->row(y));
    }
  });
  return median;
}

/// σ of a pixel's worst channel from the median absolute deviations.
cv::Mat noise_of(const cv::Mat& deviation) {
  cv::Mat noise;
  worst_channel(deviation).convertTo(noise, CV_32F, 1.4826);
  cv::blur(noise, noise, {5, 5});
  return cv::max(noise, kLeastNoise);
}

/// Noise of what was taken out of a picture, at its border too: as around it, for frames were compared with what is gone.
void take_from_around(const cv::Mat& gone, cv::Mat& noise) {
  constexpr int kBorder = 9, kAround = 31;  // px, of discs
  cv::Mat parts, labels, stats, centers;
  cv::dilate(gone, parts, disc(kBorder));
  const int count = cv::connectedComponentsWithStats(parts, labels, stats, centers, 8);
  for (int i = 1; i < count; ++i) {
    const cv::Rect part(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP), stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    const cv::Rect box = cv::Rect(part.x - kAround, part.y - kAround, part.width + 2 * kAround, part.height + 2 * kAround) & cv::Rect({0, 0}, noise.size());
    const cv::Mat own = labels(box) == i;
    cv::Mat around, here = noise(box);
    cv::dilate(own, around, disc(kAround));
    around &= ~parts(box);
    std::vector<float> values;
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x)
        if (around.at<unsigned char>(y, x)) values.push_back(here.at<float>(y, x));
    if (values.empty()) continue;
    cv::Mat less;
    cv::min(here, median(std::move(values)), less);
    less.copyTo(here, own);
  }
}

}  // namespace

void FrameSample::add(const cv::Mat& frame) {
  if (added_ % stride_ == 0) {
    frames_.push_back(frame.clone());
    indices_.push_back(added_);
  }
  ++added_;
  if (frames_.size() < 2 * kSample) return;
  for (std::size_t k = 0; 2 * k < frames_.size(); ++k) {
    frames_[k] = frames_[2 * k];
    indices_[k] = indices_[2 * k];
  }
  frames_.resize(kSample);
  indices_.resize(kSample);
  stride_ *= 2;
}

cv::Scalar gain_of(const cv::Mat& frame, const cv::Mat& background) {
  cv::Scalar gain(1, 1, 1);
  for (int c = 0; c < 3; ++c) {
    std::vector<double> ratios;
    for (int y = kGainStep / 2; y < frame.rows; y += kGainStep)
      for (int x = kGainStep / 2; x < frame.cols; x += kGainStep) {
        const double b = background.at<cv::Vec3b>(y, x)[c], f = frame.at<cv::Vec3b>(y, x)[c];
        if (b > kDark && b < 250.0 && f < 250.0) ratios.push_back(f / b);
      }
    if (ratios.size() < 20) continue;
    const double middle = unseen::median(ratios);
    double sum = 0.0, count = 0.0;  // grey levels are whole numbers: the mean about the median is finer
    for (const double r : ratios)
      if (std::abs(r - middle) < kGainSpread * middle) {
        sum += r;
        count += 1.0;
      }
    if (count > 0.0) gain[c] = sum / count;
  }
  return gain;
}

Background find_background(const std::vector<cv::Mat>& frames, const Context& context) {
  Background background;
  const cv::Mat rough = median_picture(frames, nullptr, context);
  std::vector<cv::Mat> even;
  for (const cv::Mat& frame : frames) {
    const cv::Scalar gain = gain_of(frame, rough);
    if (gain[0] + gain[1] + gain[2] < 0.75) continue;  // a black frame
    cv::Mat scaled;
    cv::multiply(frame, cv::Scalar(1.0 / gain[0], 1.0 / gain[1], 1.0 / gain[2]), scaled);
    even.push_back(scaled);
  }
  if (even.empty()) even = frames;
  cv::Mat deviation;
  background.picture = median_picture(even, &deviation, context);
  restore_lasting(even, background.picture, deviation, context);
  background.noise = noise_of(deviation);
  const cv::Mat before = background.picture.clone();
  remove_resting(even, background.noise, background.picture, context);
  take_from_around(worst_difference(background.picture, before) > 0, background.noise);
  return background;
}

}  // namespace unseen::collision
