// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "tools/lab/drive/head_azimuths.hpp"
#include "tools/lab/packets/encoder_traits.hpp"
#include "tools/lab/packets/table_encoder_traits.hpp"

namespace terracut::test {

struct RandomColumns {
  packets::ReturnMode returns = packets::ReturnMode::kSingle;
  double spin_hz = 10;
  double first_cdeg = 34'900;                ///< Head azimuth of the first firing.
  double last_cdeg = 37'100 + 2.0 * 36'000;  ///< No group of firings begins beyond.
  double share_of_returns = 0.5;
  std::int64_t first_stamp_ns = 1'767'225'600'000'000'000;
  std::uint32_t seed = 1;
};

/// The smallest distance that is one.
template <class EncoderTraits>
inline constexpr unsigned kLeastCount = 1;
template <class Model>
inline constexpr unsigned kLeastCount<packets::HesaiEncoderTraits<Model>> =
    hesai::layout_of(Model::kModel).least_count;

/// Columns of a steadily rotating head that measures noise; whole packets. Every return's truth
/// says which return it is: its number in order of arrival, and its intensity in the low eight
/// bits.
template <class EncoderTraits>
std::vector<typename EncoderTraits::Column> random_columns(const RandomColumns& settings) {
  std::mt19937 random(settings.seed);
  std::uniform_real_distribution<double> chance(0, 1);
  std::uniform_int_distribution<unsigned> distance(kLeastCount<EncoderTraits>, 65'535),
      byte(0, 255);
  const auto unit = packets::unit_in_mode<EncoderTraits>(EncoderTraits::nominal(), settings.returns,
                                                         settings.spin_hz);
  const std::int64_t firing_ns = packets::firing_ns<EncoderTraits>(unit, settings.returns);
  const drive::HeadAzimuths<EncoderTraits> head(unit, settings.returns, settings.spin_hz,
                                                settings.first_cdeg);
  const int group = EncoderTraits::firings_per_group(settings.returns);
  std::vector<typename EncoderTraits::Column> columns;
  std::uint32_t number = 0;
  for (std::int64_t firing = 0;; ++firing) {
    const std::int64_t rotor_cdeg = head.azimuth_cdeg(firing);
    if (static_cast<double>(rotor_cdeg) > settings.last_cdeg && firing % group == 0) return columns;
    for (int i = 0; i < packets::returns_per_firing(settings.returns); ++i) {
      auto& column = columns.emplace_back();
      column.stamp_ns = settings.first_stamp_ns + firing * firing_ns;
      column.unwrapped_azimuth_cdeg = rotor_cdeg;
      for (packets::LabelledReturn& beam : column.by_laser) {
        if (chance(random) >= settings.share_of_returns) continue;
        beam.raw = static_cast<std::uint16_t>(distance(random));
        beam.intensity = static_cast<std::uint8_t>(byte(random));
        beam.truth = number++ << 8 | beam.intensity;
      }
    }
  }
}

}  // namespace terracut::test
