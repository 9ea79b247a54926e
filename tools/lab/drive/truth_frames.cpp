// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "truth_frames.hpp"

#include <cstddef>
#include <utility>

#include "calib/beams/angle.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"
#include "tools/lab/packets/encoder_traits.hpp"

namespace terracut::drive {

template <class EncoderTraits>
void TruthFrames<EncoderTraits>::add(std::span<const Column> columns) {
  const auto returns = static_cast<std::size_t>(packets::returns_per_firing(returns_));
  packets::GroupAzimuths rotor{.before_cdeg = last_cdeg_};
  for (std::size_t i = 0; i < columns.size(); i += returns) {
    rotor.cdeg[i / returns] = beams::wrap_cdeg(columns[i].unwrapped_azimuth_cdeg);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::int32_t step_ticks =
        EncoderTraits::step_ticks(rotor, static_cast<int>(i / returns), returns_);
    for (int laser = 0; laser < EncoderTraits::kLasers; ++laser) {
      const packets::LabelledReturn& labelled =
          columns[i].by_laser[static_cast<std::size_t>(laser)];
      if (labelled.raw == 0) continue;
      const std::int32_t offset_ticks =
          EncoderTraits::offset_ticks(offsets_, step_ticks, laser, returns_);
      const packet::BeamAzimuth beam =
          packet::beam_azimuth(columns[i].unwrapped_azimuth_cdeg, offset_ticks);
      by_frame_[beam.frame].push_back(labelled.truth);
    }
  }
  last_cdeg_ = beams::wrap_cdeg(columns.back().unwrapped_azimuth_cdeg);
  oldest_reachable_ =
      packet::beam_azimuth(columns.back().unwrapped_azimuth_cdeg, offsets_.hindmost_ticks()).frame;
}

template <class EncoderTraits>
bool TruthFrames<EncoderTraits>::take_finished(std::vector<std::uint32_t>& labels) {
  if (by_frame_.empty() || by_frame_.begin()->first >= oldest_reachable_) return false;
  return take_any(labels);
}

template <class EncoderTraits>
bool TruthFrames<EncoderTraits>::take_any(std::vector<std::uint32_t>& labels) {
  if (by_frame_.empty()) return false;
  labels = std::move(by_frame_.begin()->second);
  by_frame_.erase(by_frame_.begin());
  return true;
}

#define TERRACUT_INSTANTIATE(EncoderTraits) template class TruthFrames<EncoderTraits>;
TERRACUT_FOR_ENCODER_TRAITS(TERRACUT_INSTANTIATE)
#undef TERRACUT_INSTANTIATE

}  // namespace terracut::drive
