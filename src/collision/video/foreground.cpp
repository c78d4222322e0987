// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/foreground.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "collision/video/mask_shape.h"
#include "collision/video/shadow.h"
#include "collision/video/worst_channel.h"

namespace unseen::collision {
namespace {

constexpr double kLow = 3.5, kLeastLow = 9.0;  // σ and grey levels
constexpr double kHigh = 2.0;                  // times the low threshold: what a part must reach somewhere
constexpr double kSeedShare = 0.04;            // of a part's pixels, and
constexpr int kFewestSeeds = 5;                // pixels above the high threshold
constexpr double kSmallestRegion = 20.0;             // px
constexpr double kSmallestShare = 1e-5;        // of the picture
constexpr double kLargestShare = 0.3;           // of the picture that a part's box may fill to be looked at more closely
constexpr double kCore = 0.15;                 // share of a part that must be left when its shadow is cut off
constexpr double kTail = 0.3;                  // of the radius of the largest disc in a body: what is thinner hangs on it
constexpr double kCorner = 1.5;                // of that, how far corners reach beyond it
constexpr double kLeastTail = 5.0;             // px, radius of a body at least
constexpr double kFaint = 0.35;                // of the body's contrast
constexpr double kHalf = 0.45;                 // of the local contrast
constexpr int kContrastReach = 9;              // px, window of the local contrast

/// Largest difference of the three channels, smoothed.
cv::Mat difference(const cv::Mat& frame, const cv::Mat& background) {
  cv::Mat worst = worst_difference(frame, background);
  cv::blur(worst, worst, {3, 3});
  return worst;
}

/// Low threshold of each pixel, grey levels.
cv::Mat threshold_of(const Background& background, double edge_slack) {
  cv::Mat low;
  background.noise.convertTo(low, CV_32F, kLow);
  low = cv::max(low, kLeastLow);
  if (edge_slack > 0.0) {
    cv::Mat gray, gradient;
    cv::cvtColor(background.picture, gray, cv::COLOR_BGR2GRAY);
    cv::morphologyEx(gray, gradient, cv::MORPH_GRADIENT, cv::Mat());
    cv::Mat slack;
    gradient.convertTo(slack, CV_32F, 0.5 * edge_slack);
    low += slack;
  }
  cv::Mat bytes;
  low.convertTo(bytes, CV_8U);
  return bytes;
}

/// Cuts off pixels near the outline whose contrast is below half of what is next to them: they are more background than object.
void sharpen_outline(cv::Mat& mask, const cv::Mat& difference) {
  cv::Mat contrast, inside, limit;
  cv::Mat masked = cv::Mat::zeros(difference.size(), CV_8U);
  difference.copyTo(masked, mask);
  cv::dilate(masked, contrast, disc(kContrastReach));
  cv::erode(mask, inside, disc(7), {-1, -1}, 1, cv::BORDER_CONSTANT, cv::Scalar(255));
  contrast.convertTo(limit, CV_8U, kHalf);
  cv::Mat weak = difference < limit;
  weak &= ~inside;
  mask.setTo(0, weak);
}

/// Cuts off what hangs on the body, thinner than it by far, and hardly differs from the background: the rim of a soft shadow, what compression leaves.
void cut_faint_tails(cv::Mat& mask, const cv::Mat& difference) {
  cv::Mat inside, from_core, labels, framed;
  cv::copyMakeBorder(mask, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  cv::distanceTransform(framed, inside, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  double radius = 0.0;
  cv::minMaxLoc(inside, nullptr, &radius);
  if (radius < kLeastTail) return;
  cv::distanceTransform(inside <= kTail * radius, from_core, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const cv::Mat body = mask & (from_core(cv::Rect({1, 1}, mask.size())) <= kCorner * kTail * radius + 1.0), tails = mask & ~body;
  const double faint = kFaint * cv::mean(difference, body)[0];
  const int count = cv::connectedComponents(tails, labels, 8);
  std::vector<double> excess(static_cast<std::size_t>(count), 0.0);  // of a tail's contrast over what is faint, summed
  const auto for_tails = [&](const auto& visit) {
    for (int y = 0; y < mask.rows; ++y)
      for (int x = 0; x < mask.cols; ++x)
        if (const int tail = labels.at<int>(y, x); tail > 0) visit(excess[static_cast<std::size_t>(tail)], y, x);
  };
  for_tails([&](double& sum, int y, int x) { sum += difference.at<unsigned char>(y, x) - faint; });
  for_tails([&](double& sum, int y, int x) {
    if (sum < 0.0) mask.at<unsigned char>(y, x) = 0;
  });
}

/// Fills holes and drops everything but the largest piece.
bool largest_piece(cv::Mat& mask) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  if (outlines.empty()) return false;
  const auto largest = std::max_element(outlines.begin(), outlines.end(),
                                        [](const auto& a, const auto& b) { return cv::contourArea(a) < cv::contourArea(b); });
  mask.setTo(0);
  cv::drawContours(mask, outlines, static_cast<int>(largest - outlines.begin()), cv::Scalar(255), cv::FILLED);
  return true;
}

cv::Rect padded(cv::Rect box, int by, cv::Size size) {
  return cv::Rect(box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by) & cv::Rect({0, 0}, size);
}

/// The part without its shadow and blur; false if nothing of it is left.
bool refine(const cv::Mat& frame, const Background& background, const cv::Mat& d, Part& part) {
  const cv::Mat contrast = d(part.box);
  const Background behind{background.picture(part.box), background.noise(part.box)};
  const Shade shade = find_shade(frame(part.box), behind, contrast, part.mask);
  const int area = cv::countNonZero(part.mask);
  part.shadow = shade.whole;
  part.sign = shade.sign;
  if (!part.shadow) {
    cv::Mat lit = part.mask & ~shade.mask;
    const cv::Mat element = disc(3);
    cv::morphologyEx(lit, lit, cv::MORPH_OPEN, element, {-1, -1}, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
    cv::morphologyEx(lit, lit, cv::MORPH_CLOSE, disc(7));
    if (cv::countNonZero(lit) > kCore * area) {
      if (shade.sign == ShadowSign::light) part.dimmed = static_cast<double>(cv::countNonZero(part.mask & shade.mask)) / area;
      part.mask = lit;
    }
  }
  sharpen_outline(part.mask, contrast);
  cut_faint_tails(part.mask, contrast);
  return largest_piece(part.mask);
}

struct Moments {
  double area, length, width;  ///< px², px: variances along the principal axes
  Vec2 mean;
};

Moments moments_of(const cv::Mat& mask) {
  const cv::Moments m = cv::moments(mask, true);
  const double xx = m.mu20 / m.m00 + 1.0 / 12.0, yy = m.mu02 / m.m00 + 1.0 / 12.0, xy = m.mu11 / m.m00;
  const double middle = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
  return {m.m00, middle + half, middle - half, {m.m10 / m.m00, m.m01 / m.m00}};
}

/// Width of the stadium (a disc swept along a line: a ball with motion blur) of the same area and variance across:
/// σ² A = A r² / 3 − π r⁴ / 12.
double stadium_width(double area, double across) {
  const double root = area * area / 9.0 - kPi * across * area / 3.0;
  const double square = (area / 3.0 - std::sqrt(std::max(root, 0.0))) * 6.0 / kPi;
  return 2.0 * std::sqrt(std::max(square, 0.0));
}

}  // namespace

std::vector<Part> find_parts(const cv::Mat& frame, const Background& background, double edge_slack) {
  const cv::Mat d = difference(frame, background.picture), low = threshold_of(background, edge_slack);
  cv::Mat above = d > low, high, labels, stats, centers;
  cv::morphologyEx(above, above, cv::MORPH_CLOSE, disc(3));
  low.convertTo(high, CV_8U, kHigh);
  const cv::Mat seeds = d > high;
  const int count = cv::connectedComponentsWithStats(above, labels, stats, centers, 8, CV_32S);
  const double smallest = std::max(kSmallestRegion, kSmallestShare * static_cast<double>(frame.total()));
  std::vector<Part> parts;
  for (int i = 1; i < count; ++i) {
    const int area = stats.at<int>(i, cv::CC_STAT_AREA);
    if (area < smallest) continue;
    const cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP), stats.at<int>(i, cv::CC_STAT_WIDTH),
                       stats.at<int>(i, cv::CC_STAT_HEIGHT));
    Part part{padded(box, 6, frame.size()), {}, false, {}};
    part.mask = labels(part.box) == i;
    if (cv::countNonZero(seeds(part.box) & part.mask) < std::max<double>(kFewestSeeds, kSeedShare * area)) continue;
    if (box.area() > kLargestShare * static_cast<double>(frame.total())) {  // no body: a person, or another light
      parts.push_back(part);
      continue;
    }
    if (refine(frame, background, d, part) && cv::countNonZero(part.mask) >= 0.6 * smallest) parts.push_back(part);
  }
  return parts;
}

Region describe_part(const Part& part, const cv::Mat& frame, int index, int scale, cv::Point offset) {
  Region region;
  const Moments m = moments_of(part.mask);
  const double half = 0.5 * (scale - 1);
  region.frame = index;
  region.centroid = scale * (m.mean + Vec2(part.box.x, part.box.y)) + Vec2(half + offset.x, half + offset.y);
  region.area = scale * scale * m.area;
  region.diameter = scale * stadium_width(m.area, m.width);
  std::vector<cv::Point> points, hull;
  cv::findNonZero(part.mask, points);
  cv::Point2f center;
  float radius = 0.0f;
  cv::convexHull(points, hull);
  cv::minEnclosingCircle(hull, center, radius);
  region.circle = scale * (2.0 * radius + 1.0);
  const cv::Rect tight = cv::boundingRect(points);
  region.box = {scale * (tight.x + part.box.x) + offset.x, scale * (tight.y + part.box.y) + offset.y, scale * tight.width, scale * tight.height};
  cv::resize(part.mask(tight), region.mask, region.box.size(), 0, 0, cv::INTER_NEAREST);
  const cv::Scalar mean = cv::mean(frame(part.box), part.mask);
  region.color = {mean[2], mean[1], mean[0]};
  const cv::Rect whole = tight + part.box.tl();
  region.at_border = whole.x <= 1 || whole.y <= 1 || whole.br().x >= frame.cols - 1 || whole.br().y >= frame.rows - 1;
  region.shadow = part.shadow;
  region.sign = part.sign;
  region.dimmed = part.dimmed;
  return region;
}

}  // namespace unseen::collision
