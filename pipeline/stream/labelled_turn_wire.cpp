// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/labelled_turn_wire.hpp"

#include <fmt/format.h>

#include <cstring>

namespace terracut::stream {

Expected<std::size_t> turn_header_bytes(std::span<const std::byte> preamble) {
  if (preamble.size() < kTurnPreambleBytes) {
    return fail(ErrorCode::kMalformed,
                fmt::format("a labelled turn begins with {} bytes, there are {}",
                            kTurnPreambleBytes, preamble.size()));
  }
  if (std::memcmp(preamble.data(), kTurnMagic.data(), kTurnMagic.size()) != 0) {
    return fail(ErrorCode::kMalformed,
                "no labelled turn: expected it to begin with 'TCLT'; is this the address given to "
                "`terracut live --stream`?");
  }
  std::array<std::byte, sizeof(TurnWireHeader)> padded{};
  std::memcpy(padded.data(), preamble.data(), kTurnPreambleBytes);
  const auto header = std::bit_cast<TurnWireHeader>(padded);
  if (header.version != kTurnWireVersion) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("labelled turns of version {}; this reader knows version {}",
                            header.version, kTurnWireVersion));
  }
  if (header.header_bytes < sizeof(TurnWireHeader)) {
    return fail(ErrorCode::kMalformed,
                fmt::format("a labelled turn's header of {} bytes; version {} has at least {}",
                            header.header_bytes, header.version, sizeof(TurnWireHeader)));
  }
  return header.header_bytes;
}

Expected<TurnWireHeader> parse_turn_header(std::span<const std::byte> bytes) {
  const auto expected_bytes = turn_header_bytes(bytes);
  if (!expected_bytes) return tl::unexpected(expected_bytes.error());
  if (bytes.size() < *expected_bytes) {
    return fail(ErrorCode::kMalformed, fmt::format("a labelled turn's header cut off after {} of "
                                                   "{} bytes",
                                                   bytes.size(), *expected_bytes));
  }
  TurnWireHeader header;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.point_bytes < sizeof(LabelledPoint)) {
    return fail(ErrorCode::kMalformed,
                fmt::format("labelled points of {} bytes; version {} has at least {}",
                            header.point_bytes, header.version, sizeof(LabelledPoint)));
  }
  if (header.points > kMostTurnPoints) {
    return fail(ErrorCode::kCapacityExceeded,
                fmt::format("a labelled turn of {} points; {} is the most there may be",
                            header.points, kMostTurnPoints));
  }
  return header;
}

}  // namespace terracut::stream
