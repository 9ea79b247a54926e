// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "firmware_io/net/receive_counters.hpp"
#include "rt/error.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::net {

/// What the kernel calls an interface now. A cable adapter that is pulled and put back keeps its
/// name but gets another index.
struct InterfaceStatus {
  LinkState state = LinkState::kGone;
  int index = 0;  ///< 0 when gone.
};

/// `socket`: any socket. Allocates nothing, does not block.
[[nodiscard]] InterfaceStatus interface_status(int socket, const std::string& name) noexcept
    TERRACUT_NONBLOCKING;

/// kNotFound, with those that there are: "no such interface 'eth1'; there are: lo, eth0".
[[nodiscard]] Error no_such_interface(const std::string& name);

/// The most characters a name of an interface has.
inline constexpr std::size_t kInterfaceNameLength = 15;

}  // namespace terracut::net
