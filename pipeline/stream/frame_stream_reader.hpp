// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/stream/labelled_frame_wire.hpp"
#include "pipeline/stream/stream_address.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::stream {

struct ReceivedFrame {
  FrameWireHeader header;
  std::vector<LabelledPoint> points;
};

/// The other end of a FrameStreamServer: labelled frames from a running `terracut live`.
///
///     auto reader = FrameStreamReader::connect(*parse_stream_address("127.0.0.1:7447"));
///     ReceivedFrame frame;
///     while (reader && reader->next(frame, -1).value_or(false)) ...
///
/// Senders with longer headers or points are read too; what this version does not know is skipped.
/// One thread. Waits and allocates; nothing for a real-time thread.
class FrameStreamReader {
 public:
  /// kNotFound: nobody serves frames there. kUnreadable: another refusal of the system.
  [[nodiscard]] static Expected<FrameStreamReader> connect(const StreamAddress& address);

  /// Of a socket that is connected already.
  explicit FrameStreamReader(files::OwnedDescriptor socket) noexcept : socket_(std::move(socket)) {}

  /// The next whole frame; its vector's room is used again. False: the sender ended the stream,
  /// after a whole frame. kUnreadable: nothing came for `patience_ns` (-1: wait as long as it
  /// takes), or the connection broke. kMalformed: the stream ended within a frame, or is no stream
  /// of frames; also the errors of parse_frame_header(). After an error there is nothing more to
  /// read.
  [[nodiscard]] Expected<bool> next(ReceivedFrame& frame, std::int64_t patience_ns);

 private:
  /// How many bytes came before the stream ended: all, or fewer.
  [[nodiscard]] Expected<std::size_t> fill(std::span<std::byte> bytes, std::int64_t patience_ns);
  [[nodiscard]] Status fill_all(std::span<std::byte> bytes, std::int64_t patience_ns);

  files::OwnedDescriptor socket_;
  std::vector<std::byte> header_;
  std::vector<std::byte> wide_points_;
};

}  // namespace terracut::stream
