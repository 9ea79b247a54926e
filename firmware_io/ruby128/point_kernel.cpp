// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/point_kernel.hpp"

#include <algorithm>
#include <cmath>

#include "calib/ruby128/ruby128_geometry.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::ruby128 {

Ruby128PointKernel::Ruby128PointKernel(const Ruby128Calibration& calibration,
                                       const mount::Mount& mount, int columns,
                                       memory::FixedMemory& memory)
    : beam_offsets_(calibration),
      columns_(columns),
      head_(memory),
      constants_(memory.take<Constants>("decoder tables", 1)),
      offsets_(memory.take<Offsets>("decoder tables", 1)) {
  const auto T = mount::T_vehicle_lidar(mount);
  std::transform(T.begin(), T.end(), T_vehicle_lidar_.begin(),
                 [](double v) { return static_cast<float>(v); });
  Constants& k = constants_[0];
  for (std::size_t i = 0; i < kLasers; ++i) {
    const Ruby128Channel& channel = calibration.channels[i];
    k.sin_offset[i] = static_cast<float>(std::sin(channel.azimuth_offset_rad));
    k.cos_offset[i] = static_cast<float>(std::cos(channel.azimuth_offset_rad));
    k.sin_elevation[i] = static_cast<float>(std::sin(channel.elevation_rad));
    k.cos_elevation[i] = static_cast<float>(std::cos(channel.elevation_rad));
  }
}

void Ruby128PointKernel::set_step(std::int32_t step_ticks) noexcept {
  if (step_ticks == step_ticks_) return;
  step_ticks_ = step_ticks;
  const Constants& k = constants_[0];
  Offsets& offsets = offsets_[0];
  constexpr auto kRad = static_cast<float>(decode::kRadPerTick);
  for (std::size_t i = 0; i < kLasers; ++i) {
    const int channel = static_cast<int>(i);
    offsets.ticks[i] = beam_offsets_.offset_ticks(step_ticks, channel);
    // Below a degree two terms of each series are exact to a float.
    const float a = static_cast<float>(ruby_advance_ticks(step_ticks, channel)) * kRad;
    const float aa = a * a;
    const float sin_a = a * (1.0F - aa * (1.0F / 6.0F));
    const float cos_a = 1.0F - aa * 0.5F;
    offsets.sin_advance[i] = sin_a;
    offsets.cos_advance[i] = cos_a;
    offsets.sin_beam[i] = sin_a * k.cos_offset[i] + cos_a * k.sin_offset[i];
    offsets.cos_beam[i] = cos_a * k.cos_offset[i] - sin_a * k.sin_offset[i];
  }
}

TERRACUT_VECTOR_CLONES void Ruby128PointKernel::compute(
    const Constants& __restrict k, const Offsets& __restrict offset, std::int32_t azimuth_cdeg,
    decode::ColumnReturns<kLasers>& __restrict out) const noexcept {
  const auto [sin_rotor, cos_rotor] = head_.at(azimuth_cdeg);
  constexpr auto kCount_m = static_cast<float>(kRuby128MetresPerCount);
  constexpr auto kAhead_m = static_cast<float>(kRuby128LensAhead_m);
  const std::array<float, 12> T = T_vehicle_lidar_;

  for (std::size_t i = 0; i < kLasers; ++i) {
    const float sin_lens = sin_rotor * offset.cos_advance[i] + cos_rotor * offset.sin_advance[i];
    const float cos_lens = cos_rotor * offset.cos_advance[i] - sin_rotor * offset.sin_advance[i];
    const float sin_beam = sin_rotor * offset.cos_beam[i] + cos_rotor * offset.sin_beam[i];
    const float cos_beam = cos_rotor * offset.cos_beam[i] - sin_rotor * offset.sin_beam[i];

    const float distance_m = static_cast<float>(static_cast<std::int32_t>(out.raw[i])) * kCount_m;
    const float along_m = distance_m * k.cos_elevation[i];
    const float x = along_m * cos_beam + kAhead_m * cos_lens;
    const float y = -(along_m * sin_beam + kAhead_m * sin_lens);
    const float z = distance_m * k.sin_elevation[i];

    const float vehicle_x = T[0] * x + T[1] * y + T[2] * z + T[3];
    const float vehicle_y = T[4] * x + T[5] * y + T[6] * z + T[7];
    out.x_m[i] = vehicle_x;
    out.y_m[i] = vehicle_y;
    out.z_m[i] = T[8] * x + T[9] * y + T[10] * z + T[11];
    out.ground_range_m[i] = std::sqrt(vehicle_x * vehicle_x + vehicle_y * vehicle_y);
  }
  columns_.compute(azimuth_cdeg, offset.ticks, out);
}

void Ruby128PointKernel::compute(std::int32_t azimuth_cdeg,
                                 decode::ColumnReturns<kLasers>& column) const noexcept {
  compute(constants_[0], offsets_[0], azimuth_cdeg, column);
}

}  // namespace terracut::ruby128
