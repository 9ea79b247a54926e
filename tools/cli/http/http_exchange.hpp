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

/// What is asked, as far as answers depend on it. A header that was not sent is empty.
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

/// Makes a guest of the connection: one that stays.
using HttpTakeover = std::function<std::shared_ptr<HttpGuest>(HttpConnection&&)>;
using HttpReply = std::variant<HttpAnswer, HttpTakeover>;
/// Called on the server's thread. What it throws costs the client its answer, nothing else.
using HttpResponder = std::function<HttpReply(const HttpRequest&)>;

/// In one line, which ends here.
[[nodiscard]] inline HttpAnswer http_refusal(int status, const std::string& why) {
  return {.status = status, .body = why + "\n"};
}

}  // namespace terracut::cli
