// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>

#include "tools/cli/http/http_exchange.hpp"
#include "view_frames.hpp"
#include "viewed_capture.hpp"

namespace terracut::cli {

/// What the page is answered from; outlives its server.
struct ViewSource {
  ViewFrames& frames;
  ViewedCapture* capture = nullptr;                ///< Null: a live run, which nobody plays.
  std::atomic<int> streams{0};                     ///< Browsers that get frames.
  std::atomic<std::uint64_t> sent{0}, skipped{0};  ///< Frames times browsers.
};

/// Answers:
///
///   GET  /, /view.js, ...   the page
///   GET  /frames            the labelled stream, from the newest frame on (FrameStream)
///   GET  /figures           ViewFrames::figures(), and of a capture its PlayerState
///   POST /control           a PlayerCommand as JSON; answered as /figures
///
/// What pages of other origins have a browser ask gets 403. Nothing that is sent here is kept.
[[nodiscard]] HttpReply answer_view(ViewSource& source, const HttpRequest& asked);

}  // namespace terracut::cli
