// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "pipeline/free_way/sector.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/eval/labelled_by_all.hpp"
#include "tools/research/eval/method_choice.hpp"

namespace terracut::free_measures {

/// A distance is right within this.
inline constexpr float kRight_m = 0.2F;
/// Sectors are compared with the truth up to here.
inline constexpr float kJudged_m = 30;

inline constexpr std::size_t kRangeBins = 4;  ///< The number of hazards::kRangeBins.

/// How the nearest obstacles of sectors compare with the true ones.
struct SectorCounts {
  std::uint64_t right = 0;    ///< The distance is right.
  std::uint64_t nearer = 0;   ///< Something is called an obstacle before the true one.
  std::uint64_t farther = 0;  ///< The true one is missed, or only what lies behind it is found.
  std::uint64_t empty = 0;    ///< Neither has one up to kJudged_m.
};

/// Boxes or pits that were put into frames at one range.
struct PutIn {
  std::uint64_t trials = 0;
  std::uint64_t failed = 0;  ///< Boxes of which nothing is found at their distance or before it;
                             ///< pits run over.
  std::uint64_t nearer = 0;  ///< Boxes before which something else is called an obstacle.
  double worst_m = 0;  ///< How far behind a box's front it was found, or beyond a pit's near edge
                       ///< ground was seen, at most.
};

/// The free way of some frames, of one method.
struct FreeCounts {
  std::uint64_t frames = 0, sectors = 0;
  double milliseconds = 0;  ///< Processor time, the shortest of three a frame.
  double seen_m = 0;        ///< Sum over sectors.
  std::array<std::uint64_t, static_cast<std::size_t>(free_way::SeenEnd::kCount)> seen_ends{};
  SectorCounts obstacles;
  std::array<PutIn, kRangeBins> boxes, pits;  ///< By hazards::kRangeBins.
};

/// Finds the free way in labelled frames and compares it with the truth; then puts boxes of the
/// detection contract's height and open pits of 1 m x 1 m into the road, one at a time, labels the
/// frame again, and looks whether each box is found at its distance and no pit is run over. For any
/// thread.
class FreeTrials {
 public:
  /// `methods` and `classes` must outlive this object.
  FreeTrials(std::span<const eval::MethodChoice> methods, const datasets::ClassTable& classes,
             int trials, std::uint64_t seed)
      : methods_(methods),
        classes_(classes),
        trials_(trials),
        seed_(seed),
        counts_(methods.size()) {}

  void look(const eval::LabelledByAll& frame);

  /// Must not be called during look().
  [[nodiscard]] const FreeCounts& counts(std::size_t method) const { return counts_[method]; }

 private:
  std::span<const eval::MethodChoice> methods_;
  const datasets::ClassTable& classes_;
  int trials_;  // of boxes, and of pits, in a frame and a range bin
  std::uint64_t seed_;
  std::mutex mutex_;  ///< Guards the following member.
  std::vector<FreeCounts> counts_;
};

}  // namespace terracut::free_measures
