// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/lasting.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "collision/video/mask_shape.h"
#include "collision/video/worst_channel.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr double kLeastReach = 6.0;  // grey levels, and
constexpr double kReach = 4.0;       // times the picture's typical noise: as far as one colour goes
constexpr double kSettled = 0.75;    // share of the frames that agree with the median: the background beyond doubt
constexpr double kSpread = 0.1;      // of the clip, added to the spread in time of the frames that agree
constexpr int kThick = 5;            // px: less is no body
constexpr double kPlainer = 0.82, kRougher = 1.1;  // of the median's total variation
constexpr double kMoreAlike = 0.5;   // of how far the median is off what is around
constexpr int kOff = 6;              // grey levels: less is no ghost
constexpr double kFarOff = 12.0;      // the same, where a floor or its edges may drift
constexpr int kUnsteady = 6;         // grey levels of the deviation: less does not matter
constexpr int kPasses = 3;           // that something passes, at most: what flickers or sways departs more often
constexpr int kAround = 15;          // px, about a ghost, where bodies linger too
constexpr int kWide = 9;             // px: narrower edges of the background drift
constexpr double kClearly = 1.2;     // times the median's score
constexpr double kLit = 0.3;         // of the score of a colour that could be its shadow, which the lit one needs
constexpr double kShadowLeast = 0.25, kShadowMost = 0.95;  // of the light
constexpr double kShadowGray = 7.0;  // grey levels off the lit colour's tint

/// A pixel's colour in all frames.
struct Column {
  std::vector<unsigned char> blue, green, red;

  explicit Column(std::size_t size) : blue(size), green(size), red(size) {}
  void read(const std::vector<cv::Mat>& frames, int y, int x) {
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const auto* p = frames[k].ptr<unsigned char>(y) + 3 * x;
      blue[k] = p[0], green[k] = p[1], red[k] = p[2];
    }
  }
  cv::Vec3b at(std::size_t k) const { return {blue[k], green[k], red[k]}; }
};

/// Which frames agree with a colour: their number, how often others come between them, and their score by number and spread in time.
struct Agreement {
  std::vector<unsigned char> with;
  int count = 0, departures = 0;
  double score = 0;

  explicit Agreement(std::size_t size) : with(size) {}
  void find(const Column& column, const cv::Vec3b& color, int reach) {
    const std::size_t n = with.size();
    for (std::size_t k = 0; k < n; ++k)
      with[k] = static_cast<unsigned char>((std::abs(column.blue[k] - color[0]) <= reach) & (std::abs(column.green[k] - color[1]) <= reach) &
                                           (std::abs(column.red[k] - color[2]) <= reach));
    int sum = 0, squares = 0;
    count = departures = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const int i = static_cast<int>(k), w = with[k];
      count += w, sum += w * i, squares += w * i * i;
      departures += k > 0 && with[k - 1] && !w;
    }
    const double c = std::max(1, count), mean = sum / c;
    score = count * (kSpread + std::sqrt(std::max(0.0, squares / c - mean * mean)) / static_cast<double>(n));
  }
};

/// Whether `dark` could be `lit` with less light.
bool shadow_of(const cv::Vec3b& dark, const cv::Vec3b& lit) {
  const double share = dark.ddot(lit) / std::max(1.0, lit.ddot(lit));
  if (share < kShadowLeast || share > kShadowMost) return false;
  for (int c = 0; c < 3; ++c)
    if (std::abs(dark[c] - share * lit[c]) > kShadowGray) return false;
  return true;
}

/// Replaces `best` by the agreement with the highest score among the pixel's colours that `may`, if it is above `needed`.
template <class May>
bool take_best(const Column& column, int reach, double needed, May may, Agreement& best, Agreement& other) {
  bool taken = false;
  for (std::size_t k = 0; k < best.with.size(); ++k) {
    if (!may(column.at(k))) continue;
    other.find(column, column.at(k), reach);
    if (other.score <= needed) continue;
    needed = other.score;
    std::swap(best, other);
    taken = true;
  }
  return taken;
}

/// Mean colour of the frames that agree, and what the median absolute deviation from it is for normal noise.
void describe(const Column& column, const Agreement& agreement, cv::Vec3b& color, cv::Vec3b& deviation) {
  const std::vector<unsigned char>* channels[] = {&column.blue, &column.green, &column.red};
  for (int c = 0; c < 3; ++c) {
    double sum = 0.0, off = 0.0;
    for (std::size_t k = 0; k < agreement.with.size(); ++k) sum += agreement.with[k] * (*channels[c])[k];
    const double mean = sum / agreement.count;
    for (std::size_t k = 0; k < agreement.with.size(); ++k) off += agreement.with[k] * std::abs((*channels[c])[k] - mean);
    color[c] = cv::saturate_cast<unsigned char>(mean);
    deviation[c] = cv::saturate_cast<unsigned char>(0.845 * off / agreement.count);
  }
}

int typical(const cv::Mat& deviation) {
  std::vector<unsigned char> values;
  for (int y = 0; y < deviation.rows; y += 5)
    for (int x = 0; x < 3 * deviation.cols; x += 7) values.push_back(deviation.ptr<unsigned char>(y)[x]);
  return median(std::move(values));
}

/// Sum of the steps between neighbouring pixels.
double total_variation(const cv::Mat& noisy, const cv::Mat& mask) {
  cv::Mat picture;
  cv::blur(noisy, picture, {kThick, kThick});  // few frames agree on a ghost's place, and leave more noise than the median
  double sum = 0.0;
  for (int y = 0; y + 1 < picture.rows; ++y)
    for (int x = 0; x + 1 < picture.cols; ++x) {
      if (!mask.at<unsigned char>(y, x)) continue;
      const cv::Vec3i here = picture.at<cv::Vec3b>(y, x), right = picture.at<cv::Vec3b>(y, x + 1), below = picture.at<cv::Vec3b>(y + 1, x);
      sum += cv::norm(right - here) + cv::norm(below - here);
    }
  return sum;
}

/// How far the mean colour of a patch is off that of what is around it, grey levels.
double off_around(const cv::Mat& picture, const cv::Mat& patch, const cv::Mat& around) {
  const cv::Scalar own = cv::mean(picture, patch), other = cv::mean(picture, around);
  return std::max({std::abs(own[0] - other[0]), std::abs(own[1] - other[1]), std::abs(own[2] - other[2])});
}

/// Where the median differs from the lasting colours, in patches that these make plainer, or, hardly rougher, clearly more like what is
/// around them, as where there is texture: a ghost goes. Edges of the background that shake or drift are unsettled too, and get rougher.
cv::Mat ghosts(const cv::Mat& lasting, const cv::Mat& median) {
  const cv::Mat element = disc(kThick);
  cv::Mat labels, stats, centers, ghost = worst_difference(lasting, median) > kOff;
  cv::morphologyEx(ghost, ghost, cv::MORPH_CLOSE, element);
  cv::morphologyEx(ghost, ghost, cv::MORPH_OPEN, element);
  cv::Mat mended = median.clone();
  lasting.copyTo(mended, ghost);
  const cv::Mat settled = ~ghost;
  const int count = cv::connectedComponentsWithStats(ghost, labels, stats, centers, 8);
  for (int i = 1; i < count; ++i) {
    cv::Rect box(stats.at<int>(i, cv::CC_STAT_LEFT) - kAround, stats.at<int>(i, cv::CC_STAT_TOP) - kAround,
                 stats.at<int>(i, cv::CC_STAT_WIDTH) + 2 * kAround, stats.at<int>(i, cv::CC_STAT_HEIGHT) + 2 * kAround);
    box &= cv::Rect({0, 0}, median.size());
    const cv::Mat patch = labels(box) == i;
    cv::Mat with_rim, around;
    cv::dilate(patch, with_rim, element);
    cv::dilate(patch, around, disc(2 * kAround + 1));
    around &= ~with_rim & settled(box);
    const double rough = total_variation(mended(box), with_rim) / std::max(1.0, total_variation(median(box), with_rim));
    const bool plainer = rough <= kPlainer;
    const double off = off_around(median(box), patch, around);
    const bool more_alike = rough < kRougher && cv::countNonZero(around) > 0 && off > kFarOff && off_around(mended(box), patch, around) < kMoreAlike * off;
    if (!plainer && !more_alike) ghost(box).setTo(0, patch);
  }
  return ghost;
}

}  // namespace

void restore_lasting(const std::vector<cv::Mat>& frames, cv::Mat& picture, cv::Mat& deviation, const Context& context) {
  cv::Mat lasting = picture.clone(), spread = deviation.clone();
  cv::Mat covered = cv::Mat::zeros(picture.size(), CV_8U), passed = covered.clone();
  const std::size_t count = frames.size();
  const int reach = static_cast<int>(std::max(kLeastReach, kReach * 1.4826 * typical(deviation)));
  parallel_blocks(context, static_cast<std::size_t>(picture.rows), 16, [&](std::size_t begin, std::size_t end) {
    Column column(count);
    Agreement best(count), other(count);
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < picture.cols; ++x) {
        column.read(frames, y, x);
        cv::Vec3b& color = lasting.at<cv::Vec3b>(y, x);
        best.find(column, color, reach);
        if (best.count >= kSettled * static_cast<double>(count)) continue;
        take_best(column, reach, kClearly * best.score, [](const cv::Vec3b&) { return true; }, best, other);
        if (best.count == 0) continue;
        covered.at<unsigned char>(y, x) = 255;
        if (best.departures <= kPasses) passed.at<unsigned char>(y, x) = 255;
        describe(column, best, color, spread.at<cv::Vec3b>(y, x));
        const cv::Vec3b dark = color;
        if (take_best(column, reach, kLit * best.score, [&](const cv::Vec3b& c) { return shadow_of(dark, c); }, best, other))
          describe(column, best, color, spread.at<cv::Vec3b>(y, x));
      }
  });
  const cv::Mat around = disc(kAround);
  cv::Mat near, wide;
  cv::dilate(ghosts(lasting, picture), near, around);
  passed &= worst_difference(lasting, picture) <= kOff;
  cv::morphologyEx(passed & (worst_channel(deviation) > kUnsteady), wide, cv::MORPH_OPEN, disc(kWide));
  cv::dilate(wide, wide, around);
  spread.copyTo(deviation, passed & wide);
  covered &= near;
  lasting.copyTo(picture, covered);
  spread.copyTo(deviation, covered);
}

}  // namespace unseen::collision
