// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <cmath>
#include <future>
#include <set>

#include "io/depth_frames.h"
#include "io/depth_png.h"
#include "io/depth_rounding.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

constexpr std::size_t kFramesOfValues = 20;  // from which the sensor's rounding is read

/// Gives a block a frame. While one is being used the next is decoded.
class DepthSource final : public PointSource {
 public:
  DepthSource(const std::filesystem::path& folder, const ReadOptions& options)
      : folder_(read_depth_folder(folder, options.frame_step)), step_(options.depth_step) {
    low_ = options.depth_range[0];
    high_ = options.depth_range[1];
    info_.name = folder.string();
    info_.notes = std::move(folder_.notes);
    if (folder_.frames.size() == 1) info_.viewpoint = folder_.frames[0].T_world_camera.translation;
  }

  SourceInfo info() const override { return info_; }

  void rewind() override {
    started_ = true;
    if (valued_ == 0) values_ = {};
    decode_ahead(0);
    points_ = 0;
  }

  bool next(PointCloud& block) override {
    if (!started_) rewind();
    resize_empty(block);
    while (at_ < folder_.frames.size()) {
      const std::size_t frame = at_;
      Decoded image = ahead_.get();
      decode_ahead(frame + 1);
      if (image.fault.empty()) check_size(image, frame);
      if (!image.fault.empty()) {
        if (faults_.insert(frame).second) info_.notes.push_back("frame left out: " + image.fault);
        continue;
      }
      unproject(image.depth, folder_.frames[frame].T_world_camera, block);
      if (block.positions.empty()) continue;
      points_ += block.size();
      if (frame >= valued_ && frame < kFramesOfValues) values_.add(image.depth, low_, high_);
      return true;
    }
    if (points_ == 0)
      throw InputError(
          info_.name, "frames", info_.notes.empty() ? "no depth in range" : "none usable (" + info_.notes.back() + ")",
          "a depth from " + std::to_string(low_) + " to " + std::to_string(high_) + " m somewhere");
    if (valued_ == 0) info_.rounding = values_.rounding();
    valued_ = at_;
    return false;
  }

 private:
  struct Decoded {
    DepthImage depth;
    std::string fault;
  };

  /// The intrinsics are those of one size of picture: that of the first.
  void check_size(Decoded& image, std::size_t frame) {
    const int width = image.depth.width, height = image.depth.height;
    if (width_ == 0) {
      width_ = width;
      height_ = height;
      const Camera& c = folder_.camera;
      const auto central = [](double at, int length) { return std::abs(at / length - 0.5) < 0.3; };
      if (!central(c.cx, width) || !central(c.cy, height))
        info_.notes.push_back("the intrinsics' principal point (" + std::to_string(std::lround(c.cx)) + ", " + std::to_string(std::lround(c.cy)) + ") is far from the middle of pictures of " +
                              size_text(width, height) + ": are they of another size?");
    }
    if (width != width_ || height != height_)
      image.fault = folder_.frames[frame].image.string() + " has " + size_text(width, height) + ", others before it " + size_text(width_, height_);
  }

  static std::string size_text(int width, int height) { return std::to_string(width) + " x " + std::to_string(height) + " pixels"; }

  static void resize_empty(PointCloud& block) {
    block.positions.clear();
    block.normals.clear();
    block.colors.clear();
    block.labels.clear();
    block.viewpoint.reset();
  }

  static Decoded decode(const std::filesystem::path& path) {
    Decoded result;
    try {
      result.depth = read_depth_png(FileBytes::open(path)->view(), path.string());
    } catch (const InputError& error) {
      result.fault = error.what();
    }
    return result;
  }

  void decode_ahead(std::size_t frame) {
    at_ = frame;
    if (frame < folder_.frames.size())
      ahead_ = std::async(std::launch::async, decode, folder_.frames[frame].image);
  }

  void unproject(const DepthImage& image, const RigidTransform& pose, PointCloud& block) const {
    const Camera& camera = folder_.camera;
    const int step = step_;
    // Depths are whole millimetres: the range becomes one too, and the test is cheap.
    constexpr double kMetre = 1e-3;
    std::vector<Vec3> across;  // the part of a pixel's ray that depends on its column, in world coordinates
    for (int u = 0; u < image.width; u += step)
      across.push_back(pose.rotation.col(0) * ((u - camera.cx) / camera.fx));
    block.positions.resize(across.size() * static_cast<std::size_t>((image.height + step - 1) / step));
    Vec3* to = block.positions.data();
    for (int v = 0; v < image.height; v += step) {
      const Vec3 down = pose.rotation.col(1) * ((v - camera.cy) / camera.fy) + pose.rotation.col(2);
      const std::uint16_t* row =
          image.millimetres.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width);
      for (std::size_t i = 0; i < across.size(); ++i) {
        const std::uint16_t millimetres = row[i * static_cast<std::size_t>(step)];
        const double depth = millimetres * kMetre;
        if (millimetres == 0 || depth < low_ || depth > high_) continue;
        *to++ = (across[i] + down) * depth + pose.translation;
      }
    }
    block.positions.resize(static_cast<std::size_t>(to - block.positions.data()));
  }

  DepthFolder folder_;
  int step_ = 1;
  double low_ = 0, high_ = 0;  ///< m
  SourceInfo info_;
  std::size_t at_ = 0;  ///< the frame that is being decoded
  int width_ = 0, height_ = 0;  ///< of the first picture
  std::size_t points_ = 0;
  DepthValues values_;
  std::size_t valued_ = 0;  ///< frames that were passed by when these were counted
  bool started_ = false;
  std::set<std::size_t> faults_;  ///< frames that were noted
  std::future<Decoded> ahead_;
};

}  // namespace

std::unique_ptr<PointSource> open_depth_folder(const std::filesystem::path& folder,
                                               const ReadOptions& options) {
  const auto fail = [](const char* field, const std::string& found, const char* expected) {
    throw InputError("read options", field, found, expected);
  };
  const std::vector<double>& range = options.depth_range;
  if (range.size() != 2 || !(range[0] >= 0.0 && range[0] < range[1]))
    fail("depth_range", count_of(range.size(), "number"),
         "nearest and farthest depth in metres, 0 ≤ nearest < farthest");
  if (options.depth_step < 1) fail("depth_step", std::to_string(options.depth_step), "at least 1");
  if (options.frame_step < 1) fail("frame_step", std::to_string(options.frame_step), "at least 1");
  return std::make_unique<DepthSource>(folder, options);
}

}  // namespace unseen::io
