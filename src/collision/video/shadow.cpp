// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "collision/video/mask_shape.h"
#include "collision/video/worst_channel.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr double kLeast = 0.25, kMost = 0.97;  // of the background's light
constexpr double kSigmas = 3.0, kGray = 7.0;   // off the background's colour
constexpr double kWeak = 0.5;                  // of a part's contrast: what is weaker is a shadow already if
constexpr double kWeakGray = 0.1;              // of a pixel's brightness off the background's colour, where that is
constexpr int kBright = 200;                   // grey levels or brighter: there sensors begin to clip
constexpr double kSide = 0.5;                  // of the rest: more is no side of it
constexpr double kWithin = 0.5;                // share of a shadow inside the hull of what is left: it is a shaded side of the body
constexpr double kConvex = 0.955, kConvexPiece = 0.88;  // of the hull: body with a flat side in its shade; the side, which is
constexpr double kLeastSide = 0.2;             // of the rest, at least: less is a shadow along a side;
constexpr double kMostSide = 1.5;              // and at most
constexpr double kWhole = 0.85;                // share of a part that makes it a shadow
constexpr double kRound = 0.88;                // share of its bounding circle: a part like that is a ball with its shaded side, if
constexpr double kLitSide = 0.35;              // of it is no shadow
constexpr double kColored = 4.0;               // grey levels off a neutral tone: less is no colour to go by
constexpr int kWindow = 9;                     // px, of the light that texture is seen against
constexpr int kFewestPixels = 60;              // px that tell of texture
constexpr double kTextured = 1.0;              // grey levels: weaker texture tells nothing
constexpr double kSeen = 0.5;                  // of the texture: shadow or body
constexpr double kUnseen = 0.15;               // of the texture, at most, on a body
constexpr double kJump = 0.5;                  // of a body's range of light, between its sides: more is an edge

/// 255 where a pixel could be the background with less light: the same colour, darker. Where the difference from the background is
/// below `weak` and the background is nearly clipped, the colour may be farther off: bright surfaces lose their tint.
cv::Mat same_color(const cv::Mat& frame, const Background& background, const cv::Mat& difference, int weak) {
  cv::Mat mask = cv::Mat::zeros(frame.size(), CV_8U);
  for (int y = 0; y < frame.rows; ++y)
    for (int x = 0; x < frame.cols; ++x) {
      const cv::Vec3b &f = frame.at<cv::Vec3b>(y, x), &b = background.picture.at<cv::Vec3b>(y, x);
      const double bb = b.ddot(b), fb = f.ddot(b), share = bb > 0.0 ? fb / bb : 1.0;
      if (share < kLeast || share > kMost) continue;
      double limit = std::max(kGray, kSigmas * background.noise.at<float>(y, x));
      const bool bright = std::max({b[0], b[1], b[2]}) >= kBright;
      if (bright && difference.at<unsigned char>(y, x) < weak) limit = std::max(limit, kWeakGray * share * std::sqrt(bb));
      bool same = true;
      for (int c = 0; c < 3; ++c) same = same && std::abs(f[c] - share * b[c]) < limit;
      if (same) mask.at<unsigned char>(y, x) = 255;
    }
  return mask;
}

/// The difference that one in ten of the part's pixels exceeds.
double high_contrast(const cv::Mat& difference, const cv::Mat& mask) {
  std::vector<unsigned char> values;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (mask.at<unsigned char>(y, x)) values.push_back(difference.at<unsigned char>(y, x));
  return quantile(std::move(values), 0.9);
}

/// Whether the piece has a colour, and it is the background's. Both means; a grey body before a wall with a tint is nearer to grey.
bool has_its_color(const cv::Mat& frame, const cv::Mat& background, const cv::Mat& piece) {
  const cv::Scalar f = cv::mean(frame, piece), b = cv::mean(background, piece);
  const double gray = (f[0] + f[1] + f[2]) / 3.0, bb = b.dot(b), share = f.dot(b) / std::max(1.0, bb), neutral = gray * (b[0] + b[1] + b[2]) / std::max(1.0, bb);
  double far = 0.0, along = 0.0, length = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double tint = gray - neutral * b[c];
    far = std::max(far, std::abs(tint));
    along += (f[c] - share * b[c]) * tint;
    length += tint * tint;
  }
  return far >= kColored && along < 0.5 * length;
}

/// What tells that a piece is a shadow; nothing if it is none.
std::optional<ShadowSign> sign_of(const cv::Mat& frame, const cv::Mat& background, const cv::Mat& piece) {
  const Texture texture = texture_in(frame, background, piece);
  if (texture.strength >= kTextured && texture.seen - 2.0 * texture.error > kSeen) return ShadowSign::texture;
  if (texture.strength >= kTextured && texture.seen < kUnseen && texture.seen + 2.0 * texture.error < kSeen) return std::nullopt;
  return has_its_color(frame, background, piece) ? ShadowSign::color : ShadowSign::light;
}

/// Whether the light of `lit` goes over into that of `piece`, as it does on a round body, and does not end at an edge.
bool goes_over(const cv::Mat& frame, const cv::Mat& lit, const cv::Mat& piece) {
  cv::Mat near_lit, near_piece;
  cv::dilate(lit, near_lit, disc(5));
  cv::dilate(piece, near_piece, disc(5));
  near_lit &= piece;
  near_piece &= lit;
  if (cv::countNonZero(near_lit) == 0 || cv::countNonZero(near_piece) == 0) return false;
  const cv::Scalar jump = cv::mean(frame, near_piece) - cv::mean(frame, near_lit);
  const double most = std::max({std::abs(jump[0]), std::abs(jump[1]), std::abs(jump[2])});
  return most < kJump * high_contrast(worst_difference(frame, cv::mean(frame, piece)), lit);
}

/// A piece of what could be shadow, and what tells that it is one.
struct Piece {
  cv::Mat mask;
  int area = 0;
  ShadowSign sign = ShadowSign::light;
};

/// The pieces of `shadow` that a body cannot be told from; all others are taken out of it.
std::vector<Piece> pieces_of(const cv::Mat& frame, const cv::Mat& background, cv::Mat& shadow) {
  cv::Mat labels, stats, centers;
  std::vector<Piece> pieces;
  const int count = cv::connectedComponentsWithStats(shadow, labels, stats, centers, 4);
  for (int i = 1; i < count; ++i) {
    const cv::Mat mask = labels == i;
    if (const auto sign = sign_of(frame, background, mask)) pieces.push_back({mask, stats.at<int>(i, cv::CC_STAT_AREA), *sign});
    else shadow.setTo(0, mask);
  }
  return pieces;
}

/// Whether a piece is convex and completes the rest to a convex whole, as a flat side of a box does. A shadow close to its body lies around it;
/// what is beside a whole ball, or larger than the rest, is no side.
bool completes(const cv::Mat& lit, const cv::Mat& piece) {
  const int area = cv::countNonZero(piece), rest = cv::countNonZero(lit);
  if (area < kLeastSide * rest || area > kMostSide * rest || roundness(lit) > kRound) return false;
  cv::Mat whole;
  cv::morphologyEx(lit | piece, whole, cv::MORPH_CLOSE, disc(7));
  return solidity(piece) > kConvexPiece && solidity(whole) > kConvex;
}

/// Takes out of `shadow` the shaded sides of the rest of `mask`: pieces that lie within its convex hull, since a shadow falls beside its
/// body, and flat sides, if the background's texture is not seen in them; and, where colour does not tell, pieces that its light goes over into.
void keep_shaded_sides(const cv::Mat& frame, const cv::Mat& mask, const std::vector<Piece>& pieces, cv::Mat& shadow) {
  cv::Mat lit = mask & ~shadow;
  cv::morphologyEx(lit, lit, cv::MORPH_OPEN, disc(3));
  const int area = cv::countNonZero(lit);
  if (area < 3) return;
  const cv::Mat hull = hull_of(without_crumbs(lit));
  for (const Piece& piece : pieces) {
    const auto within = [&] { return piece.area < kSide * area && cv::countNonZero(piece.mask & hull) >= kWithin * piece.area; };
    const bool side = piece.sign != ShadowSign::texture && (within() || completes(lit, piece.mask));
    if (side || (piece.sign == ShadowSign::light && goes_over(frame, lit, piece.mask))) shadow.setTo(0, piece.mask);
  }
}

/// Whether a part is a disc of which enough is lit: with a shadow beside the body it would be none.
bool is_lit_ball(const cv::Mat& mask, const cv::Mat& shadow) {
  return cv::countNonZero(mask & ~shadow) >= kLitSide * cv::countNonZero(mask) && roundness(mask) > kRound;
}

/// What tells most of the pieces.
ShadowSign most_of(const std::vector<Piece>& pieces) {
  std::array<int, 3> areas{};
  for (const Piece& piece : pieces) areas[static_cast<std::size_t>(piece.sign)] += piece.area;
  return static_cast<ShadowSign>(std::max_element(areas.begin(), areas.end()) - areas.begin());
}

}  // namespace

Texture texture_in(const cv::Mat& frame, const cv::Mat& background, const cv::Mat& mask) {
  Texture texture;
  cv::Mat f, b, inside, weight;
  cv::erode(mask, inside, disc(7), {-1, -1}, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  const int n = cv::countNonZero(inside);
  if (n < kFewestPixels) return texture;
  cv::cvtColor(frame, f, cv::COLOR_BGR2GRAY);
  cv::cvtColor(background, b, cv::COLOR_BGR2GRAY);
  f.convertTo(f, CV_32F);
  b.convertTo(b, CV_32F);
  inside.convertTo(weight, CV_32F, 1.0 / 255.0);
  const auto blurred = [&](const cv::Mat& m) {
    cv::Mat sum;
    cv::boxFilter(m, sum, CV_32F, {kWindow, kWindow}, {-1, -1}, false, cv::BORDER_CONSTANT);
    return sum;
  };
  const cv::Mat weights = blurred(weight), light = blurred(f.mul(weight)), lit = blurred(b.mul(weight));
  double fb = 0.0, bb = 0.0, ff = 0.0;
  for (int y = 0; y < inside.rows; ++y)
    for (int x = 0; x < inside.cols; ++x) {
      if (!inside.at<unsigned char>(y, x)) continue;
      const double w = weights.at<float>(y, x), share = light.at<float>(y, x) / std::max(1.0F, lit.at<float>(y, x));
      const double own = f.at<float>(y, x) - light.at<float>(y, x) / w, expected = share * (b.at<float>(y, x) - lit.at<float>(y, x) / w);
      fb += own * expected;
      bb += expected * expected;
      ff += own * own;
    }
  if (bb <= 0.0) return texture;
  texture.seen = fb / bb;
  texture.error = std::sqrt(std::max(0.0, ff - texture.seen * fb) / (n * bb));
  texture.strength = std::sqrt(bb / n);
  return texture;
}

Shade find_shade(const cv::Mat& frame, const Background& background, const cv::Mat& difference, const cv::Mat& mask) {
  const int weak = static_cast<int>(kWeak * high_contrast(difference, mask));
  Shade shade;
  shade.mask = same_color(frame, background, difference, weak) & mask;
  const std::vector<Piece> pieces = pieces_of(frame, background.picture, shade.mask);
  shade.sign = most_of(pieces);
  shade.whole = cv::countNonZero(shade.mask) > kWhole * cv::countNonZero(mask);
  if (!shade.whole && is_lit_ball(mask, shade.mask)) shade.mask.setTo(0);
  else if (!shade.whole) keep_shaded_sides(frame, mask, pieces, shade.mask);
  return shade;
}

}  // namespace unseen::collision
