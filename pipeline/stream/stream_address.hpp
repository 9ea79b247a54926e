// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/socket.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "rt/error.hpp"

namespace terracut::stream {

inline constexpr std::uint32_t kLoopbackAddress = 0x7F00'0001;  ///< 127.0.0.1

/// Where to serve others: as parse_ipv4_endpoint(), but a port alone is for this machine's
/// programs.
[[nodiscard]] Expected<net::Ipv4Endpoint> parse_serving_endpoint(std::string_view text);

/// Where a stream of frames is to be had: TCP over IPv4, or a Unix socket.
struct StreamAddress {
  net::Ipv4Endpoint tcp{kLoopbackAddress, 0};  ///< Port 0: one the system chooses.
  std::string unix_path{};                     ///< If not empty, this instead.

  [[nodiscard]] bool is_unix() const noexcept { return !unix_path.empty(); }
  bool operator==(const StreamAddress&) const = default;
};

/// "192.168.3.10:7447"; "7447" or ":7447" on the loopback address; "0.0.0.0:7447" on every address
/// of this machine; a text with a slash, "/run/terracut/frames" or "./frames", is a Unix socket's
/// path. kInvalidArgument, with what was expected, for anything else.
[[nodiscard]] Expected<StreamAddress> parse_stream_address(std::string_view text);

[[nodiscard]] std::string to_string(const StreamAddress& address);

/// As the system's calls want it.
struct SocketAddress {
  ::sockaddr_storage storage{};
  ::socklen_t size = 0;

  [[nodiscard]] const ::sockaddr* get() const noexcept {
    return reinterpret_cast<const ::sockaddr*>(&storage);
  }
};
/// Paths are as long as parse_stream_address() lets through at most; more would be cut off.
[[nodiscard]] SocketAddress socket_address(const StreamAddress& address) noexcept;

}  // namespace terracut::stream
