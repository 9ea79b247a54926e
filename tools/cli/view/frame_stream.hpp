// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "tools/cli/http/http_connection.hpp"
#include "view_routes.hpp"

namespace terracut::cli {

/// Streams labelled frames, or sectors, to one browser as the body of an answer, until either side
/// ends. While it sends, no more waits than ViewFrames keeps.
class FrameStream final : public HttpGuest, public std::enable_shared_from_this<FrameStream> {
 public:
  FrameStream(HttpStream stream, ViewSource& source);
  ~FrameStream() override;

  void begin();
  /// Sends what the browser does not have yet, if it is ready.
  void send_later();

  [[nodiscard]] HttpStream& stream() noexcept override { return stream_; }

 private:
  void notice_end();

  HttpStream stream_;
  ViewSource& source_;
  std::uint64_t seen_ = 0;
  std::uint32_t missed_ = 0;
  // What is being sent:
  std::vector<std::shared_ptr<const ViewFrames::Kept>> kept_;
  std::vector<stream::FrameWireHeader> headers_;
  bool is_sending_ = false;
  std::array<char, 256> heard_{};
};

}  // namespace terracut::cli
