// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "firmware_io/net/receive_counters.hpp"
#include "rt/error.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::net {

/// The state of an interface as the kernel reports it. An adapter that is pulled and put back keeps
/// its name but gets another index.
struct InterfaceStatus {
  LinkState state = LinkState::kGone;
  int index = 0;  ///< Index of the interface; 0 if it is gone.
};

/// Asks the kernel for the state of `name`. `socket` is any socket. Allocates nothing, does not
/// block.
[[nodiscard]] InterfaceStatus interface_status(int socket, const std::string& name) noexcept
    TERRACUT_NONBLOCKING;

/// Returns a kNotFound error that lists the interfaces there are: "no such interface 'eth1'; there
/// are: lo, eth0".
[[nodiscard]] Error no_such_interface(const std::string& name);

/// The longest name of an interface.
inline constexpr std::size_t kInterfaceNameLength = 15;

}  // namespace terracut::net
