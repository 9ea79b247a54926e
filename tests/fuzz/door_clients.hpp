// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <thread>

#include "input.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "tools/cli/http/http_server.hpp"

namespace terracut::fuzz {

/// For servers under test: what a fuzzer sends is not slowed down.
inline constexpr cli::HttpBounds kUnhurried{.connections_a_second = 1'000'000,
                                            .bytes_a_second = 1 << 20};

/// What four clients of a server of this machine do, one thing after another, out of a fuzzer's
/// input. A byte says what (its low 3 bits) and who (the next 2):
///
///   0     a line of `phrases`, which the next byte chooses
///   1     so many bytes as they lie; of 255, one byte 1 to 65535 times
///   2     so many bytes, framed as the next byte says (Framing)
///   3, 4  listens to what is there
///   5     ends its sending
///   6     goes; of an odd byte, by a reset
///   7     something else happens (Event)
class DoorClients {
 public:
  using Framing = std::function<std::string(unsigned how, std::string_view payload)>;
  using Event = std::function<void(unsigned what)>;

  DoorClients(std::uint16_t port, std::span<const std::string> phrases, Framing framing,
              Event event)
      : port_(port), phrases_(phrases), framing_(std::move(framing)), event_(std::move(event)) {}

  void run(Input& input) {
    while (!input.empty()) {
      const std::uint32_t byte = input.next(1);
      Client& client = clients_[byte >> 3 & 3];
      switch (byte & 7) {
        case 0:
          send(client, phrases_[static_cast<std::size_t>(input.next(1)) % phrases_.size()]);
          break;
        case 1: {
          const std::uint32_t count = input.next(1);
          send(client, count == 255 ? many(input) : text(input.take(count)));
          break;
        }
        case 2: {
          const std::uint32_t how = input.next(1);
          send(client, framing_(how, text(input.take(input.next(1)))));
          break;
        }
        case 5:
          ::shutdown(client.socket.get(), SHUT_WR);
          break;
        case 6:
          leave(client, (input.next(1) & 1) != 0);
          break;
        case 7:
          event_(input.next(1));
          break;
        default:
          listen(client);
      }
    }
  }

  void leave() {
    for (Client& client : clients_) leave(client, false);
  }

 private:
  struct Client {
    files::OwnedDescriptor socket;
    std::string heard;  ///< Its beginning.
  };

  static std::string text(std::span<const std::uint8_t> bytes) {
    return {bytes.begin(), bytes.end()};
  }
  static std::string many(Input& input) {
    const std::uint32_t count = input.next(2);
    return std::string(count, static_cast<char>(input.next(1)));
  }

  void connect(Client& client) const {
    client.heard.clear();
    client.socket =
        files::OwnedDescriptor(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    ::sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(port_);
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    (void)::connect(client.socket.get(), reinterpret_cast<const ::sockaddr*>(&at), sizeof at);
  }

  void send(Client& client, std::string_view bytes) const {
    if (!client.socket) connect(client);
    (void)::send(client.socket.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  }

  static void listen(Client& client) {
    constexpr int kPatience_ms = 5;
    constexpr std::string_view kAnswer = "HTTP/1.1 ";
    if (!client.socket) return;
    ::pollfd ready{client.socket.get(), POLLIN, 0};
    if (::poll(&ready, 1, kPatience_ms) <= 0) return;
    std::array<char, 65536> part;
    const ::ssize_t got = ::recv(client.socket.get(), part.data(), part.size(), MSG_DONTWAIT);
    if (got > 0 && client.heard.size() < kAnswer.size()) {
      client.heard.append(part.data(), static_cast<std::size_t>(got));
    }
    const std::size_t told = std::min(client.heard.size(), kAnswer.size());
    require(client.heard.substr(0, told) == kAnswer.substr(0, told), "no answer in HTTP");
  }

  static void leave(Client& client, bool by_reset) {
    if (by_reset && client.socket) {
      const ::linger now{1, 0};
      ::setsockopt(client.socket.get(), SOL_SOCKET, SO_LINGER, &now, sizeof now);
    }
    client.socket.close();
  }

  std::uint16_t port_;
  std::span<const std::string> phrases_;
  Framing framing_;
  Event event_;
  std::array<Client, 4> clients_;
};

/// Ends the program, as a finding, unless it comes to hold within some seconds.
inline void require_soon(const std::function<bool()>& holds, std::string_view otherwise) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(8);
  while (!holds()) {
    require(std::chrono::steady_clock::now() < until, otherwise);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace terracut::fuzz
