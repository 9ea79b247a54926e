// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "rt/error.hpp"
#include "tools/cli/http/http_server.hpp"
#include "tools/cli/view/viewed_capture.hpp"

namespace terracut::cli {

/// Serves ROS 2 messages to Foxglove, Lichtblick and others with their WebSocket protocol
/// (protocol.hpp), on a thread of its own. A client that has not taken a channel's last message
/// misses the next: at most one message a channel waits for a slow client, and it delays nobody.
///
/// Input is bounded: by HttpBounds, then by texts of 16 KiB and one subscription a channel. A
/// client that stops reading holds a message a channel until it is disconnected. Host and Origin of
/// a request are checked; there is neither encryption nor a password.
class FoxgloveServer {
 public:
  struct Config {
    net::Ipv4Endpoint at;  ///< Port 0: chosen by the system.
    std::string name;      ///< For people.
    std::vector<bool> topics;
    std::vector<std::string> origins{};  ///< Pages that may connect besides this machine's.
    ViewedCapture* capture = nullptr;  ///< A capture that clients may play; outlives the server.
    HttpBounds bounds{};
  };
  /// Counts since the start. From any thread.
  struct Figures {
    std::atomic<std::uint64_t> skipped{0};       ///< Messages that a slow client missed.
    std::atomic<std::uint64_t> bad_requests{0};  ///< Messages that were not understood.
  };

  /// Errors of HttpServer::start().
  [[nodiscard]] static Expected<FoxgloveServer> start(const Config& config);
  FoxgloveServer(FoxgloveServer&&) noexcept;
  FoxgloveServer& operator=(FoxgloveServer&&) = delete;
  ~FoxgloveServer();

  [[nodiscard]] std::uint16_t port() const noexcept;
  [[nodiscard]] const Figures& figures() const noexcept;
  [[nodiscard]] const HttpServer::Figures& connections() const noexcept;

  using Message = std::shared_ptr<const std::vector<std::byte>>;

  // For one other thread:

  /// True if a client has subscribed, so that a message is worth making.
  [[nodiscard]] bool is_wanted(std::size_t topic) const noexcept;
  void publish(std::size_t topic, std::int64_t time_ns, Message message);
  /// Keeps a message to be sent once to each subscriber, present and later ones.
  void keep(std::size_t topic, std::int64_t time_ns, Message message);

 private:
  struct State;
  explicit FoxgloveServer(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace terracut::cli
