// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "tools/cli/http/http_connection.hpp"
#include "view_routes.hpp"

namespace terracut::cli {

/// Streams labelled frames to one browser as the body of an answer, until either side ends. While a
/// frame is being sent, only the newest later one waits.
class FrameStream final : public HttpGuest, public std::enable_shared_from_this<FrameStream> {
 public:
  FrameStream(HttpStream stream, ViewSource& source);
  ~FrameStream() override;

  void begin();
  /// Sends the newest frame if the browser does not have it yet and is ready.
  void send_newest();

  [[nodiscard]] HttpStream& stream() noexcept override { return stream_; }

 private:
  void notice_end();

  HttpStream stream_;
  ViewSource& source_;
  std::uint64_t seen_ = 0;
  stream::FrameWireHeader header_{};
  std::shared_ptr<const ViewFrames::Kept> frame_;  ///< The frame being sent.
  bool is_sending_ = false;
  std::array<char, 256> heard_{};
};

}  // namespace terracut::cli
