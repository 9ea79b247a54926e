// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "moved_return.hpp"
#include "tools/lab/quality/quality.hpp"

namespace terracut::hazards {

struct LabelledFrame;

/// The least number of returns that count in a trial.
inline constexpr std::uint64_t kFewestReturns = 4;

/// The returns of one hazard that count.
struct SeenHazard {
  std::uint64_t returns = 0, as_obstacle = 0;

  /// True if at least two of the returns and at least 30 % of them are called obstacle.
  [[nodiscard]] constexpr bool is_found() const noexcept {
    return as_obstacle >= 2 && 10 * as_obstacle >= 3 * returns;
  }
};

[[nodiscard]] SeenHazard seen_hazard(const MovedReturns& moved,
                                     std::span<const frame::Label> labels) noexcept;

/// The quality of the returns that a trial does not move, labelled before and after it moves
/// others.
struct Elsewhere {
  quality::Quality before, after;

  Elsewhere& operator+=(const Elsewhere& other) noexcept {
    before += other.before;
    after += other.after;
    return *this;
  }
};

[[nodiscard]] Elsewhere elsewhere(const LabelledFrame& frame, const MovedReturns& moved,
                                  std::span<const frame::Label> before,
                                  std::span<const frame::Label> after) noexcept;

/// Trials of one kind of hazard on one kind of ground in one range bin.
struct TrialCounts {
  std::uint64_t trials = 0, found = 0;
  std::uint64_t unseen = 0;  ///< Trials in which no return was called obstacle.
  std::uint64_t returns = 0, as_obstacle = 0;
  Elsewhere elsewhere;

  void add(const SeenHazard& seen, const Elsewhere& of_trial) noexcept {
    ++trials;
    found += seen.is_found() ? 1 : 0;
    unseen += seen.as_obstacle == 0 ? 1 : 0;
    returns += seen.returns;
    as_obstacle += seen.as_obstacle;
    elsewhere += of_trial;
  }
  TrialCounts& operator+=(const TrialCounts& other) noexcept {
    trials += other.trials;
    found += other.found;
    unseen += other.unseen;
    returns += other.returns;
    as_obstacle += other.as_obstacle;
    elsewhere += other.elsewhere;
    return *this;
  }
};

}  // namespace terracut::hazards
