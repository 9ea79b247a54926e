// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/frame/loss_counters.hpp"

#include <numeric>

namespace terracut::frame {

std::string_view to_string(Reject reason) noexcept {
  switch (reason) {
    case Reject::kWrongSize:
      return "wrong_size";
    case Reject::kWrongMagic:
      return "wrong_magic";
    case Reject::kDeviceInfo:
      return "device_info";
    case Reject::kWrongModel:
      return "wrong_model";
    case Reject::kAzimuthOutOfRange:
      return "azimuth_out_of_range";
    case Reject::kAzimuthMismatch:
      return "azimuth_mismatch";
    case Reject::kAzimuthJump:
      return "azimuth_jump";
    case Reject::kRepeated:
      return "repeated";
    case Reject::kLate:
      return "late";
    case Reject::kStationary:
      return "stationary";
    case Reject::kClockJump:
      return "clock_jump";
    case Reject::kCount:
      break;
  }
  return "unknown";
}

LossCounters& LossCounters::operator+=(const LossCounters& other) noexcept {
  kernel_drops += other.kernel_drops;
  network_gap_packets += other.network_gap_packets;
  azimuth_hole_columns += other.azimuth_hole_columns;
  for (std::size_t i = 0; i < kRejectReasons; ++i) rejected[i] += other.rejected[i];
  overflow_full_returns += other.overflow_full_returns;
  late_returns += other.late_returns;
  skipped_frames += other.skipped_frames;
  clock_jumps += other.clock_jumps;
  return *this;
}

std::uint64_t LossCounters::rejected_total() const noexcept {
  return std::accumulate(rejected.begin(), rejected.end(), std::uint64_t{0});
}

}  // namespace terracut::frame
