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

/// Serves ROS 2 messages to Foxglove, Lichtblick and others by their WebSocket protocol
/// (protocol.hpp), on a thread of its own. At most one message per channel waits for a slow client;
/// a client that has not taken it misses the next ones, and delays nobody.
///
/// Input is bounded by HttpBounds, by texts of 16 KiB and by one subscription per channel. Host and
/// Origin of a request are checked; there is neither encryption nor a password.
class FoxgloveServer {
 public:
  struct Config {
    net::Ipv4Endpoint at;  ///< Port 0: the system chooses the port.
    std::string name;      ///< Name of the server, for people.
    std::vector<bool> topics;
    std::vector<std::string> origins{};  ///< Foreign pages that may connect.
    ViewedCapture* capture = nullptr;  ///< Capture that clients may play; must outlive the server.
    HttpBounds bounds{};
  };
  /// Counts since the start. For any thread.
  struct Figures {
    std::atomic<std::uint64_t> skipped{0};       ///< Messages that a slow client missed.
    std::atomic<std::uint64_t> bad_requests{0};  ///< Messages that were not understood.
  };

  /// Starts the server. Fails with the errors of HttpServer::start().
  [[nodiscard]] static Expected<FoxgloveServer> start(const Config& config);
  FoxgloveServer(FoxgloveServer&&) noexcept;
  FoxgloveServer& operator=(FoxgloveServer&&) = delete;
  ~FoxgloveServer();

  [[nodiscard]] std::uint16_t port() const noexcept;
  [[nodiscard]] const Figures& figures() const noexcept;
  [[nodiscard]] const HttpServer::Figures& connections() const noexcept;

  using Message = std::shared_ptr<const std::vector<std::byte>>;

  // The following functions are for one other thread.

  /// True if a client has subscribed to the topic, so that a message is worth making.
  [[nodiscard]] bool is_wanted(std::size_t topic) const noexcept;
  void publish(std::size_t topic, std::int64_t time_ns, Message message);
  /// Keeps a message, to be sent once to each present and later subscriber of the topic.
  void keep(std::size_t topic, std::int64_t time_ns, Message message);

 private:
  struct State;
  explicit FoxgloveServer(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace terracut::cli
