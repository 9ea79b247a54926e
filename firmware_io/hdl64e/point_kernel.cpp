// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/point_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rt/vector_clones.hpp"

namespace terracut::hdl64e {

PointKernel::PointKernel(const Hdl64eCalibration& calibration, GeometryModel model,
                         const mount::Mount& mount) noexcept
    : interpolation_end_m_(model == GeometryModel::kManual ? static_cast<float>(kFarPoint_m)
                                                           : std::numeric_limits<float>::max()) {
  const auto T = mount::T_vehicle_lidar(mount);
  std::transform(T.begin(), T.end(), T_vehicle_lidar_.begin(),
                 [](double v) { return static_cast<float>(v); });

  const bool across_beam = model == GeometryModel::kRosLike;
  for (std::size_t i = 0; i < kLasers; ++i) {
    const Hdl64eLaser& laser = calibration.lasers[i];
    const double sin_vert = std::sin(laser.vert_correction_rad);
    const double cos_vert = std::cos(laser.vert_correction_rad);
    const double far_m = laser.dist_correction_m;
    const double near_x_m = laser.two_point ? laser.dist_correction_x_m : far_m;
    const double near_y_m = laser.two_point ? laser.dist_correction_y_m : far_m;
    const double slope_x = (far_m - near_x_m) / (kFarPoint_m - kNearPointX_m);
    const double slope_y = (far_m - near_y_m) / (kFarPoint_m - kNearPointY_m);
    laser_[i] = {
        .sin_rot = static_cast<float>(std::sin(laser.rot_correction_rad)),
        .cos_rot = static_cast<float>(std::cos(laser.rot_correction_rad)),
        .sin_vert = static_cast<float>(sin_vert),
        .cos_vert = static_cast<float>(cos_vert),
        .far_m = static_cast<float>(far_m),
        // The correction is near + slope * (distance - near point); its constant terms are combined
        // here.
        .near_x_m = static_cast<float>(near_x_m - slope_x * kNearPointX_m),
        .near_y_m = static_cast<float>(near_y_m - slope_y * kNearPointY_m),
        .slope_x = static_cast<float>(slope_x),
        .slope_y = static_cast<float>(slope_y),
        .horiz_m = static_cast<float>(laser.horiz_offset_m),
        .xy_start_m = static_cast<float>(across_beam ? -laser.vert_offset_m * sin_vert : 0.0),
        .z_start_m =
            static_cast<float>(across_beam ? laser.vert_offset_m * cos_vert : laser.vert_offset_m),
    };
  }
}

TERRACUT_VECTOR_CLONES void PointKernel::compute(
    const Laser& __restrict laser, const float* __restrict sin_rotor,
    const float* __restrict cos_rotor, const float* __restrict sin_advance,
    const float* __restrict cos_advance, const float* __restrict measured_m, float* __restrict x_m,
    float* __restrict y_m, float* __restrict z_m, float* __restrict ground_range_m) const noexcept {
  const Laser k = laser;
  const float end_m = interpolation_end_m_;
  const std::array<float, 12> T = T_vehicle_lidar_;

  for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
    const float offset_sin = sin_advance[f] * k.cos_rot - cos_advance[f] * k.sin_rot;
    const float offset_cos = cos_advance[f] * k.cos_rot + sin_advance[f] * k.sin_rot;
    const float sin_a = sin_rotor[f] * offset_cos + cos_rotor[f] * offset_sin;
    const float cos_a = cos_rotor[f] * offset_cos - sin_rotor[f] * offset_sin;
    const float side_x = k.horiz_m * cos_a, side_y = k.horiz_m * sin_a;
    const float wire_m = measured_m[f];

    // The two-point distance correction depends on where the far correction puts the point.
    const float xy = (wire_m + k.far_m) * k.cos_vert + k.xy_start_m;
    const float right_far = std::min(std::abs(xy * sin_a - side_x), end_m);
    const float ahead_far = std::min(std::abs(xy * cos_a + side_y), end_m);
    const float along_x = wire_m + (k.near_x_m + k.slope_x * right_far);
    const float along_y = wire_m + (k.near_y_m + k.slope_y * ahead_far);

    const float right = (along_x * k.cos_vert + k.xy_start_m) * sin_a - side_x;
    const float x = (along_y * k.cos_vert + k.xy_start_m) * cos_a + side_y;
    const float y = -right;
    const float z = along_y * k.sin_vert + k.z_start_m;

    const float vehicle_x = T[0] * x + T[1] * y + T[2] * z + T[3];
    const float vehicle_y = T[4] * x + T[5] * y + T[6] * z + T[7];
    x_m[f] = vehicle_x;
    y_m[f] = vehicle_y;
    z_m[f] = T[8] * x + T[9] * y + T[10] * z + T[11];
    ground_range_m[f] = std::sqrt(vehicle_x * vehicle_x + vehicle_y * vehicle_y);
  }
}

void PointKernel::compute(std::size_t laser, const packet::LaserHeads& heads,
                          const frame::TileRow<float>& measured_m,
                          const frame::PointsOut& out) const noexcept {
  compute(laser_[laser], heads.sin_rotor, heads.cos_rotor, heads.sin_advance, heads.cos_advance,
          measured_m.data(), out.x_m, out.y_m, out.z_m, out.ground_range_m);
}

}  // namespace terracut::hdl64e
