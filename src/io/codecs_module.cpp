// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <opencv2/imgcodecs.hpp>

#include "io/codecs.h"

extern "C" const unseen::io::Codecs unseen_codecs;

const unseen::io::Codecs unseen_codecs{
    [] { return std::make_unique<cv::VideoCapture>(); },
    [](const std::string& path, int fourcc, double fps, cv::Size size) { return std::make_unique<cv::VideoWriter>(path, cv::CAP_FFMPEG, fourcc, fps, size); },
    cv::imdecode,
    cv::imencode,
};
