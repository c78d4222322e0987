// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "commands.h"
#include "session.h"
#include "unseen/core/error.h"
#include "unseen/cuboids/check.h"
#include "unseen/io/assembly.h"
#include "unseen/report/cuboids_check.h"

namespace unseen::cli {
namespace {

Vec3 read_up(const std::string& text) {
  if (text.empty()) return Vec3::UnitZ();
  std::vector<double> numbers;
  OptionTable table;
  table.add({"up", &numbers, "", "", -1e6, 1e6, {}});
  table.set_text("up", text, kCommandLine);
  const Vec3 up = numbers.size() == 3 ? Vec3(numbers[0], numbers[1], numbers[2]) : Vec3(Vec3::Zero());
  if (!(up.norm() > 1e-9)) throw InputError(kCommandLine, "up", text, "x,y,z that are not all 0");
  return up.normalized();
}

std::vector<cuboids::Block> blocks_of(const io::Assembly& assembly, double density) {
  std::vector<cuboids::Block> blocks;
  for (const io::NamedMesh& named : assembly.blocks) {
    cuboids::Block block;
    block.name = named.name;
    block.mesh = named.mesh;
    block.density = named.density.value_or(density);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

/// How fast the block moves at its rim, in the unit of the collapse motion.
double speed_of(const cuboids::Check& check, std::size_t block, const TriangleMesh& mesh) {
  Eigen::AlignedBox3d reach;
  for (const Vec3& v : mesh.vertices) reach.extend(v);
  return std::max(check.velocity[block].norm(), check.angular_velocity[block].norm() * 0.5 * reach.diagonal().norm());
}

/// The blocks that begin to move, fastest first.
std::string falling(const cuboids::Check& check, const std::vector<cuboids::Block>& blocks) {
  constexpr std::size_t kMost = 5;
  constexpr double kMoves = 1e-3;  // of the fastest: less is what the solver leaves
  std::vector<std::pair<double, std::size_t>> moving;
  for (std::size_t i = 0; i < check.velocity.size(); ++i) moving.emplace_back(-speed_of(check, i, blocks[i].mesh), i);
  if (moving.empty()) return "falls";
  std::sort(moving.begin(), moving.end());
  std::erase_if(moving, [least = kMoves * moving.front().first](const auto& block) { return block.first > least || block.first == 0.0; });
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::min(kMost, moving.size()); ++k) names.push_back(blocks[moving[k].second].name);
  if (moving.size() > kMost) names.push_back(fmt::format("{} more", moving.size() - kMost));
  return names.empty() ? "falls" : fmt::format("falls; what begins to move: {}", fmt::join(names, ", "));
}

void print_verdict(const cuboids::Check& check, const std::vector<cuboids::Block>& blocks, const cuboids::CheckOptions& options) {
  const cuboids::Stability& s = check.stability;
  fmt::print("{} blocks, {} contacts, fixed: {}\n", blocks.size(), check.contacts.size(), fmt::join(options.supports, ", "));
  if (s.stable)
    fmt::print("stands: bears a sideways push of {:.3f} g, needs a friction of {:.3f} (has {:.4g})\n", s.margin,
               s.friction_needed, options.friction);
  else
    fmt::print("{}\n", falling(check, blocks));
  fmt::print("residual {:.2g}\n", s.residual);
}

}  // namespace

int run_check(const CheckArguments& args, const CommonFlags& common) {
  Session session(common);
  const io::Assembly assembly = io::read_assembly(args.assembly);
  cuboids::CheckOptions options;
  options.supports = args.supports.empty() ? assembly.supports : args.supports;
  options.up = read_up(args.up);
  options.friction = args.friction;
  if (options.supports.empty()) throw UsageError("--support ID is missing: the file names no block that does not move");
  const std::vector<cuboids::Block> blocks = blocks_of(assembly, args.density);
  const cuboids::Check check = cuboids::check_assembly(blocks, options, session.context);
  session.progress.clear();
  if (common.json) {
    fmt::print("{}", report::check_json(check, blocks, options));
  } else if (!common.quiet) {
    print_verdict(check, blocks, options);
  }
  return check.stability.stable ? kSolved : kNoSolution;
}

}  // namespace unseen::cli
