// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstdint>

#include "calib/beams/angle.hpp"
#include "tools/lab/packets/encoder_traits.hpp"

namespace terracut::drive {

/// The azimuths, as sent, of a steadily rotating head's firings. `EncoderTraits`:
/// encoder_traits.hpp.
template <class EncoderTraits>
class HeadAzimuths {
 public:
  /// The first firing is at `start_cdeg`, or, where columns are numbered, at the last column at or
  /// before it that begins a packet. `spin_hz` counts where columns are not numbered.
  HeadAzimuths(const typename EncoderTraits::Calibration& unit, packets::ReturnMode returns,
               double spin_hz, double start_cdeg)
      : unit_(unit),
        start_cdeg_(start_cdeg),
        cdeg_per_s_(spin_hz * beams::kRevolution_cdeg),
        firing_s_(static_cast<double>(packets::firing_ns<EncoderTraits>(unit, returns)) * 1e-9) {
    if constexpr (packets::kHasNumberedColumns<EncoderTraits>) {
      const double cdeg_per_column = beams::kRevolution_cdeg / double(unit.columns_per_frame);
      const int group = EncoderTraits::firings_per_group(returns);
      first_ = static_cast<std::int64_t>(std::floor(start_cdeg / cdeg_per_column / group)) * group;
      start_cdeg_ = static_cast<double>(first_) * cdeg_per_column;
      cdeg_per_s_ = cdeg_per_column / firing_s_;
    }
  }

  [[nodiscard]] double start_cdeg() const noexcept { return start_cdeg_; }
  [[nodiscard]] double cdeg_per_s() const noexcept { return cdeg_per_s_; }
  [[nodiscard]] double firing_s() const noexcept { return firing_s_; }
  /// Returns the azimuth of a firing, which counts on over revolutions.
  [[nodiscard]] std::int64_t azimuth_cdeg(std::int64_t firing) const noexcept {
    if constexpr (packets::kHasNumberedColumns<EncoderTraits>) {
      return EncoderTraits::numbered_cdeg(unit_, first_ + firing);
    } else {
      return std::llround(start_cdeg_ + static_cast<double>(firing) * firing_s_ * cdeg_per_s_);
    }
  }

 private:
  typename EncoderTraits::Calibration unit_;
  std::int64_t first_ = 0;  ///< Number of the first column, counted on over revolutions.
  double start_cdeg_, cdeg_per_s_, firing_s_;
};

}  // namespace terracut::drive
