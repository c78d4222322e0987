// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace unseen::test {

/// The fields of a protocol buffer, one after the other.
class Message {
 public:
  Message& number(int field, std::uint64_t value) {
    varint(static_cast<std::uint64_t>(field) << 3);
    varint(value);
    return *this;
  }
  Message& bytes(int field, const std::string& value) {
    varint(static_cast<std::uint64_t>(field) << 3 | 2);
    varint(value.size());
    text_ += value;
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  void varint(std::uint64_t v) {
    for (; v >= 0x80; v >>= 7) text_ += static_cast<char>(v | 0x80);
    text_ += static_cast<char>(v);
  }
  std::string text_;
};

/// An ONNX network of one convolution, 2 × 2 with stride 2, and a ReLU: channel c of the output is max(0, weight_c · colour + bias_c) of the mean
/// colour of a cell. Its input is 1 × 3 × height × width. Field numbers: onnx.proto, IR version 7.
inline std::string little_onnx(const std::vector<std::array<float, 3>>& weights, const std::vector<float>& biases, int width, int height) {
  const auto tensor = [](const std::string& name, const std::vector<std::uint64_t>& dims, const std::vector<float>& values) {
    Message m;
    for (const std::uint64_t d : dims) m.number(1, d);
    m.number(2, 1);  // float
    m.bytes(8, name);
    std::string raw(values.size() * sizeof(float), '\0');
    std::memcpy(raw.data(), values.data(), raw.size());
    return m.bytes(9, raw).text();
  };
  const auto value_info = [](const std::string& name, const std::vector<std::uint64_t>& dims) {
    Message shape;
    for (const std::uint64_t d : dims) shape.bytes(1, Message().number(1, d).text());
    const std::string type = Message().bytes(1, Message().number(1, 1).bytes(2, shape.text()).text()).text();
    return Message().bytes(1, name).bytes(2, type).text();
  };
  const auto ints = [](const std::string& name, const std::vector<std::uint64_t>& values) {
    Message m;
    m.bytes(1, name);
    for (const std::uint64_t v : values) m.number(8, v);
    return m.number(20, 7).text();  // INTS
  };
  std::vector<float> kernel;
  for (const auto& w : weights)
    for (const float channel : w) kernel.insert(kernel.end(), 4, channel / 4);
  const std::string convolution = Message()
                                      .bytes(1, "picture")
                                      .bytes(1, "weights")
                                      .bytes(1, "biases")
                                      .bytes(2, "sums")
                                      .bytes(3, "convolution")
                                      .bytes(4, "Conv")
                                      .bytes(5, ints("kernel_shape", {2, 2}))
                                      .bytes(5, ints("strides", {2, 2}))
                                      .bytes(5, ints("pads", {0, 0, 0, 0}))
                                      .text();
  const std::string relu = Message().bytes(1, "sums").bytes(2, "maps").bytes(3, "relu").bytes(4, "Relu").text();
  const auto count = static_cast<std::uint64_t>(weights.size()), w = static_cast<std::uint64_t>(width), h = static_cast<std::uint64_t>(height);
  const std::string graph = Message()
                                .bytes(1, convolution)
                                .bytes(1, relu)
                                .bytes(2, "little")
                                .bytes(5, tensor("weights", {count, 3, 2, 2}, kernel))
                                .bytes(5, tensor("biases", {count}, biases))
                                .bytes(11, value_info("picture", {1, 3, h, w}))
                                .bytes(12, value_info("maps", {1, count, h / 2, w / 2}))
                                .text();
  return Message().number(1, 7).bytes(7, graph).bytes(8, Message().bytes(1, "").number(2, 11).text()).text();
}

}  // namespace unseen::test
