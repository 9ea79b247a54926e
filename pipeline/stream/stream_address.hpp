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

/// Parses an address to serve at, as parse_ipv4_endpoint() does, except that a port alone means the
/// loopback address, for this machine's programs only.
[[nodiscard]] Expected<net::Ipv4Endpoint> parse_serving_endpoint(std::string_view text);

/// The address of a stream of frames: TCP over IPv4, or a Unix socket.
struct StreamAddress {
  net::Ipv4Endpoint tcp{kLoopbackAddress, 0};  ///< Port 0: chosen by the system.
  std::string unix_path{};                     ///< Used instead of `tcp` if not empty.

  [[nodiscard]] bool is_unix() const noexcept { return !unix_path.empty(); }
  bool operator==(const StreamAddress&) const = default;
};

/// Parses "192.168.3.10:7447"; "7447" or ":7447" as the loopback address; "0.0.0.0:7447" as every
/// address of this machine; a text with a slash, "/run/terracut/frames" or "./frames", as the path
/// of a Unix socket. Fails with kInvalidArgument for anything else, stating what was expected.
[[nodiscard]] Expected<StreamAddress> parse_stream_address(std::string_view text);

[[nodiscard]] std::string to_string(const StreamAddress& address);

/// An address in the form that system calls take.
struct SocketAddress {
  ::sockaddr_storage storage{};
  ::socklen_t size = 0;

  [[nodiscard]] const ::sockaddr* get() const noexcept {
    return reinterpret_cast<const ::sockaddr*>(&storage);
  }
};
/// Converts an address. A path longer than parse_stream_address() allows would be cut.
[[nodiscard]] SocketAddress socket_address(const StreamAddress& address) noexcept;

}  // namespace terracut::stream
