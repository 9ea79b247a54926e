// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <string>

#include "pipeline/stage/stage.hpp"
#include "tools/research/statistics/frame_counts.hpp"

namespace terracut::eval {

/// Which labelling of which frame.
struct FrameKey {
  std::string sequence;  ///< "00"
  std::string frame;     ///< "000042"
  std::string method;    ///< "terracut"
  friend auto operator<=>(const FrameKey&, const FrameKey&) = default;
};

/// Processor time, nanoseconds of the thread that did the work.
struct FrameTimes {
  std::array<std::int64_t, stage::kStages> stage_ns{};  ///< All 0 for methods without stages.
  std::int64_t decode_ns = 0;                           ///< 0 without packets.
  std::int64_t segment_ns = 0;  ///< All stages, from the range image to the labels.
};

/// What came of one frame under one method.
struct FrameResult {
  statistics::FrameCounts counts;
  statistics::TallCounts tall;
  statistics::FlipCounts
      flips;                 ///< Zero where the frame before, or the motion since, is not known.
  std::uint64_t points = 0;  ///< Of the file.
  std::uint64_t non_finite = 0;  ///< Of them, no place: not labelled, count nowhere.
  std::uint64_t no_ring = 0;     ///< Of them, of no laser that could be told: called obstacle.
  std::uint64_t not_placed = 0;  ///< Of them, lost otherwise on the way: called obstacle.
  bool rings_realigned = false;  ///< The file had other than 64 rings.
  FrameTimes times;
};

/// In order of sequence, frame, method, whoever worked them out and when.
using FrameResults = std::map<FrameKey, FrameResult>;

}  // namespace terracut::eval
