// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "calib/beams/angle.hpp"
#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/frame/range_image.hpp"

namespace terracut::frame {

/// Head azimuths at which the sensor sends nothing, hundredths of a degree clockwise from straight
/// ahead, [from, to) and perhaps across 0; both 0: none, or not known yet.
struct BlindAzimuths {
  std::int32_t from_cdeg = 0, to_cdeg = 0;

  [[nodiscard]] bool is_none() const noexcept { return from_cdeg == to_cdeg; }
  [[nodiscard]] std::int32_t width_cdeg() const noexcept {
    return beams::wrap_cdeg(to_cdeg - from_cdeg);
  }
};

/// Where the head stood when the first firing of a frame's first and of its last packet was made:
/// revolutions from straight ahead on, about 0 and 1, less and more by how far beams point off the
/// head. The same where there are no packets.
struct HeadSweep {
  float first_turns = 0, last_turns = 0;
};

/// What is known of one frame besides its returns.
struct FrameInfo {
  std::uint32_t number = 0;  ///< 0.. in order of hand-over.
  std::int64_t first_packet_ns =
      0;  ///< Datagram stamp of the first and last packet that touched the frame.
  std::int64_t last_packet_ns = 0;
  HeadSweep head;
  std::uint32_t packets = 0;  ///< Packets decoded since the frame before was handed over.
  std::uint32_t returns = 0;  ///< Returns placed; equals RangeImage::returns().
  /// Every firing of the frame was seen, from seam to seam, but where the sensor is blind.
  bool complete = false;
  BlindAzimuths blind;
  LossCounters losses;  ///< What was lost since the frame before was handed over.
  DeskewInfo deskew;    ///< Whether it was deskewed.
};

/// One frame: what came of one revolution of the head. Whoever hands it out says how long the image
/// is valid.
struct Frame {
  FrameInfo info;
  RangeImage* image = nullptr;
};

/// The frame that is being filled.
struct ArrivingFrame {
  const RangeImage* image = nullptr;
  /// Columns [0, complete_columns) are complete but for packets that come late by more than the
  /// decoder waits for; these may still change any of them.
  int complete_columns = 0;
  /// Of a revolution, until its last packet; what a blind sector leaves out does not count.
  float share_to_come = 0;
};

}  // namespace terracut::frame
