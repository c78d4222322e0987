// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Reads an assembly and, if it is small, checks whether it stands.
#include <cmath>
#include <cstdlib>
#include <string>

#include "unseen/core/error.h"
#include "unseen/cuboids/check.h"
#include "unseen/io/assembly.h"

namespace unseen::cuboids {
namespace {

constexpr std::size_t kMostBlocks = 4, kMostTriangles = 40;  // what is checked in no time

void check(const io::Assembly& assembly) {
  std::vector<Block> blocks;
  std::size_t triangles = 0;
  for (const io::NamedMesh& b : assembly.blocks) {
    blocks.push_back({b.name, b.mesh, b.density.value_or(2400.0)});
    triangles += b.mesh.triangles.size();
  }
  if (blocks.size() > kMostBlocks || triangles > kMostTriangles) return;
  Context context;
  const Check result = check_assembly(blocks, {assembly.supports, Vec3::UnitZ(), 0.7}, context);
  bool good = std::isfinite(result.stability.residual) && std::isfinite(result.stability.margin) &&
              std::isfinite(result.stability.friction_needed);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    good = good && result.velocity[i].allFinite() && result.angular_velocity[i].allFinite();
  for (const Contact& c : result.contacts)
    for (std::size_t i = 0; i < c.points.size(); ++i)
      good = good && c.points[i].allFinite() && c.forces[i].allFinite();
  if (!good) std::abort();
}

}  // namespace
}  // namespace unseen::cuboids

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  try {
    unseen::cuboids::check(unseen::io::read_assembly_in_memory({data, data + size}, "a.json"));
  } catch (const unseen::InputError&) {
  }
  return 0;
}
