// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/simulator/firing_plan.hpp"

#include <algorithm>
#include <cmath>

#include "calib/angle.hpp"
#include "firmware_io/hdl64e/firing_azimuth.hpp"

namespace terracut::firmware_io {
namespace {

constexpr double kLeastRunUp_cdeg = 1100;
constexpr double kSpareRunUp_cdeg = 100;

}  // namespace

FiringPlan::FiringPlan(const calib::Hdl64eCalibration& calibration, double spin_hz,
                       std::int64_t turns)
    : turns_(turns), cdeg_per_s_(spin_hz * calib::kTurn_cdeg), column_s_(kTimes.column_ns * 1e-9) {
  double widest_rad = 0;
  for (const calib::Hdl64eLaser& laser : calibration.lasers) {
    widest_rad = std::max(widest_rad, std::abs(laser.rot_correction_rad));
  }
  const double run_up_cdeg =
      std::max(kLeastRunUp_cdeg, 100 * calib::rad_to_deg(widest_rad) + kSpareRunUp_cdeg);
  start_cdeg_ = -run_up_cdeg;
  const double way_cdeg = static_cast<double>(turns) * calib::kTurn_cdeg + 2 * run_up_cdeg;
  const double columns = way_cdeg / (cdeg_per_s_ * column_s_);
  firings_ = static_cast<std::int64_t>(std::ceil(columns / kColumnsPerPacketSingle)) *
             kColumnsPerPacketSingle;
}

std::int64_t FiringPlan::azimuth_cdeg(std::int64_t index) const noexcept {
  return std::llround(start_cdeg_ + static_cast<double>(index) * column_s_ * cdeg_per_s_);
}

Firing FiringPlan::firing(std::int64_t index) const noexcept {
  const std::int64_t first = index - index % kColumnsPerPacketSingle;
  const std::int64_t last = first + kColumnsPerPacketSingle - 1;
  return {index, azimuth_cdeg(index),
          column_step_ticks(calib::wrap_cdeg(azimuth_cdeg(first)),
                            calib::wrap_cdeg(azimuth_cdeg(last))),
          static_cast<double>(index) * column_s_ + start_cdeg_ / cdeg_per_s_};
}

}  // namespace terracut::firmware_io
