// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/beams/beam_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "calib/beams/angle.hpp"
#include "calib/text/fnv1a.hpp"

namespace terracut::beams {

BeamTable built_in_table(sensor::SensorModel model) {
  const sensor::SensorRow& row = sensor::row_of(model);
  BeamTable calibration{
      model,
      {},
      fmt::format("{} table of the {}", row.has_unit_tables ? "nominal" : "factory", row.name)};
  for (const sensor::FactoryLaser& laser : row.lasers) {
    calibration.lasers.push_back({deg_to_rad(laser.elevation_deg),
                                  deg_to_rad(laser.azimuth_offset_deg),
                                  laser.vert_offset_mm * 1e-3});
  }
  return calibration;
}

Status validate(const BeamTable& calibration) {
  const std::size_t lasers = sensor::row_of(calibration.model).lasers.size();
  const bool is_whole = calibration.lasers.size() == lasers;
  const bool are_finite = std::ranges::all_of(calibration.lasers, [](const TableBeam& laser) {
    return std::isfinite(laser.elevation_rad) && std::isfinite(laser.azimuth_offset_rad) &&
           std::isfinite(laser.vert_offset_m);
  });
  if (is_whole && are_finite) return {};
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("table of a {}: expected {} lasers with finite angles, found {} lasers",
                          to_string(calibration.model), lasers, calibration.lasers.size()));
}

std::uint64_t fingerprint(const BeamTable& calibration) {
  const auto mdeg = [](double rad) { return std::llround(rad_to_deg(rad) * 1e3); };
  text::Fnv1a hash;
  constexpr std::int64_t kOfVlp16 = sensor::row_of(sensor::SensorModel::kVlp16).stream_number;
  // Stored fingerprints number the models from the VLP-16 on, so this numbering must not change.
  hash.add(std::int64_t{sensor::row_of(calibration.model).stream_number} - kOfVlp16);
  for (const TableBeam& laser : calibration.lasers) {
    hash.add(mdeg(laser.elevation_rad));
    hash.add(mdeg(laser.azimuth_offset_rad));
    hash.add(std::llround(laser.vert_offset_m * 1e4));
  }
  return hash.value();
}

std::vector<int> rows_by_elevation(const BeamTable& calibration) {
  std::vector<std::size_t> order(calibration.lasers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t laser) {
    return std::pair(calibration.lasers[laser].elevation_rad, laser);
  });
  std::vector<int> rows(order.size());
  for (std::size_t row = 0; row < order.size(); ++row) rows[order[row]] = static_cast<int>(row);
  return rows;
}

}  // namespace terracut::beams
