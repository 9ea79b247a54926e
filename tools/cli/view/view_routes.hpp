// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "rt/error.hpp"
#include "view_frames.hpp"
#include "viewed_capture.hpp"

namespace httplib {
class Server;
}

namespace terracut::cli {

/// What the routes answer from; outlives them.
struct ViewSource {
  ViewFrames& frames;
  ViewedCapture* capture = nullptr;                ///< Null: a live run, which nobody plays.
  std::atomic<bool> is_over{false};                ///< Streams end.
  std::atomic<int> streams{0};                     ///< Browsers that get frames.
  std::atomic<std::uint64_t> sent{0}, skipped{0};  ///< Frames times browsers.
};

/// At most so many browsers get frames at once, each of which holds a thread.
inline constexpr int kMostViewers = 8;

/// Lets `server` answer:
///
///   GET  /, /view.js, ...   the page
///   GET  /frames            the labelled stream, from the newest frame on, until either side ends
///   it GET  /figures           ViewFrames::figures(), and of a capture its PlayerState POST
///   /control           a PlayerCommand as JSON; answered as /figures
///
/// Requests whose Host names another machine (http_host.hpp), and those that a page of another
/// origin sends, get 403. Nothing that is sent here is kept.
void route_view(httplib::Server& server, ViewSource& source);

/// Whether a browser's Origin header is that of a page which this server sent, as Host says; empty:
/// no browser's, or a page that asks its own server.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host);

}  // namespace terracut::cli
