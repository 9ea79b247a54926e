// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/straight_point_kernel.hpp"

#include <cmath>

#include "rt/vector_clones.hpp"

namespace terracut::packet {

TERRACUT_VECTOR_CLONES void StraightPointKernel::compute(
    const Laser& __restrict laser, const float* __restrict sin_rotor,
    const float* __restrict cos_rotor, const float* __restrict sin_advance,
    const float* __restrict cos_advance, const float* __restrict measured_m, float* __restrict x_m,
    float* __restrict y_m, float* __restrict z_m, float* __restrict ground_range_m) const noexcept {
  const Laser k = laser;
  const float ahead_m = lens_ahead_m_;
  const std::array<float, 12> T = T_vehicle_lidar_;

  for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
    const float beam_sin = sin_advance[f] * k.cos_offset + cos_advance[f] * k.sin_offset;
    const float beam_cos = cos_advance[f] * k.cos_offset - sin_advance[f] * k.sin_offset;
    const float sin_lens = sin_rotor[f] * cos_advance[f] + cos_rotor[f] * sin_advance[f];
    const float cos_lens = cos_rotor[f] * cos_advance[f] - sin_rotor[f] * sin_advance[f];
    const float sin_beam = sin_rotor[f] * beam_cos + cos_rotor[f] * beam_sin;
    const float cos_beam = cos_rotor[f] * beam_cos - sin_rotor[f] * beam_sin;

    const float distance_m = measured_m[f];
    const float along_m = distance_m * k.cos_elevation;
    const float x = along_m * cos_beam + ahead_m * cos_lens;
    const float y = -(along_m * sin_beam + ahead_m * sin_lens);
    const float z = distance_m * k.sin_elevation + k.vert_offset_m;

    const float vehicle_x = T[0] * x + T[1] * y + T[2] * z + T[3];
    const float vehicle_y = T[4] * x + T[5] * y + T[6] * z + T[7];
    x_m[f] = vehicle_x;
    y_m[f] = vehicle_y;
    z_m[f] = T[8] * x + T[9] * y + T[10] * z + T[11];
    ground_range_m[f] = std::sqrt(vehicle_x * vehicle_x + vehicle_y * vehicle_y);
  }
}

void StraightPointKernel::compute(std::size_t laser, const LaserHeads& heads,
                                  const frame::TileRow<float>& measured_m,
                                  const frame::PointsOut& out) const noexcept {
  compute(laser_[laser], heads.sin_rotor, heads.cos_rotor, heads.sin_advance, heads.cos_advance,
          measured_m.data(), out.x_m, out.y_m, out.z_m, out.ground_range_m);
}

}  // namespace terracut::packet
