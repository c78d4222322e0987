// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/samples.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"
#include "unseen/io/mesh.h"

namespace unseen::io {
namespace {

std::string mutate(std::string s, Random& random) {
  const std::size_t edits = 1 + random.index(4);
  for (std::size_t i = 0; i < edits && !s.empty(); ++i) {
    const std::size_t at = random.index(s.size());
    switch (random.index(6)) {
      case 0:
        s[at] = static_cast<char>(random.index(256));
        break;
      case 1:
        s[at] = "0123456789-.\n e"[random.index(15)];
        break;
      case 2:
        s.resize(at);
        break;
      case 3:
        s.insert(at, s, random.index(s.size()), random.index(20));
        break;
      case 4:
        s.erase(at, random.index(20));
        break;
      default:
        s.replace(at, std::min<std::size_t>(4, s.size() - at), "\xff\xff\xff\x7f",
                  std::min<std::size_t>(4, s.size() - at));
    }
  }
  return s;
}

/// Whatever the bytes: points or an InputError.
TEST(Mutations, GivePointsOrAnInputError) {
  const std::vector<std::pair<std::string, std::string>> files = {
      {ply_ascii(), "a.ply"},
      {ply_binary(false), "a.ply"},
      {ply_binary(true), "a.ply"},
      {pcd("ascii"), "a.pcd"},
      {pcd("binary"), "a.pcd"},
      {pcd("binary_compressed"), "a.pcd"},
      {las(3, 2), "a.las"},
      {las(7, 4), "a.las"},
      {ptx(), "a.ptx"},
      {"x,y,z,r,g,b\n1,2,3,4,5,6\n7,8,9,0,1,2\n", "a.csv"},
      {"2\n1 2 3\n4 5 6\n0 0 1\n1 0 0\n", "a.pwn"},
      {"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng a\nf 1 2 3 4\n", "a.obj"},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off"}};
  ReadOptions options;
  options.mesh_samples = 10;
  Random random(7);
  std::size_t read_well = 0;
  for (int i = 0; i < 2600; ++i) {
    const auto& [bytes, name] = files[static_cast<std::size_t>(i) % files.size()];
    const std::string broken = mutate(bytes, random);
    try {
      read(broken, name, options);
      ++read_well;
    } catch (const InputError&) {
    }
    try {
      read_mesh_in_memory(broken, name);
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(read_well, 100u);
}

}  // namespace
}  // namespace unseen::io
