// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "hdl64e_reference.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace terracut::reference {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// Eight groups of four lasers a column, both blocks of the pair at once.
struct FiringPattern {
  double column_us;
  double group_us;
  double in_group_us[4];
};
constexpr FiringPattern kSinglePattern{48.0, 6.0, {0, 1.26, 2.46, 3.66}};
constexpr FiringPattern kDualPattern{57.6, 7.2, {0, 1.3, 2.5, 3.7}};

constexpr RotorLimits kLimits{
    .forwards_cdeg = 100, .backwards_cdeg = 5, .least_sweep_cdeg = 10, .standing_back_cdeg = 9};

int u16(std::span<const std::uint8_t> payload, std::size_t at) {
  return payload[at] + 256 * payload[at + 1];
}

Refusal read_azimuths(std::span<const std::uint8_t> payload, int (&pair_cdeg)[6]) {
  if (payload.size() != 1206) return Refusal::kOtherPacket;
  for (std::size_t block = 0; block < 12; ++block) {
    const int id = block % 2 == 0 ? 0xEEFF : 0xDDFF;
    if (u16(payload, 100 * block) != id) return Refusal::kOtherPacket;
  }
  for (std::size_t block = 0; block < 12; ++block) {
    if (u16(payload, 100 * block + 2) > 35'999) return Refusal::kAzimuthRange;
  }
  for (std::size_t pair = 0; pair < 6; ++pair) {
    pair_cdeg[pair] = u16(payload, 200 * pair + 2);
    if (u16(payload, 200 * pair + 102) != pair_cdeg[pair]) return Refusal::kUnequalFirings;
  }
  return Refusal::kNone;
}

}  // namespace

Packet Hdl64eReference::decode(std::span<const std::uint8_t> payload) const {
  Packet packet;
  int pair_cdeg[6] = {};
  packet.refusal = read_azimuths(payload, pair_cdeg);
  if (packet.refusal != Refusal::kNone) return packet;
  packet.refusal = judge_rotation(pair_cdeg, kLimits);
  if (packet.refusal != Refusal::kNone) return packet;

  packet.columns = 6;
  packet.first_deg = pair_cdeg[0] / 100.0;
  packet.dual_return =
      pair_cdeg[0] == pair_cdeg[1] && pair_cdeg[2] == pair_cdeg[3] && pair_cdeg[4] == pair_cdeg[5];
  const int returns_per_firing = packet.dual_return ? 2 : 1;
  const FiringPattern& pattern = packet.dual_return ? kDualPattern : kSinglePattern;
  const int firings = 6 / returns_per_firing;
  packet.step_deg = clockwise_cdeg(pair_cdeg[0], pair_cdeg[5]) / 100.0 / (firings - 1);
  for (int block = 0; block < 12; ++block) {
    for (int j = 0; j < 32; ++j) {
      const auto at = static_cast<std::size_t>(100 * block + 4 + 3 * j);
      Return beam;
      beam.column = block / 2;
      beam.laser = block % 2 == 0 ? j : 32 + j;
      beam.raw_distance = u16(payload, at);
      beam.intensity = payload[at + 2];
      if (beam.raw_distance == 0) continue;
      const double in_column_us = pattern.group_us * (j / 4) + pattern.in_group_us[j % 4];
      beam.fired_us = pattern.column_us * (beam.column / returns_per_firing) + in_column_us;
      const int advance_cdeg = clockwise_cdeg(pair_cdeg[0], pair_cdeg[beam.column]);
      beam.rotor_deg = packet.first_deg + advance_cdeg / 100.0 +
                       packet.step_deg * in_column_us / pattern.column_us;
      locate(beam);
      packet.returns.push_back(beam);
    }
  }
  return packet;
}

void Hdl64eReference::locate(Return& beam) const {
  const hdl64e::Hdl64eLaser& laser = calibration_.lasers[static_cast<std::size_t>(beam.laser)];
  const bool ros_like = offsets_ == Hdl64eOffsets::kRosLike;
  const double rho = laser.rot_correction_rad, omega = laser.vert_correction_rad;
  const double h_off = laser.horiz_offset_m, v_off = laser.vert_offset_m;
  beam.beam_deg = beam.rotor_deg - rho / kRadPerDeg;
  const double a = beam.rotor_deg * kRadPerDeg - rho;

  const double d1 = beam.raw_distance * calibration_.distance_resolution_m;
  const double far = laser.dist_correction_m;
  const double taken_off_xy = ros_like ? v_off * std::sin(omega) : 0.0;
  double c_x = far, c_y = far;
  if (laser.two_point) {
    const double xy = (d1 + far) * std::cos(omega) - taken_off_xy;
    const double xx = std::abs(xy * std::sin(a) - h_off * std::cos(a));
    const double yy = std::abs(xy * std::cos(a) + h_off * std::sin(a));
    const double at_x = laser.dist_correction_x_m, at_y = laser.dist_correction_y_m;
    if (ros_like || xx < 25.04) c_x = at_x + (far - at_x) * (xx - 2.40) / (25.04 - 2.40);
    if (ros_like || yy < 25.04) c_y = at_y + (far - at_y) * (yy - 1.93) / (25.04 - 1.93);
  }
  const double xy_by_x = (d1 + c_x) * std::cos(omega) - taken_off_xy;
  const double xy_by_y = (d1 + c_y) * std::cos(omega) - taken_off_xy;
  const double right = xy_by_x * std::sin(a) - h_off * std::cos(a);
  const double ahead = xy_by_y * std::cos(a) + h_off * std::sin(a);
  const double up = (d1 + c_y) * std::sin(omega) + (ros_like ? v_off * std::cos(omega) : v_off);
  beam.x_m = ahead;
  beam.y_m = -right;
  beam.z_m = up;
}

}  // namespace terracut::reference
