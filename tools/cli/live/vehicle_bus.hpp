// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "firmware_io/can/motion_signals.hpp"
#include "firmware_io/can/socketcan_source.hpp"
#include "rt/error.hpp"
#include "rt/fixed_memory.hpp"

namespace terracut::cli {

/// The vehicle's CAN bus, heard for the signals of its motion.
struct VehicleBus {
  firmware_io::MotionSignals signals;
  firmware_io::SocketCanSource source;

  /// An interface that is not there is warned of and waited for. Otherwise the errors of
  /// SocketCanSource::open().
  [[nodiscard]] static Expected<VehicleBus> open(const std::string& interface,
                                                 firmware_io::MotionSignals signals,
                                                 rt::FixedMemory& memory);
};

}  // namespace terracut::cli
