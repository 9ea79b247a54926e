// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <limits>

#include "rt/threads/nonblocking.hpp"

namespace terracut::min_cut {

/// Limits the work of the solvers of one min-cut. An operation is one visit of an arc (3 to 14 ns
/// on a 3 GHz core, more in larger components). Not counted are the steps before the solvers and
/// one linear pass over the interrupted component; the limit on unknown cells bounds them.
///
/// Without `expired` the result depends on the input alone: the deterministic mode, for replays and
/// tests. With `expired` the caller's clock can also stop the solvers and the expensive steps
/// before them (weights, persistency): live mode.
struct CutBudget {
  static constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();
  /// Takes 10 to 25 ms: fifty to two hundred times what a typical street frame needs.
  static constexpr std::int64_t kDefaultOps = 2'500'000;
  /// Operations between two readings of the clock, some 40 microseconds. Push-relabel does not read
  /// the clock while it measures distances, which visits each arc of the component once.
  static constexpr std::int64_t kOpsPerClockLook = 4096;
  /// Nodes between two readings of the clock in steps that visit node after node; these also take
  /// some 40 microseconds.
  static constexpr std::uint32_t kNodesPerClockLook = 1024;

  std::int64_t ops = kDefaultOps;
  bool (*expired)(void* context) noexcept TERRACUT_NONBLOCKING =
      nullptr;              ///< Returns true when the deadline has passed.
  void* context = nullptr;  ///< Passed to `expired`.
};

/// Counts operations against a CutBudget. Once exhausted, the clock stays exhausted.
class OpClock {
 public:
  explicit OpClock(const CutBudget& budget) noexcept : budget_(budget), limit_(budget.ops) {}

  void spend(std::int64_t ops) noexcept { ops_ += ops; }
  [[nodiscard]] std::int64_t ops() const noexcept { return ops_; }

  /// True if operations or time have run out.
  [[nodiscard]] bool exhausted() noexcept {
    if (ops_ >= limit_) return true;
    if (ops_ < next_look_) return false;
    next_look_ = ops_ + CutBudget::kOpsPerClockLook;
    return expired();
  }

  /// Asks the caller's clock. True if the time is over, however many operations are left.
  [[nodiscard]] bool expired() noexcept {
    if (!expired_ && budget_.expired != nullptr && budget_.expired(budget_.context)) {
      expired_ = true;
      limit_ = ops_;
    }
    return expired_;
  }

 private:
  CutBudget budget_;
  std::int64_t limit_;
  std::int64_t ops_ = 0;
  std::int64_t next_look_ = 0;
  bool expired_ = false;
};

}  // namespace terracut::min_cut
