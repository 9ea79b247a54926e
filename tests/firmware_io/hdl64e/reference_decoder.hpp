// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "calib/hdl64e_calibration.hpp"

namespace terracut::test {

/// One return of the plain, slow decoder, in order of arrival.
struct ReferenceReturn {
  double beam_deg = 0;               ///< Unwrapped: turn = floor(beam_deg / 360).
  double x_m = 0, y_m = 0, z_m = 0;  ///< Sensor frame, REP-103.
  int laser = 0;
  int intensity = 0;
};

/// An HDL-64E single-return decoder written from the format's description only (packet layout,
/// firing times and geometry of the maker's manuals), in double, for a complete stream in order. It
/// shares no code with the product's decoder, so that a mistake would have to be made twice.
class ReferenceDecoder {
 public:
  explicit ReferenceDecoder(const calib::Hdl64eCalibration& calibration, bool ros_like = false)
      : calibration_(calibration), ros_like_(ros_like) {}

  std::vector<ReferenceReturn> decode(std::span<const std::uint8_t, 1206> bytes) {
    const auto u16 = [&](std::size_t at) { return bytes[at] + 256 * bytes[at + 1]; };
    std::array<double, 6> column_deg{};
    for (std::size_t c = 0; c < 6; ++c) {
      const double wire_deg = u16(200 * c + 2) / 100.0;
      if (!started_) head_deg_ = wire_deg;
      started_ = true;
      // To the nearest turn: the head never moves by half a turn between firings.
      head_deg_ = wire_deg + 360.0 * std::round((head_deg_ - wire_deg) / 360.0);
      column_deg[c] = head_deg_;
    }
    const double step_deg = (column_deg[5] - column_deg[0]) / 5.0;
    std::vector<ReferenceReturn> returns;
    for (std::size_t block = 0; block < 12; ++block) {
      for (std::size_t j = 0; j < 32; ++j) {
        const std::size_t at = 100 * block + 4 + 3 * j;
        if (u16(at) == 0) continue;
        constexpr std::array<double, 4> kInGroup_us{0, 1.26, 2.46, 3.66};
        const double fired_us = 6.0 * static_cast<double>(j / 4) + kInGroup_us[j % 4];
        const double head_deg = column_deg[block / 2] + step_deg * fired_us / 48.0;
        const int laser = static_cast<int>(j) + (u16(100 * block) == 0xDDFF ? 32 : 0);
        returns.push_back(point(laser, head_deg, u16(at)));
        returns.back().intensity = bytes[at + 2];
      }
    }
    return returns;
  }

 private:
  [[nodiscard]] ReferenceReturn point(int number, double head_deg, int raw) const {
    const calib::Hdl64eLaser& laser = calibration_.lasers[static_cast<std::size_t>(number)];
    const double a = head_deg * std::numbers::pi / 180 - laser.rot_correction_rad;
    const double w = laser.vert_correction_rad, h = laser.horiz_offset_m, v = laser.vert_offset_m;
    const double along = ros_like_ ? v * std::sin(w) : 0, up = ros_like_ ? v * std::cos(w) : v;
    const double d1 = raw * 0.002;
    const double far = laser.dist_correction_m;
    double cx = far, cy = far;
    if (laser.two_point) {
      const double xy = (d1 + far) * std::cos(w) - along;
      const double xx = std::abs(xy * std::sin(a) - h * std::cos(a));
      const double yy = std::abs(xy * std::cos(a) + h * std::sin(a));
      if (ros_like_ || xx < 25.04) {
        cx = laser.dist_correction_x_m +
             (far - laser.dist_correction_x_m) * (xx - 2.40) / (25.04 - 2.40);
      }
      if (ros_like_ || yy < 25.04) {
        cy = laser.dist_correction_y_m +
             (far - laser.dist_correction_y_m) * (yy - 1.93) / (25.04 - 1.93);
      }
    }
    const double right = ((d1 + cx) * std::cos(w) - along) * std::sin(a) - h * std::cos(a);
    const double ahead = ((d1 + cy) * std::cos(w) - along) * std::cos(a) + h * std::sin(a);
    const double z = (d1 + cy) * std::sin(w) + up;
    return {
        head_deg - laser.rot_correction_rad * 180 / std::numbers::pi, ahead, -right, z, number, 0};
  }

  calib::Hdl64eCalibration calibration_;
  bool ros_like_;
  bool started_ = false;
  double head_deg_ = 0;
};

}  // namespace terracut::test
