// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/resting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "collision/video/mask_shape.h"
#include "collision/video/other_colors.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr double kLike = 25.0;      // grey levels off what is around: still its colour
constexpr double kDarkest = 8.0, kShade = 0.1;  // grey levels, and share of the light: darker than that is in shadow
constexpr double kUnlike = 10.0;    // grey levels off it, beside what is farther off: of the same body or its shadow
constexpr double kBeside = 1.0;     // so far beside it, in square roots of its area
constexpr double kRevealed = 0.25;  // of a part's border: so much of what is behind it has to be seen
constexpr double kAnother = 60.0;   // grey levels off the typical colour of a thing: none of its own
constexpr double kSmoother = 0.6;   // what is behind: its step at the outline, as a share of that of the median
constexpr int kSmallest = 30;       // px
constexpr int kMargin = 12;         // px, of what is looked at around a part
constexpr int kFilledFrom = 3;      // px, that a hole is filled from

/// Fills `hole` from around it inward, each pixel with the mean of what is known near it.
cv::Mat filled(const cv::Mat& picture, const cv::Mat& hole) {
  cv::Mat fill, known = ~hole, next;
  picture.convertTo(fill, CV_32FC3);
  std::vector<cv::Point> rim;
  for (;;) {
    cv::dilate(known, next, cv::Mat());
    cv::findNonZero(next & ~known, rim);
    if (rim.empty()) return fill;
    for (const cv::Point& at : rim) {
      const cv::Rect near = cv::Rect(at.x - kFilledFrom, at.y - kFilledFrom, 2 * kFilledFrom + 1, 2 * kFilledFrom + 1) & cv::Rect({0, 0}, picture.size());
      const cv::Scalar mean = cv::mean(fill(near), known(near));
      fill.at<cv::Vec3f>(at) = cv::Vec3f(static_cast<float>(mean[0]), static_cast<float>(mean[1]), static_cast<float>(mean[2]));
    }
    known = next.clone();
  }
}

/// Whether a colour may be the expected one, in no shadow.
bool is_like(const cv::Vec3b& color, const cv::Vec3f& expected) {
  for (int c = 0; c < 3; ++c)
    if (color[c] > expected[c] + kLike || color[c] < expected[c] - std::max<double>(kDarkest, kShade * expected[c])) return false;
  return true;
}

/// `hole` as it is filled from around it and its own blurred rim.
cv::Mat surroundings(const cv::Mat& picture, const cv::Mat& hole) {
  cv::Mat larger;
  cv::dilate(hole, larger, disc(5));
  return filled(picture, larger);
}

/// The colours around a hole, if they are often unlike the mean of what is near them: then that does not tell what is behind it, but is like some of them.
std::vector<cv::Vec3b> texture_around(const cv::Mat& picture, const cv::Mat& hole) {
  constexpr int kWindow = 15;         // px
  constexpr double kTextured = 0.03;  // of what is around
  constexpr std::size_t kEnough = 1000;
  cv::Mat ring, known, weight, sum, weights;
  cv::dilate(hole, ring, disc(2 * kMargin + 1));
  cv::Mat(~hole).convertTo(weight, CV_32F, 1.0 / 255.0);
  picture.convertTo(known, CV_32FC3);
  known.setTo(0, hole);
  cv::blur(known, sum, {kWindow, kWindow});
  cv::blur(weight, weights, {kWindow, kWindow});
  int unlike = 0;
  std::vector<cv::Vec3b> colors;
  for (int y = 0; y < hole.rows; ++y)
    for (int x = 0; x < hole.cols; ++x) {
      if (!ring.at<unsigned char>(y, x) || hole.at<unsigned char>(y, x)) continue;
      colors.push_back(picture.at<cv::Vec3b>(y, x));
      unlike += !is_like(colors.back(), sum.at<cv::Vec3f>(y, x) / weights.at<float>(y, x));
    }
  if (unlike <= kTextured * static_cast<double>(colors.size())) return {};
  const std::size_t step = 1 + colors.size() / kEnough;
  std::vector<cv::Vec3b> some;
  for (std::size_t i = 0; i < colors.size(); i += step) some.push_back(colors[i]);
  return some;
}

/// Whether more than a few of the colours are this one.
bool is_among(const std::vector<cv::Vec3b>& colors, const cv::Vec3b& color) {
  constexpr double kSame = 12.0, kFew = 0.01;  // grey levels, share
  const auto same = std::count_if(colors.begin(), colors.end(), [&](const cv::Vec3b& c) { return farthest(c, color) <= kSame; });
  return static_cast<double>(same) > kFew * static_cast<double>(colors.size());
}

/// Where the picture is unlike what is around all of `places`: where a body comes to rest beside one that was there before, the picture is right.
cv::Mat standing_out(const cv::Mat& picture, const cv::Mat& places) {
  const cv::Mat fill = surroundings(picture, places);
  cv::Mat out = cv::Mat::zeros(picture.size(), CV_8U);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      if (places.at<unsigned char>(y, x) && farthest(picture.at<cv::Vec3b>(y, x), fill.at<cv::Vec3f>(y, x)) > kLike) out.at<unsigned char>(y, x) = 255;
  return out;
}

/// A part with its shadow: what is beside it, unlike its surroundings, and was like them in other frames.
cv::Mat with_shadow(const cv::Mat& picture, const cv::Mat& part, const OtherColors& others, const cv::Point& corner, int reach) {
  cv::Mat distance, near, whole = part.clone();
  cv::distanceTransform(~part, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  near = (distance <= reach) & (others.count(cv::Rect(corner, part.size())) > 0);
  const cv::Mat fill = surroundings(picture, part | near);
  for (int y = 0; y < part.rows; ++y)
    for (int x = 0; x < part.cols; ++x) {
      if (!near.at<unsigned char>(y, x) || farthest(picture.at<cv::Vec3b>(y, x), fill.at<cv::Vec3f>(y, x)) <= kUnlike) continue;
      const std::vector<cv::Vec3b> colors = others.at(corner + cv::Point(x, y));
      if (std::any_of(colors.begin(), colors.end(), [&](const cv::Vec3b& c) { return is_like(c, fill.at<cv::Vec3f>(y, x)); })) whole.at<unsigned char>(y, x) = 255;
    }
  cv::morphologyEx(whole, whole, cv::MORPH_CLOSE, disc(5));
  cv::morphologyEx(whole, whole, cv::MORPH_OPEN, disc(5));
  return whole;
}

/// What lies behind a part.
struct Behind {
  cv::Mat picture;  ///< the other colour that is most like what is around it, if it may be that or is of a texture there; or else what is around it
  cv::Mat seen;     ///< 255 where it is such a colour
  cv::Mat own;      ///< 255 where the picture's own colour, which is not the thing's, may be that of a texture there, and is more like what is around it
};

Behind behind(const cv::Mat& picture, const cv::Mat& part, const cv::Vec3b& thing, const OtherColors& others, const cv::Point& corner) {
  const cv::Mat fill = surroundings(picture, part);
  const std::vector<cv::Vec3b> texture = texture_around(picture, part);
  Behind found{picture.clone(), cv::Mat::zeros(part.size(), CV_8U), cv::Mat::zeros(part.size(), CV_8U)};
  for (int y = 0; y < part.rows; ++y)
    for (int x = 0; x < part.cols; ++x) {
      if (!part.at<unsigned char>(y, x)) continue;
      const cv::Vec3f& expected = fill.at<cv::Vec3f>(y, x);
      const auto may_be_behind = [&](const cv::Vec3b& c) { return is_like(c, expected) || is_among(texture, c); };
      std::vector<cv::Vec3b> colors = others.at(corner + cv::Point(x, y));
      std::erase_if(colors, [&](const cv::Vec3b& c) { return !may_be_behind(c); });
      const auto nearest = std::min_element(colors.begin(), colors.end(), [&](const cv::Vec3b& a, const cv::Vec3b& b) { return farthest(a, expected) < farthest(b, expected); });
      const cv::Vec3b own = picture.at<cv::Vec3b>(y, x);
      found.picture.at<cv::Vec3b>(y, x) = nearest == colors.end() ? cv::Vec3b(expected) : *nearest;
      if (nearest != colors.end()) found.seen.at<unsigned char>(y, x) = 255;
      if (!texture.empty() && farthest(own, thing) > kAnother && may_be_behind(own) && (nearest == colors.end() || farthest(own, expected) <= farthest(*nearest, expected)))
        found.own.at<unsigned char>(y, x) = 255;
    }
  return found;
}

/// Channel by channel.
cv::Vec3b median_color(const cv::Mat& picture, const cv::Mat& part) {
  std::array<std::vector<unsigned char>, 3> values;
  for (int y = 0; y < part.rows; ++y)
    for (int x = 0; x < part.cols; ++x)
      for (int c = 0; c < 3 && part.at<unsigned char>(y, x); ++c) values[static_cast<std::size_t>(c)].push_back(picture.at<cv::Vec3b>(y, x)[c]);
  return {median(std::move(values[0])), median(std::move(values[1])), median(std::move(values[2]))};
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

void remove_resting(const std::vector<cv::Mat>& frames, const cv::Mat& noise, cv::Mat& picture, const Context& context) {
  const OtherColors others = other_colors(frames, noise, picture, context);
  cv::Mat came_or_went, labels, stats, centers;
  cv::morphologyEx(others.follow, came_or_went, cv::MORPH_CLOSE, disc(5));
  cv::morphologyEx(came_or_went, came_or_went, cv::MORPH_OPEN, disc(5));
  came_or_went = standing_out(picture, came_or_went);
  cv::morphologyEx(came_or_went, came_or_went, cv::MORPH_OPEN, disc(5));
  const int count = cv::connectedComponentsWithStats(came_or_went, labels, stats, centers, 8);
  for (int i = 1; i < count; ++i) {
    const int area = stats.at<int>(i, cv::CC_STAT_AREA), reach = cvRound(kBeside * std::sqrt(area)), margin = reach + kMargin;
    if (area < kSmallest) continue;
    context.check();
    const cv::Rect box = cv::Rect(stats.at<int>(i, cv::CC_STAT_LEFT) - margin, stats.at<int>(i, cv::CC_STAT_TOP) - margin,
                                  stats.at<int>(i, cv::CC_STAT_WIDTH) + 2 * margin, stats.at<int>(i, cv::CC_STAT_HEIGHT) + 2 * margin) &
                         cv::Rect({0, 0}, picture.size());
    const cv::Mat core = labels(box) == i, part = with_shadow(picture(box), core, others, box.tl(), reach);
    cv::Mat smaller, larger, largest;
    cv::erode(part, smaller, disc(5));
    cv::dilate(part, larger, disc(5));
    cv::dilate(larger, largest, disc(5));
    const cv::Mat inner = part & ~smaller, outer = largest & ~larger;
    const Behind second = behind(picture(box), larger, median_color(picture(box), core), others, box.tl());
    if (cv::countNonZero(inner & second.seen) < kRevealed * cv::countNonZero(inner)) continue;
    const double kept = step_at_outline(picture(box), picture(box), inner, outer), other = step_at_outline(second.picture, picture(box), inner, outer);
    if (other < kSmoother * kept) second.picture.copyTo(picture(box), larger & ~second.own);
  }
}

}  // namespace unseen::collision
