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

/// How far the head turns before and after the frames, so that every laser covers them.
template <class EncoderTraits>
double run_up_cdeg(const typename EncoderTraits::Calibration& calibration) {
  const double widest_cdeg = 100 * beams::rad_to_deg(EncoderTraits::widest_offset_rad(calibration));
  return std::max(kLeastRunUp_cdeg, widest_cdeg + kSpareRunUp_cdeg);
}

}  // namespace

template <class EncoderTraits>
FiringPlan<EncoderTraits>::FiringPlan(const typename EncoderTraits::Calibration& calibration,
                                      packets::ReturnMode returns, double spin_hz,
                                      std::int64_t frames)
    : returns_(returns),
      frames_(frames),
      group_(EncoderTraits::firings_per_group(returns)),
      firing_ns_(packets::firing_ns<EncoderTraits>(calibration, returns)),
      head_(calibration, returns, spin_hz, -run_up_cdeg<EncoderTraits>(calibration)) {
  const double way_cdeg = static_cast<double>(frames) * beams::kRevolution_cdeg -
                          head_.start_cdeg() + run_up_cdeg<EncoderTraits>(calibration);
  const double firings = way_cdeg / (head_.cdeg_per_s() * head_.firing_s());
  firings_ = static_cast<std::int64_t>(std::ceil(firings / static_cast<double>(group_))) * group_;
}

template <class EncoderTraits>
Firing FiringPlan<EncoderTraits>::firing(std::int64_t index) const noexcept {
  const std::int64_t place = index % group_;
  const std::int64_t first = index - place;
  packets::GroupAzimuths rotor;
  for (std::int64_t i = 0; i < group_; ++i) {
    rotor.cdeg[static_cast<std::size_t>(i)] = beams::wrap_cdeg(head_.azimuth_cdeg(first + i));
  }
  if (first > 0) rotor.before_cdeg = beams::wrap_cdeg(head_.azimuth_cdeg(first - 1));
  return {index, head_.azimuth_cdeg(index),
          EncoderTraits::step_ticks(rotor, static_cast<int>(place), returns_),
          static_cast<double>(index) * head_.firing_s() + head_.start_cdeg() / head_.cdeg_per_s()};
}

#define TERRACUT_INSTANTIATE(EncoderTraits) template class FiringPlan<EncoderTraits>;
TERRACUT_FOR_ENCODER_TRAITS(TERRACUT_INSTANTIATE)
#undef TERRACUT_INSTANTIATE

}  // namespace terracut::drive
