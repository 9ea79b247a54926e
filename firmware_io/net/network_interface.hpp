// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "firmware_io/net/receive_counters.hpp"
#include "rt/error.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::net {

/// The kernel's state of an interface. An adapter that is pulled and put back keeps its name but
/// gets another index.
struct InterfaceStatus {
  LinkState state = LinkState::kGone;
  int index = 0;  ///< 0 when gone.
};

/// Asks the kernel. `socket` is any socket. Allocates nothing, does not block.
[[nodiscard]] InterfaceStatus interface_status(int socket, const std::string& name) noexcept
    TERRACUT_NONBLOCKING;

/// Returns kNotFound with the interfaces there are: "no such interface 'eth1'; there are: lo,
/// eth0".
[[nodiscard]] Error no_such_interface(const std::string& name);

/// The longest name of an interface.
inline constexpr std::size_t kInterfaceNameLength = 15;

}  // namespace terracut::net
