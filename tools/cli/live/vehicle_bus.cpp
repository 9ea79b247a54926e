// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "vehicle_bus.hpp"

#include <fmt/format.h>

#include <utility>

#include "firmware_io/can/can_socket.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {

Expected<VehicleBus> VehicleBus::open(const std::string& interface,
                                      firmware_io::MotionSignals signals, rt::FixedMemory& memory) {
  const auto ids = signals.ids();
  auto source = firmware_io::SocketCanSource::open(
      {.interface = interface, .ids = {ids.begin(), ids.end()}, .wait_for_interface = true},
      memory);
  if (!source) return tl::unexpected(source.error());
  if (source->link() == firmware_io::LinkState::kGone) {
    warn(firmware_io::no_such_can_interface(interface).message +
         "; it is waited for, and until then frames have no ego motion");
  } else if (source->link() == firmware_io::LinkState::kDown) {
    warn(fmt::format("CAN interface '{}' is down; until it is up frames have no ego motion",
                     interface));
  }
  return VehicleBus{std::move(signals), *std::move(source)};
}

}  // namespace terracut::cli
