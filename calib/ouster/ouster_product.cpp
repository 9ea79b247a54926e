// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/ouster/ouster_product.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string_view>

#include "calib/beams/angle.hpp"

namespace terracut::ouster {
namespace {

struct Nominal {
  std::string_view name;
  double highest_deg;
  std::array<double, 4> offsets_deg;  ///< Rows stand in four columns side by side.
  double ahead_m, lidar_up_m;
};

constexpr std::array<Nominal, 3> kNominal{
    {{"OS0", 45, {10.8, 3.6, -3.6, -10.8}, 0.02767, 0.03618},
     {"OS1", 22.5, {4.2, 1.4, -1.4, -4.2}, 0.015806, 0.03618},
     {"OS2", 11.25, {2.1, 0.7, -0.7, -2.1}, 0.013762, 0.078296}}};

}  // namespace

OusterCalibration nominal_product(Product product, sensor::SensorModel model) {
  const Nominal& nominal = kNominal[static_cast<std::size_t>(product) % kNominal.size()];
  OusterCalibration unit;
  unit.format.profile = Profile::kSingle;
  unit.format.rows = rows_of(model);
  for (int row = 0; row < unit.format.rows; ++row) {
    const double down = static_cast<double>(row) / (unit.format.rows - 1);
    unit.lasers.push_back(
        {beams::deg_to_rad(nominal.highest_deg - 2 * nominal.highest_deg * down),
         beams::deg_to_rad(nominal.offsets_deg[static_cast<std::size_t>(row % 4)]), 0});
  }
  unit.ahead_m = unit.beam_origin_m = nominal.ahead_m;
  unit.T_sensor_lidar = {-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, nominal.lidar_up_m};
  unit.origin = fmt::format("nominal table of a {} {}", to_string(model), nominal.name);
  return unit;
}

}  // namespace terracut::ouster
