// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "tests/support/http_client.hpp"

namespace terracut::test {

enum class WebSocketOp : std::uint8_t {
  kContinuation = 0,
  kText = 1,
  kBinary = 2,
  kClose = 8,
  kPing = 9,
  kPong = 10
};

/// A client's frame (RFC 6455, 5.2), masked by zeros; of less than 64 KiB.
[[nodiscard]] inline std::string web_socket_frame(WebSocketOp op, std::string_view payload,
                                                  bool is_last = true) {
  const auto byte = [](std::size_t value) { return static_cast<char>(value & 0xFF); };
  std::string frame{byte((is_last ? 0x80U : 0U) | static_cast<std::size_t>(op))};
  if (payload.size() < 126) {
    frame += byte(0x80 | payload.size());
  } else {
    frame += {byte(0xFE), byte(payload.size() >> 8), byte(payload.size())};
  }
  return frame.append(4, '\0').append(payload);
}

/// `headers`: whole lines, besides those that a WebSocket needs.
[[nodiscard]] inline std::string web_socket_handshake(std::string_view headers) {
  return "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
         std::string(headers) + "\r\n";
}

struct WebSocketMessage {
  WebSocketOp op = WebSocketOp::kClose;  ///< Also where the server hung up.
  std::string payload;
};

/// The server's next frame; of servers that fragment nothing.
[[nodiscard]] inline WebSocketMessage next_message(HttpClient& client) {
  const auto number_of = [&](std::size_t count) {
    std::size_t number = 0;
    for (const char byte : client.read(count))
      number = number << 8 | static_cast<unsigned char>(byte);
    return number;
  };
  const std::size_t begin = number_of(2);
  if (begin == 0) return {};
  std::size_t size = begin & 0x7F;
  if (size == 126) size = number_of(2);
  if (size == 127) size = number_of(8);
  return {static_cast<WebSocketOp>(begin >> 8 & 0xF), client.read(size)};
}

}  // namespace terracut::test
