// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/hdl64e/point_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/beams/angle.hpp"
#include "firmware_io/decode/packet_azimuths.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::hdl64e {

PointKernel::PointKernel(const Hdl64eCalibration& calibration, GeometryModel model,
                         const mount::Mount& mount, int columns, memory::FixedMemory& memory)
    : resolution_m_(static_cast<float>(calibration.distance_resolution_m)),
      interpolation_end_m_(model == GeometryModel::kManual ? static_cast<float>(kFarPoint_m)
                                                           : std::numeric_limits<float>::max()),
      columns_(columns),
      head_(memory),
      constants_(memory.take<Constants>("decoder tables", 1)),
      offsets_(memory.take<Offsets>("decoder tables", 1)) {
  const auto T = mount::T_vehicle_lidar(mount);
  std::transform(T.begin(), T.end(), T_vehicle_lidar_.begin(),
                 [](double v) { return static_cast<float>(v); });

  const bool across_beam = model == GeometryModel::kRosLike;
  Constants& k = constants_[0];
  for (std::size_t i = 0; i < kLasers; ++i) {
    const Hdl64eLaser& laser = calibration.lasers[i];
    const double sin_vert = std::sin(laser.vert_correction_rad);
    const double cos_vert = std::cos(laser.vert_correction_rad);
    const double far_m = laser.dist_correction_m;
    const double near_x_m = laser.two_point ? laser.dist_correction_x_m : far_m;
    const double near_y_m = laser.two_point ? laser.dist_correction_y_m : far_m;
    const double slope_x = (far_m - near_x_m) / (kFarPoint_m - kNearPointX_m);
    const double slope_y = (far_m - near_y_m) / (kFarPoint_m - kNearPointY_m);
    k.sin_rot[i] = static_cast<float>(std::sin(laser.rot_correction_rad));
    k.cos_rot[i] = static_cast<float>(std::cos(laser.rot_correction_rad));
    k.sin_vert[i] = static_cast<float>(sin_vert);
    k.cos_vert[i] = static_cast<float>(cos_vert);
    k.far_m[i] = static_cast<float>(far_m);
    // near + slope * (distance - near point), with the constant part taken together.
    k.near_x_m[i] = static_cast<float>(near_x_m - slope_x * kNearPointX_m);
    k.near_y_m[i] = static_cast<float>(near_y_m - slope_y * kNearPointY_m);
    k.slope_x[i] = static_cast<float>(slope_x);
    k.slope_y[i] = static_cast<float>(slope_y);
    k.horiz_m[i] = static_cast<float>(laser.horiz_offset_m);
    k.xy_start_m[i] = static_cast<float>(across_beam ? -laser.vert_offset_m * sin_vert : 0.0);
    k.z_start_m[i] =
        static_cast<float>(across_beam ? laser.vert_offset_m * cos_vert : laser.vert_offset_m);
  }
}

void PointKernel::begin_packet(std::span<const std::int32_t, kLasers / 2> advance_ticks,
                               std::span<const std::int32_t, kLasers> offset_ticks) noexcept {
  const Constants& k = constants_[0];
  Offsets& offsets = offsets_[0];
  constexpr auto kRad = static_cast<float>(decode::kRadPerTick);
  for (std::size_t i = 0; i < kLasers; ++i) {
    offsets.ticks[i] = offset_ticks[i];
    // Below a degree two terms of each series are exact to a float.
    const float a = static_cast<float>(advance_ticks[i % (kLasers / 2)]) * kRad;
    const float aa = a * a;
    const float sin_a = a * (1.0F - aa * (1.0F / 6.0F));
    const float cos_a = 1.0F - aa * 0.5F;
    offsets.sin[i] = sin_a * k.cos_rot[i] - cos_a * k.sin_rot[i];
    offsets.cos[i] = cos_a * k.cos_rot[i] + sin_a * k.sin_rot[i];
  }
}

TERRACUT_VECTOR_CLONES void PointKernel::compute(
    const Constants& __restrict k, const Offsets& __restrict offset, std::int32_t azimuth_cdeg,
    decode::ColumnReturns<kLasers>& __restrict out) const noexcept {
  const auto [sin_rotor, cos_rotor] = head_.at(azimuth_cdeg);
  const float resolution_m = resolution_m_, end_m = interpolation_end_m_;
  const std::array<float, 12> T = T_vehicle_lidar_;

  for (std::size_t i = 0; i < kLasers; ++i) {
    const float sin_a = sin_rotor * offset.cos[i] + cos_rotor * offset.sin[i];
    const float cos_a = cos_rotor * offset.cos[i] - sin_rotor * offset.sin[i];
    const float side_x = k.horiz_m[i] * cos_a, side_y = k.horiz_m[i] * sin_a;
    const float measured_m =
        static_cast<float>(static_cast<std::int32_t>(out.raw[i])) * resolution_m;

    // The two-point distance correction depends on where the far correction puts the point.
    const float xy = (measured_m + k.far_m[i]) * k.cos_vert[i] + k.xy_start_m[i];
    const float right_far = std::min(std::abs(xy * sin_a - side_x), end_m);
    const float ahead_far = std::min(std::abs(xy * cos_a + side_y), end_m);
    const float along_x = measured_m + (k.near_x_m[i] + k.slope_x[i] * right_far);
    const float along_y = measured_m + (k.near_y_m[i] + k.slope_y[i] * ahead_far);

    const float right = (along_x * k.cos_vert[i] + k.xy_start_m[i]) * sin_a - side_x;
    const float x = (along_y * k.cos_vert[i] + k.xy_start_m[i]) * cos_a + side_y;
    const float y = -right;
    const float z = along_y * k.sin_vert[i] + k.z_start_m[i];

    const float vehicle_x = T[0] * x + T[1] * y + T[2] * z + T[3];
    const float vehicle_y = T[4] * x + T[5] * y + T[6] * z + T[7];
    out.x_m[i] = vehicle_x;
    out.y_m[i] = vehicle_y;
    out.z_m[i] = T[8] * x + T[9] * y + T[10] * z + T[11];
    out.ground_range_m[i] = std::sqrt(vehicle_x * vehicle_x + vehicle_y * vehicle_y);
  }
  columns_.compute(azimuth_cdeg, offset.ticks, out);
}

void PointKernel::compute(std::int32_t azimuth_cdeg,
                          decode::ColumnReturns<kLasers>& column) const noexcept {
  compute(constants_[0], offsets_[0], azimuth_cdeg, column);
}

}  // namespace terracut::hdl64e
