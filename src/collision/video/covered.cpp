// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/covered.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/linear.h"

namespace unseen::collision {
namespace {

constexpr double kAcross = 3.0;       // px from the outline, inwards and outwards, where its two sides are compared
constexpr int kFewestFrames = 6;      // that something moves at the inner side, and in which it ends there
constexpr double kNever = 0.05;       // the share of them in which it does at the outer
constexpr double kEdge = 18.0;        // grey levels between the background's two sides
constexpr int kBreak = 2;             // points of the outline, in a row, that may be off the edge
constexpr double kLongChord = 0.35;   // of the bounding circle's diameter: what so many frames end at covers,
constexpr double kShortChord = 0.12;  // and there what is shorter too; less hides next to nothing
constexpr double kStraight = 1.0;     // px, standard deviation about a line
constexpr double kSmallestCircle = 25.0;    // px, of the bounding circle: too small to tell

/// How often each pixel of a decoded frame is moving, in frames.
cv::Mat count_movers(const Footage& footage) {
  cv::Mat count = cv::Mat::zeros(footage.height, footage.width, CV_16U);
  for (const auto& frame : footage.regions)
    for (const Region& r : frame)
      if (!r.shadow) cv::add(count(r.box), 1, count(r.box), r.mask);
  return count;
}

/// Standard deviation of points about their line.
double width_of(const std::vector<Vec2>& points) {
  Vec2 mean = Vec2::Zero();
  for (const Vec2& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Vec2& p : points) spread += (p - mean) * (p - mean).transpose() / static_cast<double>(points.size());
  return std::sqrt(std::max(0.0, symmetric_eigen(spread).values[0]));
}

struct OutlinePoint {
  Vec2 inner, outer;  ///< on both sides of it, decoded pixels
};

std::vector<OutlinePoint> outline_of(const Region& region) {
  constexpr int kMargin = 4;
  cv::Mat padded, smooth, dx, dy;
  cv::copyMakeBorder(region.mask, padded, kMargin, kMargin, kMargin, kMargin, cv::BORDER_CONSTANT, cv::Scalar(0));
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(padded, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::GaussianBlur(padded, smooth, {7, 7}, 0);
  cv::Sobel(smooth, dx, CV_32F, 1, 0);
  cv::Sobel(smooth, dy, CV_32F, 0, 1);
  std::vector<OutlinePoint> points;
  for (const auto& outline : outlines)
    for (const cv::Point& p : outline) {
      const Vec2 inwards(dx.at<float>(p), dy.at<float>(p));
      if (inwards.norm() < 1e-3) continue;
      const Vec2 at(p.x - kMargin + region.box.x, p.y - kMargin + region.box.y), step = kAcross * inwards.normalized();
      points.push_back({at + step, at - step});
    }
  return points;
}

cv::Point pixel_of(const Vec2& p) { return {static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y()))}; }

/// Whether the background differs between two of its pixels.
bool differs(const cv::Mat& picture, cv::Point a, cv::Point b) {
  const cv::Vec3b &x = picture.at<cv::Vec3b>(a), &y = picture.at<cv::Vec3b>(b);
  int most = 0;
  for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(x[c] - y[c]));
  return most >= kEdge;
}

/// Tells the outlines that end at something before the scene.
class Edges {
 public:
  Edges(const Background& background, cv::Point corner, int scale, const Footage& footage)
      : picture_(background.picture), corner_(corner.x, corner.y), scale_(scale), movers_(count_movers(footage)) {}

  /// A straight run of the outline along an edge of the background, with nothing beyond; empty if there is none of some length.
  std::vector<cv::Point> run_of(const Region& region) const {
    const std::vector<OutlinePoint> outline = outline_of(region);
    std::vector<Vec2> run;
    std::vector<cv::Point> longest;
    int off = 0;
    for (std::size_t i = 0; i < 2 * outline.size() && run.size() < outline.size(); ++i) {  // twice around: a run may pass the first point
      const OutlinePoint& p = outline[i % outline.size()];
      off = on_edge(p) ? 0 : off + 1;
      if (off > kBreak) run.clear();
      if (off > 0) continue;
      run.push_back(p.inner);
      if (run.size() <= longest.size() || static_cast<double>(run.size()) <= kShortChord * region.circle || width_of(run) >= kStraight) continue;
      longest.clear();
      for (const Vec2& q : run) longest.push_back(pixel_of(q));
    }
    return longest;
  }

 private:
  cv::Point in_background(const Vec2& p) const { return pixel_of((p - corner_) / scale_ - Vec2::Constant(0.5 - 0.5 / scale_)); }

  bool on_edge(const OutlinePoint& p) const {
    const cv::Rect frame({0, 0}, movers_.size()), view({0, 0}, picture_.size());
    const cv::Point inner = pixel_of(p.inner), outer = pixel_of(p.outer), behind = in_background(p.inner), before = in_background(p.outer);
    if (!frame.contains(inner) || !frame.contains(outer) || !view.contains(behind) || !view.contains(before)) return false;
    const double moving = movers_.at<unsigned short>(inner);
    return moving >= kFewestFrames && movers_.at<unsigned short>(outer) <= kNever * moving && differs(picture_, behind, before);
  }

  cv::Mat picture_;
  Vec2 corner_;
  int scale_;
  cv::Mat movers_;
};

}  // namespace

void mark_covered(const Background& background, cv::Point corner, int scale, Footage& footage, const Context& context) {
  if (!footage.shift.empty()) return;
  const Edges edges(background, corner, scale, footage);
  std::vector<std::vector<std::vector<cv::Point>>> runs(footage.regions.size());  // by frame and region
  parallel_blocks(context, runs.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      for (const Region& r : footage.regions[k])
        runs[k].push_back(r.shadow || r.circle < kSmallestCircle ? std::vector<cv::Point>() : edges.run_of(r));
  });
  const auto is_long = [&](std::size_t k, std::size_t i) { return static_cast<double>(runs[k][i].size()) > kLongChord * footage.regions[k][i].circle; };
  cv::Mat ends = cv::Mat::zeros(footage.height, footage.width, CV_16U), spread;  // in how many frames a long run passes
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (std::size_t i = 0; i < runs[k].size(); ++i)
      if (is_long(k, i))
        for (const cv::Point& p : runs[k][i]) ++ends.at<unsigned short>(p);
  cv::dilate(ends, spread, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (std::size_t i = 0; i < runs[k].size(); ++i) {
      const auto often = std::count_if(runs[k][i].begin(), runs[k][i].end(), [&](const cv::Point& p) { return spread.at<unsigned short>(p) >= kFewestFrames; });
      footage.regions[k][i].clipped = often > 0 && 2 * static_cast<std::size_t>(often) >= runs[k][i].size();
      footage.regions[k][i].covered = footage.regions[k][i].clipped && is_long(k, i);
    }
}

}  // namespace unseen::collision
