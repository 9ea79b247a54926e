// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ouster/ouster_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "calib/beams/angle.hpp"
#include "calib/ouster/ouster_product.hpp"
#include "calib/text/fnv1a.hpp"

namespace terracut::ouster {
namespace {

constexpr double kMostElevation_deg = 60, kMostOffset_deg = 20;
/// Farther from the axis than any unit's beams begin, metres.
constexpr double kMostOrigin_m = 0.2;

template <class Numbers>
bool has(const Numbers& numbers, int value) {
  return std::ranges::find(numbers, value) != numbers.end();
}

/// True if a transform turns about z only, and moves by less than a metre.
bool turns_about_z(const std::array<double, 12>& T) {
  constexpr double kRounding = 1e-3;
  const auto is_near = [](double value, double wanted) {
    return std::abs(value - wanted) < kRounding;
  };
  const bool is_upright = is_near(T[2], 0) && is_near(T[6], 0) && is_near(T[8], 0) &&
                          is_near(T[9], 0) && is_near(T[10], 1);
  const bool is_rotation =
      is_near(T[0], T[5]) && is_near(T[1], -T[4]) && is_near(T[0] * T[0] + T[1] * T[1], 1);
  return is_upright && is_rotation && std::abs(T[3]) < 1 && std::abs(T[7]) < 1 &&
         std::abs(T[11]) < 1;
}

/// Rounded to thousandths; the smallest int64 where that is no number.
std::int64_t thousandths(double value) {
  return std::abs(value) < 1e12 ? std::llround(value * 1e3)
                                : std::numeric_limits<std::int64_t>::min();
}

}  // namespace

sensor::SensorModel model_of_rows(int rows) noexcept {
  switch (rows) {
    case 32:
      return sensor::SensorModel::kOuster32;
    case 64:
      return sensor::SensorModel::kOuster64;
    case 128:
      return sensor::SensorModel::kOuster128;
    default:
      return sensor::SensorModel::kUnknown;
  }
}

int rows_of(sensor::SensorModel model) noexcept {
  const auto* const found = std::ranges::find(kRows, model, model_of_rows);
  return found == kRows.end() ? kRows.back() : *found;
}

OusterCalibration nominal_ouster(sensor::SensorModel model) {
  return nominal_product(Product::kOs1, model);
}

Status validate(const OusterCalibration& unit) {
  const auto refuse = [&](ErrorCode code, const std::string& what) {
    return fail(code, unit.origin.empty() ? what : unit.origin + ": " + what);
  };
  if (!has(kRows, unit.format.rows)) {
    return refuse(ErrorCode::kUnsupported,
                  fmt::format("{} rows; units of 32, 64 and 128 are read", unit.format.rows));
  }
  const int columns = unit.format.columns;
  if (columns < 1 || columns > kMostColumnsPerPacket || 512 % columns != 0) {
    return refuse(ErrorCode::kUnsupported,
                  fmt::format("{} columns in a packet; 1, 2, 4, 8 and 16 are read", columns));
  }
  if (!has(kColumnsPerFrame, unit.columns_per_frame) ||
      !(unit.rate_hz >= 4 && unit.rate_hz <= 25)) {
    return refuse(ErrorCode::kMalformed,
                  fmt::format("{} columns a frame at {:g} Hz are no mode of an Ouster",
                              unit.columns_per_frame, unit.rate_hz));
  }
  for (const int column : unit.window) {
    if (column < 0 || column >= unit.columns_per_frame) {
      return refuse(ErrorCode::kMalformed, fmt::format("the window ends at column {} of {}", column,
                                                       unit.columns_per_frame));
    }
  }
  if (unit.lasers.size() != static_cast<std::size_t>(unit.format.rows)) {
    return refuse(ErrorCode::kMalformed,
                  fmt::format("{} beams for {} rows", unit.lasers.size(), unit.format.rows));
  }
  for (std::size_t i = 0; i < unit.lasers.size(); ++i) {
    const beams::TableBeam& beam = unit.lasers[i];
    const double elevation_deg = beams::rad_to_deg(beam.elevation_rad);
    const double offset_deg = beams::rad_to_deg(beam.azimuth_offset_rad);
    if (!(std::abs(elevation_deg) <= kMostElevation_deg &&
          std::abs(offset_deg) <= kMostOffset_deg &&
          std::abs(beam.vert_offset_m) <= kMostOrigin_m)) {
      return refuse(
          ErrorCode::kMalformed,
          fmt::format("beam {} points to {:g} degrees of altitude and {:g} of azimuth; "
                      "expected at most {:g} and {:g} either way",
                      i + 1, elevation_deg, offset_deg, kMostElevation_deg, kMostOffset_deg));
    }
  }
  if (!(std::abs(unit.ahead_m) <= kMostOrigin_m && unit.beam_origin_m >= 0 &&
        unit.beam_origin_m <= kMostOrigin_m)) {
    return refuse(ErrorCode::kMalformed,
                  fmt::format("beams begin {:g} m from the origin; expected at most {:g}",
                              unit.beam_origin_m, kMostOrigin_m));
  }
  if (!turns_about_z(unit.T_sensor_lidar)) {
    return refuse(ErrorCode::kMalformed,
                  "lidar_to_sensor_transform is no rotation about the vertical axis");
  }
  return {};
}

std::uint64_t fingerprint(const OusterCalibration& unit) {
  text::Fnv1a hash;
  hash.add(std::int64_t{unit.format.rows});
  hash.add(std::int64_t{unit.columns_per_frame});
  for (const beams::TableBeam& beam : unit.lasers) {
    hash.add(thousandths(beams::rad_to_deg(beam.elevation_rad)));
    hash.add(thousandths(beams::rad_to_deg(beam.azimuth_offset_rad)));
    hash.add(thousandths(beam.vert_offset_m * 1e3));
  }
  hash.add(thousandths(unit.ahead_m * 1e3));
  hash.add(thousandths(unit.beam_origin_m * 1e3));
  for (const double value : unit.T_sensor_lidar) hash.add(thousandths(value * 1e3));
  return hash.value();
}

std::vector<int> rows_by_elevation(const OusterCalibration& unit) {
  return rows_by_elevation(beams::BeamTable{.model = {}, .lasers = unit.lasers, .origin = {}});
}

}  // namespace terracut::ouster
