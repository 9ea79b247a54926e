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
  std::string_view path{};    ///< Path without the part after a question mark: "/metrics".
  std::string_view body{};
  std::string_view host{}, origin{}, user_agent{}, sub_protocols{};
  std::string_view fetch_site{}, fetch_mode{};  ///< Sec-Fetch-Site and -Mode, sent by browsers.
  std::string_view page{};                      ///< X-Terracut-Page, sent by the page's scripts.
};

struct HttpAnswer {
  int status = 200;
  std::string body{};
  std::string_view type = "text/plain; charset=utf-8";
};

/// Makes a guest of a connection, which then stays open after the request.
using HttpTakeover = std::function<std::shared_ptr<HttpGuest>(HttpConnection&&)>;
using HttpReply = std::variant<HttpAnswer, HttpTakeover>;
/// Answers a request on the server's thread. If it throws, only this client gets no answer.
using HttpResponder = std::function<HttpReply(const HttpRequest&)>;

/// Returns an answer with one line of text, to which a line end is added.
[[nodiscard]] inline HttpAnswer http_refusal(int status, const std::string& why) {
  return {.status = status, .body = why + "\n"};
}

}  // namespace terracut::cli
