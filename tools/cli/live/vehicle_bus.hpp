// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "firmware_io/can/socketcan_source.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "rt/error.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::cli {

/// The vehicle's CAN bus, the source of its motion signals.
struct VehicleBus {
  vehicle::MotionSignals signals;
  can::SocketCanSource source;

  /// Opens the bus; warns of a missing interface and waits for it. Other errors are those of
  /// SocketCanSource::open().
  [[nodiscard]] static Expected<VehicleBus> open(const std::string& interface,
                                                 vehicle::MotionSignals signals,
                                                 memory::FixedMemory& memory);
};

}  // namespace terracut::cli
