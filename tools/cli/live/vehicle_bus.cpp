// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "vehicle_bus.hpp"

#include <fmt/format.h>

#include <utility>

#include "firmware_io/net/network_interface.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {

Expected<VehicleBus> VehicleBus::open(const std::string& interface, vehicle::MotionSignals signals,
                                      memory::FixedMemory& memory) {
  const auto ids = signals.ids();
  auto source = can::SocketCanSource::open(
      {.interface = interface, .ids = {ids.begin(), ids.end()}, .wait_for_interface = true},
      memory);
  if (!source) return tl::unexpected(source.error());
  if (source->link() == net::LinkState::kGone) {
    warn(net::no_such_interface(interface).message +
         "; it is waited for, and until then frames have no ego motion");
  } else if (source->link() == net::LinkState::kDown) {
    warn(fmt::format("CAN interface '{}' is down; until it is up frames have no ego motion",
                     interface));
  }
  return VehicleBus{std::move(signals), *std::move(source)};
}

}  // namespace terracut::cli
