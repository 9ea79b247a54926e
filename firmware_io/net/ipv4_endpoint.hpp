// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <netinet/in.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "rt/error.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::net {

/// Address and port of one end of a UDP stream, in host byte order.
struct Ipv4Endpoint {
  std::uint32_t address = 0;  ///< IPv4 address; 0: any.
  std::uint16_t port = 0;     ///< UDP port; 0: chosen by the system.

  friend bool operator==(const Ipv4Endpoint&, const Ipv4Endpoint&) = default;
};

/// Address and port of the sender of a UDP stream.
struct Sender {
  std::uint32_t address = 0;            ///< IPv4 address, host byte order.
  std::optional<std::uint16_t> port{};  ///< UDP port; empty: any.

  [[nodiscard]] constexpr bool has_sent(std::uint32_t from_address,
                                        std::uint16_t from_port) const noexcept {
    return address == from_address && (!port || *port == from_port);
  }
  friend bool operator==(const Sender&, const Sender&) = default;
};

/// Parses "192.168.3.43". Fails with kInvalidArgument for anything else, including host names.
[[nodiscard]] Expected<std::uint32_t> parse_ipv4_address(std::string_view text);

/// Parses "192.168.3.43:2368", or ":2368" and "2368" for any address. Fails with kInvalidArgument
/// for anything else; the message says what was expected.
[[nodiscard]] Expected<Ipv4Endpoint> parse_ipv4_endpoint(std::string_view text);

/// Parses "192.168.3.43:2368", or "192.168.3.43" for any port. Fails with kInvalidArgument for
/// anything else.
[[nodiscard]] Expected<Sender> parse_ipv4_sender(std::string_view text);

[[nodiscard]] std::string ipv4_text(std::uint32_t address);
[[nodiscard]] std::string to_string(const Ipv4Endpoint& endpoint);
/// Returns the text that parse_ipv4_sender() reads.
[[nodiscard]] std::string to_string(const Sender& sender);

/// True for a multicast address, 224.0.0.0 to 239.255.255.255.
[[nodiscard]] constexpr bool is_multicast(std::uint32_t address) noexcept {
  return address >> 28 == 0xE;
}

/// Converts an endpoint to the form that system calls take.
[[nodiscard]] sockaddr_in socket_address(const Ipv4Endpoint& endpoint) noexcept
    TERRACUT_NONBLOCKING;
[[nodiscard]] Ipv4Endpoint endpoint_of(const sockaddr_in& address) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::net
