// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/difop_angles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "calib/beams/angle.hpp"

namespace terracut::ruby128 {
namespace {

using ruby128_wire::Angle;
using Angles = std::array<Angle, kRuby128Lasers>;

constexpr std::string_view kWhatToDo = "give the unit's angle.csv with --calibration FILE";

/// Returns the first channel, from 0, that satisfies `is`.
template <class Predicate>
std::optional<std::size_t> first_channel(const Angles& angles, const Predicate& is) noexcept {
  const auto* const found = std::find_if(angles.begin(), angles.end(), is);
  if (found == angles.end()) return std::nullopt;
  return static_cast<std::size_t>(found - angles.begin());
}
std::optional<std::size_t> first_unset(const Angles& angles) noexcept {
  return first_channel(angles, [](const Angle& angle) { return angle.sign == kDifopUnset; });
}
std::optional<std::size_t> first_with_odd_sign(const Angles& angles) noexcept {
  return first_channel(angles, [](const Angle& angle) {
    return angle.sign != kDifopPlus && angle.sign != kDifopMinus;
  });
}
bool all_zero(const Angles& angles) noexcept {
  return !first_channel(angles, [](const Angle& a) { return a.magnitude_cdeg.value() != 0; });
}

/// Converts an angle with a valid sign to radians.
double radians(const Angle& angle) noexcept {
  const int magnitude_cdeg = angle.magnitude_cdeg.value();
  // Negating a whole number gives no -0.0: an angle sent as -0.00 becomes 0.
  const int cdeg = angle.sign == kDifopMinus ? -magnitude_cdeg : magnitude_cdeg;
  return beams::deg_to_rad(cdeg / 100.0);
}

std::array<Ruby128Channel, kRuby128Lasers> channels_of(const ruby128_wire::Difop& difop) noexcept {
  std::array<Ruby128Channel, kRuby128Lasers> channels;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    channels[i] = {radians(difop.elevations[i]), radians(difop.azimuth_offsets[i])};
  }
  return channels;
}

Angle angle_of(double rad) noexcept {
  constexpr std::int64_t kMost_cdeg = 0xFFFF;
  const std::int64_t cdeg = std::clamp(angle_cdeg(rad), -kMost_cdeg, kMost_cdeg);
  return {cdeg < 0 ? kDifopMinus : kDifopPlus,
          packet::Be16::of(static_cast<std::uint16_t>(cdeg < 0 ? -cdeg : cdeg))};
}

/// Fails with kNoCalibration for angles that were never written, kMalformed for other invalid
/// signs.
Status check_signs(const ruby128_wire::Difop& difop) {
  struct Table {
    const Angles& angles;
    std::string_view what;
  };
  const std::array<Table, 2> tables{
      {{difop.elevations, "elevation"}, {difop.azimuth_offsets, "azimuth offset"}}};
  constexpr std::string_view kNone = "this unit's DIFOP packets hold no angles";
  for (const Table& table : tables) {
    if (const auto channel = first_unset(table.angles)) {
      return fail(ErrorCode::kNoCalibration,
                  fmt::format("{} (the {} of channel {} of 128 has the sign 0xFF); {}", kNone,
                              table.what, *channel + 1, kWhatToDo));
    }
  }
  if (all_zero(difop.elevations)) {
    return fail(ErrorCode::kNoCalibration,
                fmt::format("{} (all elevations are zero); {}", kNone, kWhatToDo));
  }
  for (const Table& table : tables) {
    if (const auto channel = first_with_odd_sign(table.angles)) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("DIFOP packets: the {} of channel {} of 128 has the sign 0x{:02X}, "
                              "expected 0 or 1; {}",
                              table.what, *channel + 1, table.angles[*channel].sign, kWhatToDo));
    }
  }
  return {};
}

}  // namespace

Expected<Ruby128Calibration> calibration_of(const ruby128_wire::Difop& difop) {
  if (const Status status = check_signs(difop); !status) return tl::unexpected(status.error());
  Ruby128Calibration calibration;
  calibration.channels = channels_of(difop);
  calibration.origin = "DIFOP packets";
  if (const Status status = validate(calibration); !status) {
    if (status.error().code == ErrorCode::kUnsupported) return tl::unexpected(status.error());
    return fail(status.error().code, fmt::format("{}; {}", status.error().message, kWhatToDo));
  }
  return calibration;
}

void set_calibration(ruby128_wire::Difop& difop, const Ruby128Calibration& calibration) noexcept {
  for (std::size_t i = 0; i < calibration.channels.size(); ++i) {
    difop.elevations[i] = angle_of(calibration.channels[i].elevation_rad);
    difop.azimuth_offsets[i] = angle_of(calibration.channels[i].azimuth_offset_rad);
  }
}

}  // namespace terracut::ruby128
