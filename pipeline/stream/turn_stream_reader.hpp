// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/stream/labelled_turn_wire.hpp"
#include "pipeline/stream/stream_address.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::stream {

struct ReceivedTurn {
  TurnWireHeader header;
  std::vector<LabelledPoint> points;
};

/// The other end of a TurnStreamServer: labelled turns from a running `terracut live`.
///
///     auto reader = TurnStreamReader::connect(*parse_stream_address("127.0.0.1:7447"));
///     ReceivedTurn turn;
///     while (reader && reader->next(turn, -1).value_or(false)) ...
///
/// Senders with longer headers or points are read too; what this version does not know is skipped.
/// One thread. Waits and allocates; nothing for a real-time thread.
class TurnStreamReader {
 public:
  /// kNotFound: nobody serves turns there. kUnreadable: another refusal of the system.
  [[nodiscard]] static Expected<TurnStreamReader> connect(const StreamAddress& address);

  /// Of a socket that is connected already.
  explicit TurnStreamReader(files::OwnedDescriptor socket) noexcept : socket_(std::move(socket)) {}

  /// The next whole turn; its vector's room is used again. False: the sender ended the stream,
  /// after a whole turn. kUnreadable: nothing came for `patience_ns` (-1: wait as long as it
  /// takes), or the connection broke. kMalformed: the stream ended within a turn, or is no stream
  /// of turns; also the errors of parse_turn_header(). After an error there is nothing more to
  /// read.
  [[nodiscard]] Expected<bool> next(ReceivedTurn& turn, std::int64_t patience_ns);

 private:
  /// How many bytes came before the stream ended: all, or fewer.
  [[nodiscard]] Expected<std::size_t> fill(std::span<std::byte> bytes, std::int64_t patience_ns);
  [[nodiscard]] Status fill_all(std::span<std::byte> bytes, std::int64_t patience_ns);

  files::OwnedDescriptor socket_;
  std::vector<std::byte> header_;
  std::vector<std::byte> wide_points_;
};

}  // namespace terracut::stream
