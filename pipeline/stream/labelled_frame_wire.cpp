// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/labelled_frame_wire.hpp"

#include <fmt/format.h>

#include <cstring>

namespace terracut::stream {

Expected<std::size_t> frame_header_bytes(std::span<const std::byte> preamble) {
  if (preamble.size() < kFramePreambleBytes) {
    return fail(ErrorCode::kMalformed,
                fmt::format("a labelled frame begins with {} bytes, there are {}",
                            kFramePreambleBytes, preamble.size()));
  }
  if (std::memcmp(preamble.data(), kFrameMagic.data(), kFrameMagic.size()) != 0) {
    return fail(ErrorCode::kMalformed,
                "no labelled frame: expected it to begin with 'TCLT'; is this the address given to "
                "`terracut live --stream`?");
  }
  std::array<std::byte, sizeof(FrameWireHeader)> padded{};
  std::memcpy(padded.data(), preamble.data(), kFramePreambleBytes);
  const auto header = std::bit_cast<FrameWireHeader>(padded);
  if (header.version != kFrameWireVersion) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("labelled frames of version {}; this reader knows version {}",
                            header.version, kFrameWireVersion));
  }
  if (header.header_bytes < sizeof(FrameWireHeader)) {
    return fail(ErrorCode::kMalformed,
                fmt::format("a labelled frame's header of {} bytes; version {} has at least {}",
                            header.header_bytes, header.version, sizeof(FrameWireHeader)));
  }
  return header.header_bytes;
}

Expected<FrameWireHeader> parse_frame_header(std::span<const std::byte> bytes) {
  const auto expected_bytes = frame_header_bytes(bytes);
  if (!expected_bytes) return tl::unexpected(expected_bytes.error());
  if (bytes.size() < *expected_bytes) {
    return fail(ErrorCode::kMalformed, fmt::format("a labelled frame's header cut off after {} of "
                                                   "{} bytes",
                                                   bytes.size(), *expected_bytes));
  }
  FrameWireHeader header;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.point_bytes < sizeof(LabelledPoint)) {
    return fail(ErrorCode::kMalformed,
                fmt::format("labelled points of {} bytes; version {} has at least {}",
                            header.point_bytes, header.version, sizeof(LabelledPoint)));
  }
  if (header.points > kMostFramePoints) {
    return fail(ErrorCode::kCapacityExceeded,
                fmt::format("a labelled frame of {} points; {} is the most there may be",
                            header.points, kMostFramePoints));
  }
  return header;
}

}  // namespace terracut::stream
