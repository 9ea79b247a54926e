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

/// Identifies a frame labelled by a method.
struct FrameKey {
  std::string sequence;  ///< "00"
  std::string frame;     ///< "000042"
  std::string method;    ///< "terracut"
  friend auto operator<=>(const FrameKey&, const FrameKey&) = default;
};

/// Processor time of the working thread, in nanoseconds.
struct FrameTimes {
  std::array<std::int64_t, stage::kStages> stage_ns{};  ///< All 0 for methods without stages.
  std::int64_t decode_ns = 0;                           ///< Time of decoding; 0 without packets.
  std::int64_t segment_ns = 0;  ///< All stages, from the range image to the labels.
};

/// The result of one frame under one method.
struct FrameResult {
  statistics::FrameCounts counts;
  statistics::TallCounts tall;
  statistics::FlipCounts flips;  ///< Zero if the previous frame or the motion is unknown.
  std::uint64_t points = 0;      ///< Points of the file.
  std::uint64_t non_finite = 0;  ///< Invalid points: not labelled, not counted.
  std::uint64_t no_ring = 0;     ///< Points without a known laser; they count as obstacle.
  std::uint64_t not_placed = 0;  ///< Points lost otherwise; they count as obstacle.
  bool rings_realigned = false;  ///< True if the file did not have 64 rings.
  FrameTimes times;
};

/// The results in order of sequence, frame and method, whatever the order of the work.
using FrameResults = std::map<FrameKey, FrameResult>;

}  // namespace terracut::eval
