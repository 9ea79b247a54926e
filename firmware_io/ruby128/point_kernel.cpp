// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/point_kernel.hpp"

#include <algorithm>
#include <cmath>

#include "rt/vector_clones.hpp"

namespace terracut::ruby128 {

Ruby128PointKernel::Ruby128PointKernel(const Ruby128Calibration& calibration,
                                       const mount::Mount& mount) noexcept {
  const auto T = mount::T_vehicle_lidar(mount);
  std::transform(T.begin(), T.end(), T_vehicle_lidar_.begin(),
                 [](double v) { return static_cast<float>(v); });
  for (std::size_t i = 0; i < kLasers; ++i) {
    const Ruby128Channel& channel = calibration.channels[i];
    channel_[i] = {.sin_offset = static_cast<float>(std::sin(channel.azimuth_offset_rad)),
                   .cos_offset = static_cast<float>(std::cos(channel.azimuth_offset_rad)),
                   .sin_elevation = static_cast<float>(std::sin(channel.elevation_rad)),
                   .cos_elevation = static_cast<float>(std::cos(channel.elevation_rad))};
  }
}

TERRACUT_VECTOR_CLONES void Ruby128PointKernel::compute(
    const Channel& __restrict channel, const float* __restrict sin_rotor,
    const float* __restrict cos_rotor, const float* __restrict sin_advance,
    const float* __restrict cos_advance, const float* __restrict measured_m, float* __restrict x_m,
    float* __restrict y_m, float* __restrict z_m, float* __restrict ground_range_m) const noexcept {
  const Channel k = channel;
  constexpr auto kAhead_m = static_cast<float>(kRuby128LensAhead_m);
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
    const float x = along_m * cos_beam + kAhead_m * cos_lens;
    const float y = -(along_m * sin_beam + kAhead_m * sin_lens);
    const float z = distance_m * k.sin_elevation;

    const float vehicle_x = T[0] * x + T[1] * y + T[2] * z + T[3];
    const float vehicle_y = T[4] * x + T[5] * y + T[6] * z + T[7];
    x_m[f] = vehicle_x;
    y_m[f] = vehicle_y;
    z_m[f] = T[8] * x + T[9] * y + T[10] * z + T[11];
    ground_range_m[f] = std::sqrt(vehicle_x * vehicle_x + vehicle_y * vehicle_y);
  }
}

void Ruby128PointKernel::compute(std::size_t channel, const packet::LaserHeads& heads,
                                 const frame::TileRow<float>& measured_m,
                                 const frame::PointsOut& out) const noexcept {
  compute(channel_[channel], heads.sin_rotor, heads.cos_rotor, heads.sin_advance, heads.cos_advance,
          measured_m.data(), out.x_m, out.y_m, out.z_m, out.ground_range_m);
}

}  // namespace terracut::ruby128
