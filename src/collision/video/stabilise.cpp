// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/stabilise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace unseen::collision {
namespace {

constexpr int kCorners = 150;
constexpr double kQuality = 0.01, kSpacing = 8.0;
constexpr double kInlier = 0.7;       // px
constexpr double kAgreeing = 0.6;     // share of the corners
constexpr int kFewestCorners = 15;           // corners
constexpr double kCornerSpread = 0.35;  // of the picture's width and height that the corners must span
constexpr double kStill = 0.35;       // px, of a corner of the picture
constexpr double kGain = 0.85;        // of the difference from the first frame that undoing the motion may leave

/// How far the transform moves the picture's corners, px.
double largest_move(const cv::Mat& m, cv::Size size) {
  double largest = 0.0;
  for (const cv::Point2d p : {cv::Point2d(0, 0), cv::Point2d(size.width, 0), cv::Point2d(0, size.height), cv::Point2d(size.width, size.height)}) {
    const double x = m.at<double>(0, 0) * p.x + m.at<double>(0, 1) * p.y + m.at<double>(0, 2);
    const double y = m.at<double>(1, 0) * p.x + m.at<double>(1, 1) * p.y + m.at<double>(1, 2);
    largest = std::max(largest, std::hypot(x - p.x, y - p.y));
  }
  return largest;
}

/// True if the points reach over much of the picture: those on one mover do not.
bool spread(const std::vector<cv::Point2f>& points, const std::vector<unsigned char>& inlier, cv::Size size) {
  cv::Rect2f box;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (inlier[i]) box = box.empty() ? cv::Rect2f(points[i], cv::Size2f(1e-3f, 1e-3f)) : box | cv::Rect2f(points[i], cv::Size2f(1e-3f, 1e-3f));
  return box.width > kCornerSpread * size.width && box.height > kCornerSpread * size.height;
}

/// The strongest corners of each part of the picture, then the strongest of all: one textured wall would tell nothing of turns and zooms.
std::vector<cv::Point2f> corners_of(const cv::Mat& gray) {
  constexpr int kAcross = 3;  // parts, and down
  std::vector<cv::Point2f> all, corners, rest;
  cv::goodFeaturesToTrack(gray, all, 0, kQuality, kSpacing);
  std::array<int, kAcross * kAcross> count{};
  for (const cv::Point2f& p : all) {
    int& here = count[static_cast<int>(p.y) * kAcross / gray.rows * kAcross + static_cast<int>(p.x) * kAcross / gray.cols];
    if (here < kCorners / static_cast<int>(count.size())) {
      ++here;
      corners.push_back(p);
    } else {
      rest.push_back(p);
    }
  }
  rest.resize(std::min(rest.size(), kCorners - corners.size()));
  corners.insert(corners.end(), rest.begin(), rest.end());
  return corners;
}

cv::Mat identity() { return (cv::Mat_<double>(2, 3) << 1, 0, 0, 0, 1, 0); }

}  // namespace

void Stabiliser::add(const cv::Mat& gray, bool usable) {
  if (usable && first_.empty()) {
    first_ = gray.clone();
    corners_ = corners_of(gray);
    places_ = corners_;
    shifts_.push_back(identity());
    return;
  }
  cv::Mat shift = shifts_.empty() ? identity() : shifts_.back();
  if (usable && static_cast<int>(corners_.size()) >= kFewestCorners) {
    ++tried_;
    const cv::Mat found = register_frame(gray);
    if (found.empty()) ++lost_; else shift = found;
    if (!found.empty()) {
      cv::Mat moved, mask(gray.size(), CV_8U, cv::Scalar(255)), inside;
      cv::warpAffine(gray, moved, shift, gray.size());
      cv::warpAffine(mask, inside, shift, gray.size(), cv::INTER_NEAREST);
      before_ += cv::norm(gray, first_, cv::NORM_L1, inside);
      after_ += cv::norm(moved, first_, cv::NORM_L1, inside);
    }
  }
  shifts_.push_back(shift);
}

cv::Mat Stabiliser::register_frame(const cv::Mat& gray) {
  std::vector<cv::Point2f> now = places_, from, to;
  std::vector<unsigned char> found, inlier;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(first_, gray, corners_, now, found, error, {15, 15}, 3, {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 20, 0.01},
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (found[i]) {
      from.push_back(now[i]);
      to.push_back(corners_[i]);
    }
  if (static_cast<int>(from.size()) < kFewestCorners) return {};
  const cv::Mat shift = cv::estimateAffinePartial2D(from, to, inlier, cv::RANSAC, kInlier);
  const int count = static_cast<int>(std::count(inlier.begin(), inlier.end(), 1));
  if (shift.empty() || count < kFewestCorners || count < kAgreeing * static_cast<double>(corners_.size()) || !spread(to, inlier, gray.size())) return {};
  cv::Mat back;
  cv::invertAffineTransform(shift, back);
  cv::transform(corners_, places_, back);
  return shift;
}

Stabiliser::Motion Stabiliser::finish(double scale) const {
  Motion motion;
  if (first_.empty() || tried_ == 0) return motion;
  motion.lost = static_cast<double>(lost_) / tried_;
  double largest = 0.0;
  for (const cv::Mat& m : shifts_) largest = std::max(largest, largest_move(m, first_.size()));
  if (largest < kStill || after_ > kGain * before_) return motion;
  motion.largest = scale * largest;
  for (const cv::Mat& m : shifts_) {
    // (p + ½) / scale − ½ are the small picture's pixels.
    cv::Mat full = m.clone();
    for (int r = 0; r < 2; ++r) {
      const double half = 0.5 * (scale - 1.0);
      full.at<double>(r, 2) = scale * m.at<double>(r, 2) + half - half * (m.at<double>(r, 0) + m.at<double>(r, 1));
    }
    motion.shift.push_back(full);
  }
  return motion;
}

}  // namespace unseen::collision
