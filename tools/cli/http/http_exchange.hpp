// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

namespace terracut::cli {

struct HttpConnection;
class HttpGuest;

/// The parts of a request that answers depend on. A missing header is empty.
struct HttpRequest {
  std::string_view method{};  ///< "GET", also for HEAD; "POST"
  std::string_view path{};    ///< "/metrics": without what follows a question mark
  std::string_view body{};
  std::string_view host{}, origin{}, user_agent{}, sub_protocols{};
  std::string_view fetch_site{}, fetch_mode{};  ///< Sec-Fetch-Site and -Mode, which browsers send.
  std::string_view page{};                      ///< X-Terracut-Page, which the page's scripts send.
};

struct HttpAnswer {
  int status = 200;
  std::string body{};
  std::string_view type = "text/plain; charset=utf-8";
};

/// Turns the connection into a guest, which stays.
using HttpTakeover = std::function<std::shared_ptr<HttpGuest>(HttpConnection&&)>;
using HttpReply = std::variant<HttpAnswer, HttpTakeover>;
/// Called on the server's thread. An exception costs only this client its answer.
using HttpResponder = std::function<HttpReply(const HttpRequest&)>;

/// Returns an answer of one line of text, with its end.
[[nodiscard]] inline HttpAnswer http_refusal(int status, const std::string& why) {
  return {.status = status, .body = why + "\n"};
}

}  // namespace terracut::cli
