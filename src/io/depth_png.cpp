// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/depth_png.h"

#include "io/image.h"
#include "unseen/core/error.h"

namespace unseen::io {

DepthImage read_depth_png(std::string_view bytes, const std::string& name) {
  const cv::Mat image = decode_image(bytes, name);
  if (image.type() != CV_16UC1)
    throw InputError(name, "pixels", "8 bits or colours", "16-bit grey, millimetres");
  DepthImage depth{image.cols, image.rows, {}};
  depth.millimetres.assign(image.begin<std::uint16_t>(), image.end<std::uint16_t>());
  return depth;
}

}  // namespace unseen::io
