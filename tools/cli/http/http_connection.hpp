// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <utility>  // must precede Asio, which forgets to include it (chriskohlhoff/asio#944)
// This line keeps clang-format from sorting the first include below into the block above.
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>

namespace terracut::cli {

/// Limits how fast a client's data is read, and notes since when the client takes no data; a
/// RatePolicy of Beast.
class HttpPace {
 public:
  using Clock = std::chrono::steady_clock;

  explicit HttpPace(std::size_t read_bytes_a_second) noexcept
      : read_limit_(read_bytes_a_second), readable_(read_bytes_a_second) {}

  /// Returns the time since which the present write has not progressed; nothing if no write is
  /// under way.
  [[nodiscard]] std::optional<Clock::time_point> stands_since() const noexcept {
    return stands_since_;
  }

 private:
  friend class boost::beast::rate_policy_access;

  [[nodiscard]] std::size_t available_read_bytes() const noexcept { return readable_; }
  void transfer_read_bytes(std::size_t count) noexcept { readable_ -= std::min(count, readable_); }
  void on_timer() noexcept { readable_ = read_limit_; }
  /// Called by Beast as each part of a write begins.
  [[nodiscard]] std::size_t available_write_bytes() noexcept {
    stands_since_ = Clock::now();
    return SIZE_MAX;
  }
  void transfer_write_bytes(std::size_t /*count*/) noexcept { stands_since_.reset(); }

  std::size_t read_limit_, readable_;
  std::optional<Clock::time_point> stands_since_;
};

using HttpStream =
    boost::beast::basic_stream<boost::asio::ip::tcp, boost::asio::ip::tcp::socket::executor_type,
                               HttpPace>;

/// A connection with the request read from it, to be taken over by a guest.
struct HttpConnection {
  HttpStream stream;
  boost::beast::http::request<boost::beast::http::string_body> request;
};

/// A connection that stays open after its request, such as a stream of frames or a WebSocket. Its
/// handlers keep the guest alive. For the server's thread.
class HttpGuest {
 public:
  HttpGuest() = default;
  HttpGuest(const HttpGuest&) = delete;
  HttpGuest& operator=(const HttpGuest&) = delete;
  virtual ~HttpGuest() = default;

  [[nodiscard]] virtual HttpStream& stream() noexcept = 0;
  /// Does what is due. Called some ten times a second.
  virtual void work_round() {}
};

}  // namespace terracut::cli
