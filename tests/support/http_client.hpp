// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "rt/files/owned_descriptor.hpp"

namespace terracut::test {

struct HttpResponse {
  int status = 0;  ///< 0: there was no answer.
  std::string head, body;
};

/// A client of a server of this machine, which may send it anything. What it waits for comes within
/// a minute.
class HttpClient {
 public:
  /// `receive_buffer_bytes`: for one that is to stop taking what is sent; 0: the system's.
  explicit HttpClient(std::uint16_t port, int receive_buffer_bytes = 0)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_buffer_bytes > 0) {
      ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes,
                   sizeof receive_buffer_bytes);
    }
    const ::timeval patience{60, 0};
    ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ::setsockopt(socket_.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    ::sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_port = htons(port);
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_connected_ =
        ::connect(socket_.get(), reinterpret_cast<const ::sockaddr*>(&at), sizeof at) == 0;
  }

  [[nodiscard]] bool is_connected() const { return is_connected_; }

  /// False: the server does not take it any more.
  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ::ssize_t sent = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }
  void end_sending() { ::shutdown(socket_.get(), SHUT_WR); }

  /// So many bytes; fewer: the server hung up, or said nothing for long.
  std::string read(std::size_t count) {
    while (came_.size() < count && receive()) {
    }
    count = std::min(count, came_.size());
    std::string taken = came_.substr(0, count);
    came_.erase(0, count);
    return taken;
  }
  std::string read_until(std::string_view end) {
    while (came_.find(end) == std::string::npos && receive()) {
    }
    const std::size_t found = came_.find(end);
    return read(found == std::string::npos ? came_.size() : found + end.size());
  }
  /// Until the server hangs up.
  std::string rest() {
    while (receive()) {
    }
    return std::exchange(came_, {});
  }
  HttpResponse response() {
    HttpResponse response;
    response.head = read_until("\r\n\r\n");
    if (response.head.starts_with("HTTP/1.1 ")) response.status = std::atoi(&response.head[9]);
    response.body = rest();
    return response;
  }
  /// Whether the server hangs up, without another word.
  [[nodiscard]] bool is_hung_up_on() { return !receive() && has_ended_; }

 private:
  bool receive() {
    char part[65536];
    ::ssize_t got = 0;
    do {
      got = ::recv(socket_.get(), part, sizeof part, 0);
    } while (got < 0 && errno == EINTR);  // not begun again by itself where there is a patience
    if (got > 0) came_.append(part, static_cast<std::size_t>(got));
    has_ended_ = got == 0 || (got < 0 && errno == ECONNRESET);
    return got > 0;
  }

  files::OwnedDescriptor socket_;
  bool is_connected_ = false, has_ended_ = false;
  std::string came_;
};

/// `headers`: whole lines; Host is localhost unless they say it.
inline HttpResponse ask(std::uint16_t port, std::string_view method, std::string_view path,
                        std::string_view headers = {}, std::string_view body = {}) {
  std::string request(method);
  request.append(" ").append(path).append(" HTTP/1.1\r\n");
  if (headers.find("Host:") == std::string_view::npos) request.append("Host: localhost\r\n");
  request.append(headers);
  if (!body.empty() || method == "POST") {
    request.append("Content-Length: ").append(std::to_string(body.size())).append("\r\n");
  }
  HttpClient client(port);
  client.send(request.append("\r\n").append(body));
  return client.response();
}
inline HttpResponse get(std::uint16_t port, std::string_view path, std::string_view headers = {}) {
  return ask(port, "GET", path, headers);
}

}  // namespace terracut::test
