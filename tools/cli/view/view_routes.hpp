// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>

#include "tools/cli/http/http_exchange.hpp"
#include "view_frames.hpp"
#include "viewed_capture.hpp"

namespace terracut::cli {

/// Where the page's answers come from; must outlive the server.
struct ViewSource {
  ViewFrames& frames;
  ViewedCapture* capture = nullptr;  ///< Null: a live run, which has no player.
  std::atomic<int> streams{0};       ///< Browsers that receive frames.
  /// Counted for each browser: frames and sectors sent, and what was skipped of either.
  std::atomic<std::uint64_t> sent{0}, skipped{0}, sectors_skipped{0};
};

/// Answers:
///
///   GET  /, /view.js, ...   the page
///   GET  /frames            the labelled stream, from the newest frame on (FrameStream)
///   GET  /sectors           the same by sectors, from a turn ago on; of a capture as /frames
///   GET  /shown             what the page draws: /sectors, and frames with what they are compared
///                           with (Streamed::kComparedFrames)
///   GET  /figures           ViewFrames::figures(), and of a capture its PlayerState
///   POST /control           a PlayerCommand as JSON; answered as /figures
///
/// Requests by pages of other origins get 403. No request is stored.
[[nodiscard]] HttpReply answer_view(ViewSource& source, const HttpRequest& asked);

}  // namespace terracut::cli
