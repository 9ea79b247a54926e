// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/stream_address.hpp"

#include <fmt/format.h>
#include <sys/un.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace terracut::stream {
namespace {

constexpr std::size_t kMostPathBytes = sizeof(::sockaddr_un::sun_path) - 1;

}  // namespace

Expected<net::Ipv4Endpoint> parse_serving_endpoint(std::string_view text) {
  auto endpoint = net::parse_ipv4_endpoint(text);
  const auto colon = text.rfind(':');
  const bool port_alone = colon == std::string_view::npos || colon == 0;
  if (endpoint && port_alone) endpoint->address = kLoopbackAddress;
  return endpoint;
}

Expected<StreamAddress> parse_stream_address(std::string_view text) {
  if (text.find('/') != std::string_view::npos) {
    if (text.size() > kMostPathBytes) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("'{}' has {} bytes; the path of a Unix socket has at most {}", text,
                              text.size(), kMostPathBytes));
    }
    return StreamAddress{.unix_path = std::string(text)};
  }
  const auto endpoint = parse_serving_endpoint(text);
  if (!endpoint) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("'{}' is no address for a stream; expected ADDRESS:PORT like "
                            "127.0.0.1:7447, a port alone, or the path of a Unix socket like "
                            "/run/terracut/frames",
                            text));
  }
  return StreamAddress{.tcp = *endpoint};
}

std::string to_string(const StreamAddress& address) {
  return address.is_unix() ? address.unix_path : to_string(address.tcp);
}

SocketAddress socket_address(const StreamAddress& address) noexcept {
  SocketAddress result;
  if (!address.is_unix()) {
    const ::sockaddr_in tcp = socket_address(address.tcp);
    std::memcpy(&result.storage, &tcp, sizeof tcp);
    result.size = sizeof tcp;
    return result;
  }
  ::sockaddr_un local{};
  local.sun_family = AF_UNIX;
  std::memcpy(local.sun_path, address.unix_path.data(),
              std::min(address.unix_path.size(), kMostPathBytes));
  std::memcpy(&result.storage, &local, sizeof local);
  result.size = sizeof local;
  return result;
}

}  // namespace terracut::stream
