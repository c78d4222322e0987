// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/pose_network.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "io/clip.h"
#include "io/quiet_opencv.h"
#include "report/interactions_take_parts.h"
#include "unseen/core/error.h"

namespace unseen::report {
namespace {

using namespace interactions;

constexpr double kSeen = 0.1;  ///< least mean confidence of a person
constexpr JointMap kOurs = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
constexpr const char* kForms = "1 × C × rows × columns heat maps, C = 16, 17 (ours), 18, 19, 57 (COCO-18), 25, 26 or 78 (BODY_25)";

struct Form {
  int maps;
  const JointMap* joints;
};

Form form_of(const cv::Mat& output, const std::string& model) {
  if (output.dims == 4 && output.size[0] == 1 && output.size[2] > 0 && output.size[3] > 0 && output.type() == CV_32F) {
    const int channels = output.size[1];
    if (channels == 16 || channels == 17) return {16, &kOurs};
    if (channels == 18 || channels == 19 || channels == 57) return {18, &kCoco18};
    if (channels == 25 || channels == 26 || channels == 78) return {25, &kBody25};
  }
  std::string shape;
  for (int d = 0; d < output.dims; ++d) shape += fmt::format("{}{}", d > 0 ? " × " : "", output.size[d]);
  throw InputError(model, "output", shape, kForms);
}

cv::dnn::Net read_network(const std::filesystem::path& model) {
  const std::string expected = "a network that OpenCV reads: .onnx, or .caffemodel with its .prototxt beside it";
  std::error_code error;
  if (!std::filesystem::is_regular_file(model, error)) throw InputError(model.string(), "", "no such file", expected);
  std::filesystem::path layout = model;
  layout.replace_extension(".prototxt");
  try {
    const io::QuietOpenCv quiet;
    const cv::dnn::Net net =
        model.extension() == ".onnx" ? cv::dnn::readNetFromONNX(model.string()) : cv::dnn::readNetFromCaffe(layout.string(), model.string());
    if (!net.empty()) return net;
  } catch (const cv::Exception&) {
    // said below
  }
  throw InputError(model.string(), "", "something else", expected);
}

/// How a picture lies in the input: in its upper left, as large as fits.
struct Fit {
  cv::Size input;
  double scale = 1;
};

Fit fit_of(const cv::Mat& frame, const PoseNetworkOptions& options) {
  const double width = static_cast<double>(options.height) * frame.cols / frame.rows;
  Fit fit;
  fit.input = {options.width > 0 ? options.width : static_cast<int>(std::ceil(width / 8.0)) * 8, options.height};
  fit.scale = std::min(static_cast<double>(fit.input.width) / frame.cols, static_cast<double>(fit.input.height) / frame.rows);
  return fit;
}

cv::Mat input_of(const cv::Mat& frame, const Fit& fit, const PoseNetworkOptions& options) {
  cv::Mat small, whole(fit.input, CV_8UC3, cv::Scalar::all(options.mean));
  const cv::Size size(std::min(fit.input.width, static_cast<int>(std::lround(fit.scale * frame.cols))),
                      std::min(fit.input.height, static_cast<int>(std::lround(fit.scale * frame.rows))));
  cv::resize(frame, small, size, 0, 0, cv::INTER_AREA);
  small.copyTo(whole(cv::Rect({0, 0}, size)));
  return cv::dnn::blobFromImage(whole, options.scale, {}, cv::Scalar::all(options.mean), options.rgb);
}

/// Where between its neighbours a peak is, in [−½, ½]: that of the parabola.
double between(double before, double at, double after) {
  const double bend = before - 2.0 * at + after;
  return bend < 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

/// x, y in the picture and confidence.
std::array<double, 3> peak(const cv::Mat& map, const Fit& fit) {
  double value = 0;
  cv::Point at;
  cv::minMaxLoc(map, nullptr, &value, nullptr, &at);
  if (!(value > 0.0)) return {0, 0, 0};
  const auto near = [&](int x, int y) { return static_cast<double>(map.at<float>(std::clamp(y, 0, map.rows - 1), std::clamp(x, 0, map.cols - 1))); };
  const double x = at.x + between(near(at.x - 1, at.y), value, near(at.x + 1, at.y)),
               y = at.y + between(near(at.x, at.y - 1), value, near(at.x, at.y + 1));
  // Middles of cells to middles of pixels.
  return {(x + 0.5) * fit.input.width / map.cols / fit.scale - 0.5, (y + 0.5) * fit.input.height / map.rows / fit.scale - 0.5, value};
}

Detection detection_in(const cv::Mat& output, const Form& form, const Fit& fit, int frame) {
  std::vector<double> keypoints;
  for (int k = 0; k < form.maps; ++k) {
    const cv::Mat map(output.size[2], output.size[3], CV_32F, const_cast<float*>(output.ptr<float>(0, k)));
    const auto [x, y, confidence] = peak(map, fit);
    keypoints.insert(keypoints.end(), {x, y, confidence});
  }
  return detection_of(frame, keypoints, *form.joints);
}

cv::Mat run_network(cv::dnn::Net& net, const cv::Mat& input, const std::string& model) {
  try {
    const io::QuietOpenCv quiet;
    net.setInput(input);
    return net.forward();
  } catch (const cv::Exception&) {
    throw InputError(model, "input", fmt::format("it does not take 1 × 3 × {} × {}", input.size[2], input.size[3]),
                     "a network that takes pictures of any size, or its own --pose-height and --pose-width");
  }
}

}  // namespace

OptionTable describe(PoseNetworkOptions& o) {
  OptionTable t;
  t.add({"pose_height", &o.height, "px", "height of the pose network's input", 8, 4096, {}});
  t.add({"pose_width", &o.width, "px", "width of it; 0: as the video's sides are to each other", 0, 8192, {}});
  t.add({"pose_scale", &o.scale, "", "of colours 0…255 at it", 1e-6, 1e3, {}});
  t.add({"pose_mean", &o.mean, "", "subtracted from colours before that", 0, 255, {}});
  t.add({"pose_rgb", &o.rgb, "", "the pose network wants red first, not blue", 0, 1, {}});
  t.add({"hfov_deg", &o.hfov_deg, "deg", "horizontal field of view of the video's camera", 5, 170, {}});
  return t;
}

Take detect_poses(const std::filesystem::path& model, const std::filesystem::path& video, const PoseNetworkOptions& options, Context& context) {
  cv::dnn::Net net = read_network(model);
  io::Clip clip(video.string());
  Take take;
  take.name = video.string();
  if (clip.fps() > 0)
    take.fps = clip.fps();
  else
    take.remarks.push_back(fmt::format("the video has no frame rate: {} assumed", take.fps));
  cv::Mat frame;
  int count = 0;
  for (; clip.next(frame); ++count) {
    const Fit fit = fit_of(frame, options);
    const cv::Mat output = run_network(net, input_of(frame, fit, options), model.string());
    const Detection d = detection_in(output, form_of(output, model.string()), fit, count);
    if (d.confidence.mean() >= kSeen) take.detections.push_back(d);
    take.camera = resolved_camera({{}, radians(options.hfov_deg), true}, {frame.cols, frame.rows});
    context.progress(clip.announced() > 0 ? std::min(1.0, static_cast<double>(count) / clip.announced()) : 0.0);
  }
  take.camera_assumed = true;
  if (take.detections.empty())
    throw InputError(video.string(), "", fmt::format("nobody in {} frames", count), "a video in which the network sees somebody");
  return take;
}

}  // namespace unseen::report
