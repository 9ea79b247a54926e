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

/// Limits of what all clients of a server together may use.
struct HttpBounds {
  /// The most unanswered connections at once. One more ends the oldest. Clients that send a request
  /// are answered before that happens, so only silent ones are ended.
  std::size_t visits = 32;
  /// Longest time from a client's connecting to its having received the answer.
  std::chrono::milliseconds visit_time{5'000};
  /// Most lasting connections at once: streams of frames and viewers.
  std::size_t guests = 8;
  /// A guest that takes no data for this long while something is written to it is disconnected.
  std::chrono::milliseconds stall_time{10'000};
  /// Most new connections per second; others wait in the system's queue of 64 or beyond it.
  int connections_a_second = 250;
  /// Most bytes read from one connection per second; further bytes wait.
  std::size_t bytes_a_second = 8 << 10;

  static constexpr std::size_t kHeaderBytes = 8 << 10, kBodyBytes = 4 << 10;
};

/// Answers HTTP/1.1, one request per connection, on a thread of its own with the caller's
/// scheduling class: start it from a normal thread. There is neither encryption nor a password.
///
/// Clients use no more than HttpBounds, whatever they send: a request has headers of at most 8 KiB
/// and a body of at most 4 KiB with a stated length. Requests for another machine's name
/// (http_host.hpp) get 403; a repeated header on which a check depends (Host, Origin and the like)
/// gets 400. An exception on the thread (such as lack of memory) costs only the connection being
/// served.
class HttpServer {
 public:
  struct Config {
    net::Ipv4Endpoint at;  ///< Port 0: the system chooses the port.
    std::string what;      ///< What is served, for people: "the page".
    HttpBounds bounds{};
  };
  /// Counts since the start. For any thread.
  struct Figures {
    /// Requests that got no answer, or a status of 400 and above except 404.
    std::atomic<std::uint64_t> refused{0};
    std::atomic<std::uint64_t> stalled{
        0};  ///< Guests that took nothing for HttpBounds::stall_time.
    std::atomic<std::uint64_t> failures{0};  ///< Times the system had no descriptor or memory.
  };

  /// Starts the server. Fails with kInvalidArgument and the system's reason, such as a port in use;
  /// kCapacityExceeded if no descriptor or thread is left.
  [[nodiscard]] static Expected<HttpServer> start(const Config& config, HttpResponder respond);

  HttpServer(HttpServer&&) noexcept;
  HttpServer& operator=(HttpServer&&) = delete;
  /// Ends all connections without waiting for any client.
  ~HttpServer();

  [[nodiscard]] std::uint16_t port() const noexcept;
  [[nodiscard]] const Figures& figures() const noexcept;

  // For any thread; the server's thread does the work soon, and in order.

  void post(std::function<void()> work);
  void for_each_guest(std::function<void(HttpGuest&)> work);

 private:
  struct State;
  explicit HttpServer(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace terracut::cli
