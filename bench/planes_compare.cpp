// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// planes_compare LIST DATA OUT.csv [LIMIT_SECONDS] [ONLY…]: runs unseen and its peers on each case of a list.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <set>

#include "bench/planes_score.h"
#include "unseen/core/error.h"
#include "unseen/planes/evaluate.h"
#include "unseen/planes/planes.h"

namespace unseen::bench {
namespace {

constexpr rlim_t kMemory =
    rlim_t{6} << 30;  // bytes a method may take: more is a failure, not a frozen machine

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// The row of one method, in the process that calls it.
std::string run_peer(const Case& c, const std::string& method,
                     const std::function<Detection(const OrientedPoints&, double)>& detect) {
  const Loaded loaded = load(c);
  const Detection d = detect(orient(loaded.cloud.positions, loaded.cloud.normals), c.scale);
  return csv_row(c, loaded, method, d, peak_mb(), -1);
}

std::string run_unseen(const Case& c) {
  const Loaded loaded = load(c);
  planes::Options options;
  options.scale = c.scale;
  options.angles = c.angles;
  Context context;
  Detection d;
  CloudSource source(loaded.cloud, c.name);
  const auto start = std::chrono::steady_clock::now();
  const planes::Arrangement found = planes::find_planes(
      source, options, context, [&](std::span<const Vec3>, std::span<const int> plane_of_point) {
        d.plane_of_point.insert(d.plane_of_point.end(), plane_of_point.begin(), plane_of_point.end());
      });
  d.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double peak = peak_mb();
  d.plane_of_point.resize(loaded.cloud.size(), -1);
  for (const auto& plane : found.planes) d.planes.push_back(plane.plane);
  return csv_row(c, loaded, "unseen", d, peak, degrees(planes::evaluate_relations(found).largest_error));
}

/// Runs `body` in a process of its own, so that its peak memory is its own, and returns the row that it
/// wrote.
std::string in_own_process(const Case& c, const std::string& method, unsigned limit,
                           const std::function<std::string()>& body) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    alarm(limit);
    const rlimit memory{kMemory, kMemory};
    setrlimit(RLIMIT_AS, &memory);
    std::string row;
    try {
      row = body();
    } catch (const std::exception& e) {
      fmt::print(stderr, "{} on {}: {}\n", method, c.name, e.what());
      _exit(1);
    }
    _exit(write(ends[1], row.data(), row.size()) == static_cast<ssize_t>(row.size()) ? 0 : 1);
  }
  close(ends[1]);
  std::string row;
  char buffer[4096];
  for (ssize_t got; (got = read(ends[0], buffer, sizeof buffer)) > 0;)
    row.append(buffer, static_cast<std::size_t>(got));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return row;
  const bool late = WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM;
  return csv_failure(c, method, late ? fmt::format(">{}", limit) : "failed");
}

int run(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: planes_compare LIST DATA OUT.csv [LIMIT_SECONDS] [ONLY…]\n");
    return 2;
  }
  const std::vector<Case> cases = read_cases(argv[1], argv[2]);
  std::ofstream out(argv[3]);
  const auto limit = static_cast<unsigned>(argc > 4 ? std::stoi(argv[4]) : 600);
  const std::set<std::string> only(argv + std::min(argc, 5), argv + argc);
  out << csv_header();
  for (const Case& c : cases) {
    if (!only.empty() && only.count(c.name) == 0) continue;
    const std::vector<std::pair<std::string, std::function<std::string()>>> methods = {
        {"unseen", [&] { return run_unseen(c); }},
        {"region_growing", [&] { return run_peer(c, "region_growing", region_growing); }},
        {"region_growing+regularize",
         [&] { return run_peer(c, "region_growing+regularize", regularized_region_growing); }},
        {"efficient_ransac", [&] { return run_peer(c, "efficient_ransac", efficient_ransac); }}};
    for (const auto& [method, body] : methods) {
      const std::string row = in_own_process(c, method, limit, body);
      fmt::print(stderr, "{}", row);
      out << row << std::flush;
    }
  }
  return out ? 0 : 1;
}

}  // namespace
}  // namespace unseen::bench

int main(int argc, char** argv) {
  try {
    return unseen::bench::run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 3;
  }
}
