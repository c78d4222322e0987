// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/resting.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace unseen::collision {
namespace {

constexpr double kOther = 20.0;      // grey levels, and
constexpr double kOtherSigmas = 6.0;  // σ: farther from the median is another colour
constexpr double kShare = 0.08;      // of the frames that have to show it
constexpr int kFewest = 3;           // frames
constexpr double kSteady = 12.0;     // grey levels: mean deviation of the second colour about its mean
constexpr double kSmoother = 0.6;    // the second colour's step at the outline, as a share of the first's
constexpr int kSmallest = 30;        // px

/// The mean colour of the frames that differ from the median, where enough of them agree; `agree` is 255 there.
cv::Mat second_color(const std::vector<cv::Mat>& frames, const cv::Mat& noise, const cv::Mat& picture, cv::Mat& agree) {
  cv::Mat sum = cv::Mat::zeros(picture.size(), CV_32FC3), square = cv::Mat::zeros(picture.size(), CV_32F), count = cv::Mat::zeros(picture.size(), CV_32F);
  for (const cv::Mat& frame : frames)
    for (int y = 0; y < frame.rows; ++y)
      for (int x = 0; x < frame.cols; ++x) {
        const cv::Vec3b &f = frame.at<cv::Vec3b>(y, x), &b = picture.at<cv::Vec3b>(y, x);
        const double limit = std::max(kOther, kOtherSigmas * noise.at<float>(y, x));
        if (std::max({std::abs(f[0] - b[0]), std::abs(f[1] - b[1]), std::abs(f[2] - b[2])}) <= limit) continue;
        sum.at<cv::Vec3f>(y, x) += cv::Vec3f(f[0], f[1], f[2]);
        square.at<float>(y, x) += static_cast<float>(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
        count.at<float>(y, x) += 1.0f;
      }
  const double fewest = std::max<double>(kFewest, kShare * static_cast<double>(frames.size()));
  cv::Mat second = picture.clone();
  agree = cv::Mat::zeros(picture.size(), CV_8U);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const float n = count.at<float>(y, x);
      if (n < fewest) continue;
      const cv::Vec3f mean = sum.at<cv::Vec3f>(y, x) / n;
      if (square.at<float>(y, x) / n - mean.dot(mean) > 3.0 * kSteady * kSteady) continue;
      second.at<cv::Vec3b>(y, x) = cv::Vec3b(cv::saturate_cast<unsigned char>(mean[0]), cv::saturate_cast<unsigned char>(mean[1]),
                                             cv::saturate_cast<unsigned char>(mean[2]));
      agree.at<unsigned char>(y, x) = 255;
    }
  return second;
}

/// Mean colour difference between the inner and the outer border of a part, the inner one taken from `inside`.
double step_at_outline(const cv::Mat& inside, const cv::Mat& outside, const cv::Mat& inner, const cv::Mat& outer) {
  // Border pixels meet those outside them by blurring each side over the same window.
  cv::Mat a, b, wa, wb;
  cv::Mat in, out;
  inside.convertTo(in, CV_32FC3);
  outside.convertTo(out, CV_32FC3);
  inner.convertTo(wa, CV_32F, 1.0 / 255.0);
  outer.convertTo(wb, CV_32F, 1.0 / 255.0);
  cv::Mat wa3, wb3;
  cv::merge(std::vector<cv::Mat>{wa, wa, wa}, wa3);
  cv::merge(std::vector<cv::Mat>{wb, wb, wb}, wb3);
  cv::blur(in.mul(wa3), a, {7, 7});
  cv::blur(out.mul(wb3), b, {7, 7});
  cv::blur(wa, wa, {7, 7});
  cv::blur(wb, wb, {7, 7});
  double sum = 0.0, count = 0.0;
  for (int y = 0; y < a.rows; ++y)
    for (int x = 0; x < a.cols; ++x) {
      if (!inner.at<unsigned char>(y, x) || wb.at<float>(y, x) <= 0.0f || wa.at<float>(y, x) <= 0.0f) continue;
      sum += cv::norm(a.at<cv::Vec3f>(y, x) / wa.at<float>(y, x) - b.at<cv::Vec3f>(y, x) / wb.at<float>(y, x));
      count += 1.0;
    }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

void remove_resting(const std::vector<cv::Mat>& frames, const cv::Mat& noise, cv::Mat& picture) {
  cv::Mat agree, labels, stats, centers;
  const cv::Mat second = second_color(frames, noise, picture, agree);
  const cv::Mat element = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  cv::morphologyEx(agree, agree, cv::MORPH_CLOSE, element);
  cv::morphologyEx(agree, agree, cv::MORPH_OPEN, element);
  const int count = cv::connectedComponentsWithStats(agree, labels, stats, centers, 8);
  for (int i = 1; i < count; ++i) {
    if (stats.at<int>(i, cv::CC_STAT_AREA) < kSmallest) continue;
    cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT) - 6, stats.at<int>(i, cv::CC_STAT_TOP) - 6, stats.at<int>(i, cv::CC_STAT_WIDTH) + 12,
                 stats.at<int>(i, cv::CC_STAT_HEIGHT) + 12);
    box &= cv::Rect({0, 0}, picture.size());
    const cv::Mat part = labels(box) == i;
    cv::Mat smaller, larger, largest;
    cv::erode(part, smaller, element);
    cv::dilate(part, larger, element);
    cv::dilate(larger, largest, element);
    const cv::Mat inner = part & ~smaller, outer = largest & ~larger;
    const double kept = step_at_outline(picture(box), picture(box), inner, outer);
    const double other = step_at_outline(second(box), picture(box), inner, outer);
    if (other < kSmoother * kept) second(box).copyTo(picture(box), larger);
  }
}

}  // namespace unseen::collision
