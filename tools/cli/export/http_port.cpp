// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "http_port.hpp"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>

namespace terracut::cli {

Expected<std::uint16_t> bind_http(httplib::Server& server, const std::string& address,
                                  std::uint16_t port, const std::string& what) {
  // The library's default would let a second process listen on the same port unnoticed.
  server.set_socket_options([](int socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  });
  errno = 0;
  const int bound = port == 0                            ? server.bind_to_any_port(address)
                    : server.bind_to_port(address, port) ? int{port}
                                                         : -1;
  if (bound > 0) return static_cast<std::uint16_t>(bound);
  const int reason = errno;
  return fail(
      ErrorCode::kInvalidArgument,
      fmt::format("cannot serve {} on {}:{}: {}; choose another address or port", what, address,
                  port, reason == 0 ? "not an address of this machine" : std::strerror(reason)));
}

}  // namespace terracut::cli
