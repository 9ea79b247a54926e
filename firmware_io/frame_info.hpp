// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "firmware_io/loss_counters.hpp"
#include "firmware_io/motion/deskew_info.hpp"
#include "pipeline/range_image.hpp"

namespace terracut::firmware_io {

/// What is known of one turn besides its returns.
struct FrameInfo {
  std::uint32_t number = 0;  ///< 0.. in order of hand-over.
  std::int64_t first_packet_ns =
      0;  ///< Datagram stamp of the first and last packet that touched the turn.
  std::int64_t last_packet_ns = 0;
  std::uint32_t packets = 0;  ///< Packets decoded since the frame before was handed over.
  std::uint32_t returns = 0;  ///< Returns placed; equals RangeImage::returns().
  bool complete = false;      ///< Every firing of the turn was seen, from seam to seam.
  LossCounters losses;        ///< What was lost since the frame before was handed over.
  DeskewInfo deskew;          ///< Whether the vehicle's motion was taken out of it.
};

/// The turn that is being filled.
struct ArrivingTurn {
  const pipeline::RangeImage* image = nullptr;
  /// Columns [0, settled_columns) are complete but for packets that come late by more than the
  /// decoder waits for; these may still change any of them.
  int settled_columns = 0;
  bool is_ending = false;  ///< It will be handed over within a fiftieth of a turn.
};

}  // namespace terracut::firmware_io
