// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>

#include "io/rgbd_parts.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

/// Bytes in memory as OpenEXR reads them.
class MemoryStream final : public Imf::IStream {
 public:
  explicit MemoryStream(std::string_view bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char to[], int count) override {
    if (count < 0 || static_cast<std::size_t>(count) > bytes_.size() - at_) throw std::runtime_error("truncated");
    std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = std::min<std::uint64_t>(at, bytes_.size()); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// The channel that holds depth: by its usual names, or the only one.
std::string depth_channel(const Imf::ChannelList& channels, const std::string& name) {
  for (const char* usual : {"Z", "depth", "depth.Z", "Depth", "V", "Y", "R"})
    if (channels.findChannel(usual) != nullptr) return usual;
  std::vector<std::string> found;
  for (auto it = channels.begin(); it != channels.end(); ++it) found.emplace_back(it.name());
  if (found.size() == 1) return found.front();
  throw InputError(name, "channels", fmt::format("{} of unknown names", found.size()), "Z");
}

}  // namespace

StoredDepth read_exr_depth(std::string_view bytes, const std::string& name) {
  try {
    MemoryStream stream(bytes);
    Imf::InputFile file(stream, 0);  // in this thread
    const Imath::Box2i window = file.header().dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                       height = std::int64_t{window.max.y} - window.min.y + 1;
    constexpr std::int64_t kMost = std::int64_t{1} << 28, kMostPerByte = 1000;
    if (width < 1 || height < 1 || width > kMost / height ||
        width * height / kMostPerByte > static_cast<std::int64_t>(bytes.size()))
      throw InputError(name, "image", fmt::format("{} x {} pixels in {} bytes", width, height, bytes.size()),
                       "a size that fits the file");
    const std::string channel = depth_channel(file.header().channels(), name);
    const Imf::Channel& about = file.header().channels()[channel.c_str()];
    if (about.xSampling != 1 || about.ySampling != 1)
      throw InputError(name, channel, "fewer samples than pixels", "one a pixel");
    StoredDepth stored;
    stored.width = static_cast<int>(width);
    stored.height = static_cast<int>(height);
    stored.values.resize(static_cast<std::size_t>(width * height));
    Imf::FrameBuffer target;
    target.insert(channel, Imf::Slice::Make(Imf::FLOAT, stored.values.data(), window.min, width, height));
    file.setFrameBuffer(target);
    file.readPixels(window.min.y, window.max.y);
    return stored;
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    throw InputError(name, "image", "broken or truncated data", "an EXR image");
  }
}

}  // namespace unseen::io
