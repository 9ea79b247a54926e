// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/difop_angles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/robosense/unit_table.hpp"
#include "firmware_io/packet/robosense_wire.hpp"

namespace terracut::ruby128 {
namespace {

using ruby128_wire::Angle;
using Angles = std::span<const Angle>;

constexpr std::string_view kWhatToDo = "give the unit's angle.csv with --calibration FILE";

/// Returns the first channel, from 0, that satisfies `is`.
template <class Predicate>
std::optional<std::size_t> first_channel(Angles angles, const Predicate& is) noexcept {
  const auto found = std::find_if(angles.begin(), angles.end(), is);
  if (found == angles.end()) return std::nullopt;
  return static_cast<std::size_t>(found - angles.begin());
}
std::optional<std::size_t> first_unset(Angles angles) noexcept {
  return first_channel(angles, [](const Angle& angle) { return angle.sign == kDifopUnset; });
}
std::optional<std::size_t> first_with_odd_sign(Angles angles) noexcept {
  return first_channel(angles, [](const Angle& angle) {
    return angle.sign != kDifopPlus && angle.sign != kDifopMinus;
  });
}
bool all_zero(Angles angles) noexcept {
  return !first_channel(angles, [](const Angle& a) { return a.magnitude.value() != 0; });
}

/// Returns an angle with a valid sign as a number of its unit.
int units_of(const Angle& angle) noexcept {
  const int magnitude = angle.magnitude.value();
  // Negating a whole number gives no -0.0: an angle sent as -0.00 becomes 0.
  return angle.sign == kDifopMinus ? -magnitude : magnitude;
}
double radians(const Angle& angle) noexcept {
  return beams::deg_to_rad(units_of(angle) / 100.0);
}

std::array<Ruby128Channel, kRuby128Lasers> channels_of(const ruby128_wire::Difop& difop) noexcept {
  std::array<Ruby128Channel, kRuby128Lasers> channels;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    channels[i] = {radians(difop.elevations[i]), radians(difop.azimuth_offsets[i])};
  }
  return channels;
}

Angle angle_of(std::int64_t units) noexcept {
  constexpr std::int64_t kMost = 0xFFFF;
  const std::int64_t sent = std::clamp(units, -kMost, kMost);
  return {sent < 0 ? kDifopMinus : kDifopPlus,
          packet::Be16::of(static_cast<std::uint16_t>(sent < 0 ? -sent : sent))};
}

/// Fails with kNoCalibration for angles that were never written, kMalformed for other invalid
/// signs.
Status check_signs(Angles elevations, Angles azimuth_offsets) {
  struct Table {
    Angles angles;
    std::string_view what;
  };
  const std::array<Table, 2> tables{
      {{elevations, "elevation"}, {azimuth_offsets, "azimuth offset"}}};
  constexpr std::string_view kNone = "this unit's DIFOP packets hold no angles";
  for (const Table& table : tables) {
    if (const auto channel = first_unset(table.angles)) {
      return fail(ErrorCode::kNoCalibration,
                  fmt::format("{} (the {} of channel {} of {} has the sign 0xFF); {}", kNone,
                              table.what, *channel + 1, table.angles.size(), kWhatToDo));
    }
  }
  if (all_zero(elevations)) {
    return fail(ErrorCode::kNoCalibration,
                fmt::format("{} (all elevations are zero); {}", kNone, kWhatToDo));
  }
  for (const Table& table : tables) {
    if (const auto channel = first_with_odd_sign(table.angles)) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("DIFOP packets: the {} of channel {} of {} has the sign 0x{:02X}, "
                              "expected 0 or 1; {}",
                              table.what, *channel + 1, table.angles.size(),
                              table.angles[*channel].sign, kWhatToDo));
    }
  }
  return {};
}

}  // namespace

Expected<Ruby128Calibration> calibration_of(const ruby128_wire::Difop& difop) {
  if (const Status status = check_signs(difop.elevations, difop.azimuth_offsets); !status) {
    return tl::unexpected(status.error());
  }
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
    difop.elevations[i] = angle_of(angle_cdeg(calibration.channels[i].elevation_rad));
    difop.azimuth_offsets[i] = angle_of(angle_cdeg(calibration.channels[i].azimuth_offset_rad));
  }
}

Expected<beams::BeamTable> table_of(const ruby128_wire::Difop& difop, sensor::SensorModel model) {
  const auto elevations = std::span(difop.elevations).first<robosense::kLasers>();
  const auto offsets =
      std::span(difop.elevations).subspan<robosense::kLasers, robosense::kLasers>();
  if (const Status status = check_signs(elevations, offsets); !status) {
    return tl::unexpected(status.error());
  }
  const double unit_deg = robosense::layout_of(model).device_angle_deg;
  std::vector<robosense::AngleLine> angles;
  for (std::size_t i = 0; i < elevations.size(); ++i) {
    angles.push_back({units_of(elevations[i]) * unit_deg, units_of(offsets[i]) * unit_deg});
  }
  auto table = robosense::table_of(model, angles, "DIFOP packets");
  if (table) return table;
  return fail(table.error().code, fmt::format("{}; {}", table.error().message, kWhatToDo));
}

void set_table(ruby128_wire::Difop& difop, const beams::BeamTable& table) noexcept {
  const double unit_deg = robosense::layout_of(table.model).device_angle_deg;
  const auto sent = [&](double rad) {
    return angle_of(std::llround(beams::rad_to_deg(rad) / unit_deg));
  };
  for (std::size_t i = 0; i < table.lasers.size(); ++i) {
    difop.elevations[i] = sent(table.lasers[i].elevation_rad);
    difop.elevations[robosense::kLasers + i] = sent(table.lasers[i].azimuth_offset_rad);
  }
}

}  // namespace terracut::ruby128
