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
  /// Most unanswered connections at once. One more ends the oldest: a client that sends its request
  /// is answered before that, a silent one makes room.
  std::size_t visits = 32;
  /// From connecting to having taken the answer.
  std::chrono::milliseconds visit_time{5'000};
  /// Most lasting connections at once: streams of frames, viewers.
  std::size_t guests = 8;
  /// A guest that takes nothing of what is being written for so long is disconnected.
  std::chrono::milliseconds stall_time{10'000};
  /// Faster ones wait in the system's queue of 64, or outside it.
  int connections_a_second = 250;
  /// Read from one connection; more waits.
  std::size_t bytes_a_second = 8 << 10;

  static constexpr std::size_t kHeaderBytes = 8 << 10, kBodyBytes = 4 << 10;
};

/// Answers HTTP/1.1, one request a connection, from one thread of its own and of the caller's
/// scheduling class: start it from a normal thread. There is neither encryption nor a password.
///
/// Clients take no more than HttpBounds, whatever they send: a request is headers of 8 KiB and a
/// body of 4 KiB whose length is said before. Requests for another machine's name (http_host.hpp)
/// get 403; a duplicate of a header that decides something (Host, Origin and the like) gets 400. An
/// exception on the thread, for lack of memory for example, costs only the connection being served.
class HttpServer {
 public:
  struct Config {
    net::Ipv4Endpoint at;  ///< Port 0: chosen by the system.
    std::string what;      ///< For people: "the page".
    HttpBounds bounds{};
  };
  /// Counts since the start. From any thread.
  struct Figures {
    /// Requests not answered, or with 400 and above except 404.
    std::atomic<std::uint64_t> refused{0};
    std::atomic<std::uint64_t> stalled{
        0};  ///< Guests that took nothing for HttpBounds::stall_time.
    std::atomic<std::uint64_t> failures{0};  ///< Times the system had no descriptor or memory.
  };

  /// Errors: kInvalidArgument with the system's reason, such as a port in use; kCapacityExceeded:
  /// no descriptor or thread is left.
  [[nodiscard]] static Expected<HttpServer> start(const Config& config, HttpResponder respond);

  HttpServer(HttpServer&&) noexcept;
  HttpServer& operator=(HttpServer&&) = delete;
  /// Ends all connections. Waits for no client.
  ~HttpServer();

  [[nodiscard]] std::uint16_t port() const noexcept;
  [[nodiscard]] const Figures& figures() const noexcept;

  // From any thread; executed on the server's thread, soon and in order.

  void post(std::function<void()> work);
  void for_each_guest(std::function<void(HttpGuest&)> work);

 private:
  struct State;
  explicit HttpServer(std::unique_ptr<State> state) noexcept;
  std::unique_ptr<State> state_;
};

}  // namespace terracut::cli
