// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "tools/lab/packets/encoder_traits.hpp"
#include "tools/lab/packets/return_mode.hpp"

namespace terracut::drive {

/// One firing of all lasers.
struct Firing {
  std::int64_t index = 0;
  std::int64_t azimuth_cdeg = 0;  ///< Of the head as the wire has it, unwrapped.
  std::int32_t step_ticks = 0;    ///< The step by which a decoder computes its beams.
  double time_s = 0;              ///< 0 when the head passes straight ahead for the first time.
};

/// When and where the head fires during a drive of whole frames, with the run-up and run-out that
/// let every laser see them whole. Whole packets.
template <class EncoderTraits>
class FiringPlan {
 public:
  FiringPlan(const typename EncoderTraits::Calibration& calibration, packets::ReturnMode returns,
             double spin_hz, std::int64_t frames);

  [[nodiscard]] std::int64_t frames() const noexcept { return frames_; }
  [[nodiscard]] std::int64_t firings() const noexcept { return firings_; }
  [[nodiscard]] Firing firing(std::int64_t index) const noexcept;
  /// From the first firing to this one.
  [[nodiscard]] std::int64_t after_ns(std::int64_t index) const noexcept {
    return index * EncoderTraits::firing_ns(returns_);
  }
  /// Frames that are not wanted lie before the first seam or after the last one.
  [[nodiscard]] bool wants(std::int64_t frame) const noexcept {
    return frame >= 0 && frame < frames_;
  }

 private:
  [[nodiscard]] std::int64_t azimuth_cdeg(std::int64_t index) const noexcept;

  packets::ReturnMode returns_;
  std::int64_t frames_;
  std::int64_t group_;  ///< Firings that fill whole packets.
  double start_cdeg_;   ///< < 0
  double cdeg_per_s_;
  double firing_s_;
  std::int64_t firings_;
};

}  // namespace terracut::drive
