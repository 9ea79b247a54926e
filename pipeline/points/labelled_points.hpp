// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/points/labelled_point.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::points {

/// The times of a frame's returns from its packets: the head rotated evenly from the first packet
/// to the last. The default, all at 0, is for clouds without times.
struct FrameTiming {
  frame::HeadSweep head;
  double duration_s = 0;              ///< From the first packet to the last.
  std::span<const float> beam_turns;  ///< decode::Decoder::beam_turns(); one a row, or empty.

  /// Makes the timing of a frame whose decoder has these beams.
  [[nodiscard]] static FrameTiming of(const frame::FrameInfo& info,
                                      std::span<const float> beam_turns) noexcept {
    constexpr double kSecond_ns = 1e9;
    return {info.head, static_cast<double>(info.last_packet_ns - info.first_packet_ns) / kSecond_ns,
            beam_turns};
  }
};

/// Writes the returns of a labelled frame to the first `image.returns()` elements of `points`, in
/// order of arrival: the n-th is the n-th of a .label file. `labels` has one entry a return, by
/// return index. False, and nothing written, if there are not as many labels as returns or too
/// little room. Times are right to half a column and to the head's unevenness; all 0 with the
/// default `timing`. Real-time safe.
[[nodiscard]] bool pack_labelled_points(
    const frame::RangeImage& image, std::span<const frame::Label> labels,
    std::span<LabelledPoint> points, const FrameTiming& timing = {}) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::points
