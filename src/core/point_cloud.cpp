// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/core/point_cloud.h"

namespace unseen {
namespace {

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

CloudSource::CloudSource(const PointCloud& cloud, std::string name) : cloud_(cloud), name_(std::move(name)) {}

SourceInfo CloudSource::info() const {
  SourceInfo info;
  info.name = name_;
  info.point_count = cloud_.size();
  info.has_normals = !cloud_.normals.empty();
  info.in_memory = true;
  info.viewpoint = cloud_.viewpoint;
  return info;
}

bool CloudSource::next(PointCloud& block) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  if (at_ >= cloud_.size()) return false;
  const std::size_t end = std::min(at_ + kBlock, cloud_.size());
  const auto slice = [&](const auto& from, auto& to) {
    from.empty() ? to.clear() : to.assign(from.begin() + at_, from.begin() + end);
  };
  slice(cloud_.positions, block.positions);
  slice(cloud_.normals, block.normals);
  slice(cloud_.colors, block.colors);
  slice(cloud_.labels, block.labels);
  at_ = end;
  return true;
}

PointCloud read_all(PointSource& source) {
  if (const PointCloud* cloud = source.cloud()) return *cloud;
  PointCloud all;
  for_each_block(source, [&](const PointCloud& block, std::size_t) {
    append(all.positions, block.positions);
    append(all.normals, block.normals);
    append(all.colors, block.colors);
    append(all.labels, block.labels);
  });
  all.viewpoint = source.info().viewpoint;
  return all;
}

void for_each_block(PointSource& source,
                    const std::function<void(const PointCloud& block, std::size_t first)>& body) {
  if (const PointCloud* cloud = source.cloud()) return body(*cloud, 0);
  source.rewind();
  PointCloud block;
  std::size_t first = 0;
  while (source.next(block)) {
    body(block, first);
    first += block.size();
  }
}

}  // namespace unseen
