// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/ipv4_endpoint.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include "rt/number_of.hpp"

namespace terracut::net {

Expected<std::uint32_t> parse_ipv4_address(std::string_view text) {
  in_addr address{};
  if (::inet_pton(AF_INET, std::string(text).c_str(), &address) != 1) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("'{}' is no IPv4 address; expected one like 192.168.3.43", text));
  }
  return ntohl(address.s_addr);
}

Expected<Ipv4Endpoint> parse_ipv4_endpoint(std::string_view text) {
  Ipv4Endpoint endpoint;
  std::string_view port = text;
  if (const auto colon = text.rfind(':'); colon != text.npos) {
    port = text.substr(colon + 1);
    if (colon > 0) {
      const auto address = parse_ipv4_address(text.substr(0, colon));
      if (!address) return tl::unexpected(address.error());
      endpoint.address = *address;
    }
  }
  const auto number = rt::number_of<std::uint16_t>(port);
  if (!number) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("'{}' is no UDP address; expected ADDRESS:PORT like 192.168.3.43:2368, "
                            "ports from 0 to 65535",
                            text));
  }
  endpoint.port = *number;
  return endpoint;
}

Expected<Sender> parse_ipv4_sender(std::string_view text) {
  const std::size_t colon = text.find(':');
  const auto address = parse_ipv4_address(text.substr(0, colon));
  if (address && colon == std::string_view::npos) return Sender{*address, {}};
  const auto port = colon == std::string_view::npos
                        ? std::nullopt
                        : rt::number_of<std::uint16_t>(text.substr(colon + 1));
  if (address && port && *port != 0) return Sender{*address, *port};
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("'{}' is no sender; expected an IPv4 address, or ADDRESS:PORT", text));
}

std::string ipv4_text(std::uint32_t address) {
  return fmt::format("{}.{}.{}.{}", address >> 24, address >> 16 & 0xFF, address >> 8 & 0xFF,
                     address & 0xFF);
}

std::string to_string(const Ipv4Endpoint& endpoint) {
  return fmt::format("{}:{}", ipv4_text(endpoint.address), endpoint.port);
}

std::string to_string(const Sender& sender) {
  return sender.port ? to_string(Ipv4Endpoint{sender.address, *sender.port})
                     : ipv4_text(sender.address);
}

sockaddr_in socket_address(const Ipv4Endpoint& endpoint) noexcept {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(endpoint.address);
  address.sin_port = htons(endpoint.port);
  return address;
}

Ipv4Endpoint endpoint_of(const sockaddr_in& address) noexcept {
  return {ntohl(address.sin_addr.s_addr), ntohs(address.sin_port)};
}

}  // namespace terracut::net
