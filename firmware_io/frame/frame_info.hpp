// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "calib/beams/angle.hpp"
#include "firmware_io/frame/deskew_info.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/frame/measured_returns.hpp"

namespace terracut::frame {

/// Range of head azimuths, [from, to), perhaps across 0, at which the sensor sends nothing;
/// hundredths of a degree clockwise from straight ahead. Both 0: none, or not known yet.
struct BlindAzimuths {
  std::int32_t from_cdeg = 0, to_cdeg = 0;

  [[nodiscard]] bool is_none() const noexcept { return from_cdeg == to_cdeg; }
  [[nodiscard]] std::int32_t width_cdeg() const noexcept {
    return beams::wrap_cdeg(to_cdeg - from_cdeg);
  }
};

/// The head's azimuth at the first firing of a frame's first and last packet, in revolutions from
/// straight ahead: about 0 and 1, but not exactly, because beams point beside the head. Both are
/// equal if there are no packets.
struct HeadSweep {
  float first_turns = 0, last_turns = 0;
};

/// Facts about one frame besides its returns.
struct FrameInfo {
  std::uint32_t number = 0;  ///< Number of the frame, from 0, in order of hand-over.
  /// Datagram stamps of the first and last packet that touch the frame.
  std::int64_t first_packet_ns = 0;
  std::int64_t last_packet_ns = 0;
  HeadSweep head;
  std::uint32_t packets = 0;  ///< Packets decoded since the last frame was handed over.
  std::uint32_t returns = 0;  ///< Returns placed; equals MeasuredReturns::returns().
  /// True if every firing of the frame was seen, from seam to seam, except where the sensor is
  /// blind.
  bool complete = false;
  BlindAzimuths blind;
  LossCounters losses;  ///< Losses since the last frame was handed over.
  DeskewInfo deskew;    ///< Whether and how the frame was deskewed.
};

/// One frame: the returns of one revolution of the head, as measured. The function that hands the
/// frame out says how long they are valid.
struct Frame {
  FrameInfo info;
  MeasuredReturns* returns = nullptr;
  /// If the frame is deskewed, how its points are to be moved: one element per row, valid as long
  /// as the returns. Else empty.
  std::span<const PlanarMotions> motions;
};

/// The oldest frame of a decoder, while packets still fill it.
struct ArrivingFrame {
  const MeasuredReturns* returns = nullptr;
  /// Columns [0, complete_columns) are complete; only a packet later than the decoder waits for may
  /// still change them.
  int complete_columns = 0;
};

}  // namespace terracut::frame
