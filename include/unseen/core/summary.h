// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace unseen {

/// How a run ended; none of these is the caller's fault.
enum class Status { solved, time_limit, infeasible, cancelled };

inline const char* to_string(Status status) {
  switch (status) {
    case Status::solved: return "solved";
    case Status::time_limit: return "time_limit";
    case Status::infeasible: return "infeasible";
    case Status::cancelled: return "cancelled";
  }
  return "infeasible";
}

/// What every result says about its own making. Entries keep the order in which they were added.
struct Summary {
  Status status = Status::solved;
  std::vector<std::pair<std::string, double>> seconds;  ///< wall time of each stage
  std::vector<std::pair<std::string, double>> energy;
  std::vector<std::pair<std::string, std::size_t>> counts;
  std::vector<std::string> warnings;
};

}  // namespace unseen
