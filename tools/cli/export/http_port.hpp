// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "rt/error.hpp"

namespace httplib {
class Server;
}

namespace terracut::cli {

/// Binds `server` to `address` (numeric) : `port`, 0 for any free one, for itself alone; returns
/// the port. kInvalidArgument with the system's reason, such as a port in use; `what` is served
/// there.
[[nodiscard]] Expected<std::uint16_t> bind_http(httplib::Server& server, const std::string& address,
                                                std::uint16_t port, const std::string& what);

}  // namespace terracut::cli
