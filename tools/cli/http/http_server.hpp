// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "http_exchange.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// What the clients of a server may take of the machine, all of them together.
struct HttpBounds {
  /// Connections at once that have not been answered. One more ends the oldest of them: whoever
  /// sends its request is answered before it is the oldest, whoever says nothing makes room.
  std::size_t visits = 32;
  /// From coming to having taken the answer.
  std::chrono::milliseconds visit_time{5'000};
  /// Connections at once that stay: streams of frames, viewers.
  std::size_t guests = 8;
  /// A guest that takes nothing for so long of what is being written is disconnected.
  std::chrono::milliseconds stall_time{10'000};
  /// What comes faster waits in the system's queue of 64, or beyond it.
  int connections_a_second = 250;
  /// Read from one connection: what comes faster waits.
  std::size_t bytes_a_second = 8 << 10;

  static constexpr std::size_t kHeaderBytes = 8 << 10, kBodyBytes = 4 << 10;
};

/// Answers HTTP/1.1, one request a connection, from one thread of its own and of the caller's
/// scheduling class: start it from a normal thread. There is neither encryption nor a password.
///
/// Clients take no more than HttpBounds, whatever they send: a request is headers of 8 KiB and a
/// body of 4 KiB whose length is said before. Requests for another machine's name (http_host.hpp)
/// get 403; a header that decides on something (Host, Origin, ...) and comes twice gets 400. What
/// the thread throws, for want of memory for example, costs the connection that it was at.
class HttpServer {
 public:
  struct Config {
    net::Ipv4Endpoint at;  ///< Port 0: one the system chooses.
    std::string what;      ///< For people: "the page".
    HttpBounds bounds{};
  };
  /// Since the start. From any thread.
  struct Figures {
    /// Requests: answered by 400 and above, but for 404, or not at all.
    std::atomic<std::uint64_t> refused{0};
    std::atomic<std::uint64_t> stalled{
        0};  ///< Guests that took nothing for HttpBounds::stall_time.
    std::atomic<std::uint64_t> failures{0};  ///< Times that the system had no descriptor or memory.
  };

  /// kInvalidArgument with the system's reason, such as a port in use; kCapacityExceeded: there is
  /// no descriptor or thread left.
  [[nodiscard]] static Expected<HttpServer> start(const Config& config, HttpResponder respond);

  HttpServer(HttpServer&&) noexcept;
  HttpServer& operator=(HttpServer&&) = delete;
  /// Ends all connections. Waits for no client.
  ~HttpServer();

  [[nodiscard]] std::uint16_t port() const noexcept;
  [[nodiscard]] const Figures& figures() const noexcept;

  // From any thread; done on the server's, soon, in order.

  void post(std::function<void()> work);
  void for_each_guest(std::function<void(HttpGuest&)> work);

 private:
  struct State;
  explicit HttpServer(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace terracut::cli
