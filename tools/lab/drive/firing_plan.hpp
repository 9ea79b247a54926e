// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "tools/lab/drive/head_azimuths.hpp"
#include "tools/lab/packets/encoder_traits.hpp"
#include "tools/lab/packets/return_mode.hpp"

namespace terracut::drive {

/// One firing of all lasers.
struct Firing {
  std::int64_t index = 0;
  std::int64_t azimuth_cdeg = 0;  ///< Azimuth of the head as sent, unwrapped.
  std::int32_t step_ticks = 0;    ///< The step with which a decoder computes the beams' azimuths.
  double time_s = 0;              ///< Time since the head first pointed straight ahead.
};

/// The times and azimuths of the head's firings in a drive of whole frames, with a run-up and a
/// run-out so that every laser covers these frames. The firings fill whole packets.
template <class EncoderTraits>
class FiringPlan {
 public:
  FiringPlan(const typename EncoderTraits::Calibration& calibration, packets::ReturnMode returns,
             double spin_hz, std::int64_t frames);

  [[nodiscard]] std::int64_t frames() const noexcept { return frames_; }
  [[nodiscard]] std::int64_t firings() const noexcept { return firings_; }
  [[nodiscard]] Firing firing(std::int64_t index) const noexcept;
  /// Returns the time from the first firing to the firing `index`.
  [[nodiscard]] std::int64_t after_ns(std::int64_t index) const noexcept {
    return index * firing_ns_;
  }
  /// True unless the frame lies before the first seam or after the last one.
  [[nodiscard]] bool wants(std::int64_t frame) const noexcept {
    return frame >= 0 && frame < frames_;
  }

 private:
  packets::ReturnMode returns_;
  std::int64_t frames_;
  std::int64_t group_;  ///< Number of firings that fill whole packets.
  std::int64_t firing_ns_;
  HeadAzimuths<EncoderTraits> head_;  ///< Starts before straight ahead.
  std::int64_t firings_;
};

}  // namespace terracut::drive
