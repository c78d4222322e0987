// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/write_video.h"

#include "io/codecs.h"
#include "unseen/core/error.h"

namespace unseen::io {

struct VideoFile::Writer {
  std::filesystem::path path;
  cv::Size size;
  std::unique_ptr<cv::VideoWriter> video;
};

VideoFile::VideoFile(const std::filesystem::path& path, int width, int height, double fps)
    : writer_(new Writer{path, {width, height}, nullptr}) {
  const bool mp4 = path.extension() == ".mp4";
  writer_->video = codecs().video_writer(path.string(), mp4 ? fourcc('m', 'p', '4', 'v') : fourcc('M', 'J', 'P', 'G'), fps, writer_->size);
  if (!writer_->video->isOpened())
    throw InputError(path.string(), "", "no encoder, or a place that cannot be written", "a video file that can be written");
}

VideoFile::~VideoFile() = default;

void VideoFile::add(const std::vector<std::uint8_t>& bgr) {
  writer_->video->write(cv::Mat(writer_->size, CV_8UC3, const_cast<std::uint8_t*>(bgr.data())));
}

void VideoFile::close() {
  writer_->video->release();
  std::error_code error;
  if (std::filesystem::file_size(writer_->path, error) == 0 || error)
    throw InputError(writer_->path.string(), "", error ? error.message() : "an empty file", "a video file that can be written");
}

}  // namespace unseen::io
