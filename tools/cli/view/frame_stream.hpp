// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "tools/cli/http/http_connection.hpp"
#include "view_routes.hpp"

namespace terracut::cli {

/// What one browser gets.
enum class Streamed : std::uint8_t {
  kFrames,
  kSectors,
  /// Frames, with the flag kFrameCompared followed by FrameComparison::of_returns.
  kComparedFrames,
};
/// A bit of stream::FrameWireHeader::flags: a byte for each point follows the points.
inline constexpr std::uint32_t kFrameCompared = 1U << 31;

/// Streams labelled frames, or their sectors, to one browser as the body of an answer, until either
/// side ends. While a frame is being sent, only the newest later one waits; of sectors
/// ViewFrames::kSectorsKept.
class FrameStream final : public HttpGuest, public std::enable_shared_from_this<FrameStream> {
 public:
  FrameStream(HttpStream stream, ViewSource& source, Streamed what);
  ~FrameStream() override;

  void begin();
  /// Sends what the browser does not have yet, if it is ready: the newest frame or the next sector.
  void send_next();

  [[nodiscard]] HttpStream& stream() noexcept override { return stream_; }

 private:
  void notice_end();

  HttpStream stream_;
  ViewSource& source_;
  Streamed what_;
  std::uint64_t seen_ = 0;
  stream::FrameWireHeader header_{};
  std::shared_ptr<const ViewFrames::Kept> kept_;  ///< What is being sent.
  bool is_sending_ = false;
  std::array<char, 256> heard_{};
};

}  // namespace terracut::cli
