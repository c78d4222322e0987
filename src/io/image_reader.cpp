// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "io/image.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"
#include "unseen/core/quantile.h"

namespace unseen::io {
namespace {

constexpr double kMostlyDark = 0.7;   // of the pixels
constexpr double kBroad = 0.015;      // of the picture's shorter side: 3 mm of A4
constexpr int kLeastBroad = 12;       // pixels
constexpr double kMuch = 0.3, kAll = 0.99;  // of the dark pixels
constexpr double kFaint = 0.6, kManyFaint = 0.35;  // of white; of the dark pixels: an anti-aliased line one pixel wide has half as many
constexpr double kPaper = 0.9;        // of the pixels are no brighter than paper, but for glare;
constexpr double kBlack = 0.25, kGrey = 0.75;  // of white: what is darker is no paper; darker paper is a photograph's
constexpr double kRim = 1.5;          // pixels, of an area's outline

/// Brightness of each pixel in [0,1], over white where the image is transparent.
cv::Mat brightness(cv::Mat image) {
  const double white = image.depth() == CV_16U ? 65535.0 : 255.0;
  cv::Mat grey, alpha;
  if (image.channels() == 4) {
    cv::extractChannel(image, alpha, 3);
    cv::cvtColor(image, grey, cv::COLOR_BGRA2GRAY);
  } else if (image.channels() == 3) {
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  } else {
    cv::extractChannel(image, grey, 0);
    if (image.channels() == 2) cv::extractChannel(image, alpha, 1);
  }
  grey.convertTo(grey, CV_32F, 1.0 / white);
  if (alpha.empty()) return grey;
  alpha.convertTo(alpha, CV_32F, 1.0 / white);
  return grey.mul(alpha) + (1.0 - alpha);
}

/// About a million of the pixels, or all: those of a raster.
std::vector<float> sample_of(const cv::Mat& grey) {
  constexpr double kTelling = 1e6;
  const int every = 1 + static_cast<int>(std::sqrt(static_cast<double>(grey.total()) / kTelling));
  std::vector<float> values;
  for (int row = 0; row < grey.rows; row += every)
    for (int column = 0; column < grey.cols; column += every) values.push_back(grey.at<float>(row, column));
  return values;
}

/// What counts as white: in photographs paper is grey.
double white_of(const cv::Mat& grey) {
  const double paper = quantile(sample_of(grey), kPaper);
  return paper < kBlack ? 1.0 : std::min(1.0, paper / kGrey);
}

/// Width (pixels) from which what is dark is an area, and no line.
int broad_in(const cv::Mat& picture) { return std::max(kLeastBroad, static_cast<int>(kBroad * std::min(picture.rows, picture.cols))); }

/// The insides of broad dark areas, as walls that are filled: 255 where they are. Lines go along their outlines.
cv::Mat insides(const cv::Mat& dark) {
  cv::Mat found = cv::Mat::zeros(dark.size(), CV_8U), squares, framed, framed_squares, depth, from_core;
  const int broad = broad_in(dark), square = static_cast<int>(std::sqrt(0.5) * broad);
  const double half = 0.5 * broad;
  // A disc has a square within it: where there is none, as in most drawings, distances need not be known. A line along the border is no area.
  cv::erode(dark, squares, cv::Mat::ones(square, square, CV_8U), {-1, -1}, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  if (cv::countNonZero(squares) == 0 || cv::countNonZero(~dark) == 0) return found;
  const cv::Rect around = cv::boundingRect(squares) + cv::Size(4 * broad, 4 * broad) - cv::Point(broad, broad);  // in the framed picture
  cv::copyMakeBorder(dark, framed, broad, broad, broad, broad, cv::BORDER_REPLICATE);  // what leaves the picture goes on
  cv::copyMakeBorder(squares, framed_squares, broad, broad, broad, broad, cv::BORDER_CONSTANT, cv::Scalar(0));
  const cv::Rect picture(broad, broad, dark.cols, dark.rows), part = around & cv::Rect({}, framed.size()), shown = part & picture;
  cv::distanceTransform(framed(part), depth, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::distanceTransform(~((depth > half) & framed_squares(part)), from_core, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const cv::Mat inside = (from_core <= std::sqrt(2.0) * half) & (depth > kRim);  // as far as into corners
  inside(shown - part.tl()).copyTo(found(shown - picture.tl()));
  return found;
}

bool is_mostly_dark(const cv::Mat& grey, double threshold) {
  return static_cast<double>(cv::countNonZero(grey < threshold)) > kMostlyDark * static_cast<double>(grey.total());
}

/// Whether the pixels far from the median are the lighter ones, by the third moment: light lines on a dark ground.
bool has_light_lines(const cv::Mat& grey) {
  const std::vector<float> values = sample_of(grey);
  const double middle = quantile(values, 0.5);
  return std::accumulate(values.begin(), values.end(), 0.0, [&](double sum, float v) { return sum + std::pow(v - middle, 3); }) > 0.0;
}

/// Broad dark areas that touch the picture's border, as a scanner's lid or a table around the sheet leaves them, if they are much of what is dark: 255 where
/// they are. Walls are narrower.
cv::Mat surroundings(const cv::Mat& dark) {
  const int broad = broad_in(dark);
  cv::Mat outside = cv::Mat::zeros(dark.size(), CV_8U);
  int at_border = 0;
  for (const cv::Mat& side : {dark.row(0), dark.row(dark.rows - 1), dark.col(0), dark.col(dark.cols - 1)}) at_border += cv::countNonZero(side);
  if (at_border < broad) return outside;
  cv::Mat framed, areas, labels, stats, centers;
  cv::copyMakeBorder(dark, framed, broad, broad, broad, broad, cv::BORDER_REPLICATE);  // what leaves the picture goes on
  cv::morphologyEx(framed, areas, cv::MORPH_OPEN, cv::Mat::ones(broad, broad, CV_8U));
  const int count = cv::connectedComponentsWithStats(areas(cv::Rect(broad, broad, dark.cols, dark.rows)), labels, stats, centers);
  std::vector<std::uint8_t> mark(static_cast<std::size_t>(count), 0);
  for (int k = 1; k < count; ++k) {
    const cv::Rect box(stats.at<int>(k, cv::CC_STAT_LEFT), stats.at<int>(k, cv::CC_STAT_TOP), stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
    if (box.x == 0 || box.y == 0 || box.br().x == dark.cols || box.br().y == dark.rows) mark[static_cast<std::size_t>(k)] = 255;
  }
  std::transform(labels.begin<int>(), labels.end<int>(), outside.begin<std::uint8_t>(), [&](int label) { return mark[static_cast<std::size_t>(label)]; });
  const double share = static_cast<double>(cv::countNonZero(outside)) / std::max(1, cv::countNonZero(dark));
  if (share < kMuch || share > kAll) return cv::Mat::zeros(dark.size(), CV_8U);
  cv::dilate(outside, outside, cv::Mat::ones(5, 5, CV_8U));  // with its blurred rim
  return outside;
}

}  // namespace

std::unique_ptr<PointSource> open_image(const Input& input) {
  const double share = input.options.threshold;
  if (!(share >= 0.0 && share <= 1.0)) throw InputError("read options", "threshold", std::to_string(share), "a number 0…1");
  cv::Mat picture = decode_image(input.view(), input.name);
  const bool grey_16 = picture.type() == CV_16UC1;
  cv::Mat grey = brightness(std::move(picture));
  const bool mostly_dark = is_mostly_dark(grey, share), inverted = mostly_dark && cv::countNonZero(grey >= share) > 0 && has_light_lines(grey);
  if (inverted) grey = 1.0 - grey;
  const double white = white_of(grey), threshold = share * white;
  const cv::Mat dark = grey < threshold, outside = surroundings(dark), inside = insides(dark & ~outside), left_out = outside | inside;
  PointCloud cloud;
  std::size_t faint = 0;
  for (int row = 0; row < grey.rows; ++row)
    for (int column = 0; column < grey.cols; ++column) {
      if (left_out.at<std::uint8_t>(row, column) != 0) continue;
      const double value = grey.at<float>(row, column);
      if (value < threshold) cloud.positions.emplace_back(column, grey.rows - 1 - row, 0.0);
      faint += value >= threshold && value < kFaint;
    }
  if (cloud.size() == 0)
    throw InputError(input.name, "pixels", fmt::format("none darker than {:.2g} of white", threshold), "dark pixels (--threshold says how dark)");
  const bool gaps = white == 1.0 &&  // grey paper is grey all over
                    static_cast<double>(faint) > kManyFaint * static_cast<double>(cloud.size());
  SourceInfo info;
  info.name = input.name;
  info.two_dimensional = true;
  info.notes.push_back(count_of(cloud.size(), "dark pixel") + " of " + std::to_string(grey.cols) + " x " +
                       std::to_string(grey.rows));
  if (grey_16 && mostly_dark)
    info.notes.push_back("16 bits a pixel, and mostly dark: a depth image is no drawing; unseen cuboids takes it, or a folder of frames with poses");
  if (inverted) info.notes.push_back("most of the picture is dark: read as light lines on a dark ground");
  if (cv::countNonZero(outside) > 0) info.notes.push_back("broad dark areas at the picture's border left out");
  if (cv::countNonZero(inside) > 0) info.notes.push_back("dark areas broader than " + std::to_string(broad_in(grey)) + " pixels are outlined: their lines follow the edges");
  if (gaps)
    info.notes.push_back(count_of(faint, "grey pixel") + " left out: thin lines may have gaps; --threshold " + fmt::format("{}", kFaint) + " takes them too");
  return std::make_unique<OwnedCloudSource>(std::move(cloud), std::move(info));
}

}  // namespace unseen::io
