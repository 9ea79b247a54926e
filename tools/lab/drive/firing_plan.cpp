// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firing_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "calib/beams/angle.hpp"

namespace terracut::drive {
namespace {

constexpr double kLeastRunUp_cdeg = 1100;
constexpr double kSpareRunUp_cdeg = 100;

}  // namespace

template <class EncoderTraits>
FiringPlan<EncoderTraits>::FiringPlan(const typename EncoderTraits::Calibration& calibration,
                                      packets::ReturnMode returns, double spin_hz,
                                      std::int64_t frames)
    : returns_(returns),
      frames_(frames),
      group_(EncoderTraits::firings_per_group(returns)),
      cdeg_per_s_(spin_hz * beams::kRevolution_cdeg),
      firing_s_(static_cast<double>(EncoderTraits::firing_ns(returns)) * 1e-9) {
  const double widest_cdeg = 100 * beams::rad_to_deg(EncoderTraits::widest_offset_rad(calibration));
  const double run_up_cdeg = std::max(kLeastRunUp_cdeg, widest_cdeg + kSpareRunUp_cdeg);
  start_cdeg_ = -run_up_cdeg;
  const double way_cdeg = static_cast<double>(frames) * beams::kRevolution_cdeg + 2 * run_up_cdeg;
  const double firings = way_cdeg / (cdeg_per_s_ * firing_s_);
  firings_ = static_cast<std::int64_t>(std::ceil(firings / static_cast<double>(group_))) * group_;
}

template <class EncoderTraits>
std::int64_t FiringPlan<EncoderTraits>::azimuth_cdeg(std::int64_t index) const noexcept {
  return std::llround(start_cdeg_ + static_cast<double>(index) * firing_s_ * cdeg_per_s_);
}

template <class EncoderTraits>
Firing FiringPlan<EncoderTraits>::firing(std::int64_t index) const noexcept {
  const std::int64_t place = index % group_;
  const std::int64_t first = index - place;
  packets::GroupAzimuths rotor;
  for (std::int64_t i = 0; i < group_; ++i) {
    rotor.cdeg[static_cast<std::size_t>(i)] = beams::wrap_cdeg(azimuth_cdeg(first + i));
  }
  if (first > 0) rotor.before_cdeg = beams::wrap_cdeg(azimuth_cdeg(first - 1));
  return {index, azimuth_cdeg(index),
          EncoderTraits::step_ticks(rotor, static_cast<int>(place), returns_),
          static_cast<double>(index) * firing_s_ + start_cdeg_ / cdeg_per_s_};
}

#define TERRACUT_INSTANTIATE(EncoderTraits) template class FiringPlan<EncoderTraits>;
TERRACUT_FOR_ENCODER_TRAITS(TERRACUT_INSTANTIATE)
#undef TERRACUT_INSTANTIATE

}  // namespace terracut::drive
