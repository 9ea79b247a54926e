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
/// ahead, [from, to), perhaps across 0. Both 0: none, or not known yet.
struct BlindAzimuths {
  std::int32_t from_cdeg = 0, to_cdeg = 0;

  [[nodiscard]] bool is_none() const noexcept { return from_cdeg == to_cdeg; }
  [[nodiscard]] std::int32_t width_cdeg() const noexcept {
    return beams::wrap_cdeg(to_cdeg - from_cdeg);
  }
};

/// The head's position at the first firing of a frame's first and last packet: revolutions from
/// straight ahead, about 0 and 1, off by as much as beams point off the head. Both equal if there
/// are no packets.
struct HeadSweep {
  float first_turns = 0, last_turns = 0;
};

/// Facts about one frame besides its returns.
struct FrameInfo {
  std::uint32_t number = 0;          ///< From 0, in order of hand-over.
  std::int64_t first_packet_ns = 0;  ///< Datagram stamps of the first and last packet touching it.
  std::int64_t last_packet_ns = 0;
  HeadSweep head;
  std::uint32_t packets = 0;  ///< Packets decoded since the last frame was handed over.
  std::uint32_t returns = 0;  ///< Returns placed; equals RangeImage::returns().
  /// True if every firing of the frame was seen, from seam to seam, except where the sensor is
  /// blind.
  bool complete = false;
  BlindAzimuths blind;
  LossCounters losses;  ///< Losses since the last frame was handed over.
  DeskewInfo deskew;    ///< Whether it was deskewed.
};

/// One frame: the returns of one revolution of the head. Whoever hands it out says how long the
/// image is valid.
struct Frame {
  FrameInfo info;
  RangeImage* image = nullptr;
};

/// The frame that is being filled.
struct ArrivingFrame {
  const RangeImage* image = nullptr;
  /// Columns [0, complete_columns) are complete, but a packet later than the decoder waits for may
  /// still change any of them.
  int complete_columns = 0;
  /// Share of the revolution until its last packet; a blind sector does not count.
  float share_to_come = 0;
};

}  // namespace terracut::frame
