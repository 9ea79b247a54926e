// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::points {

/// Says which part of a frame a sector is: the returns of a tile of firings, labelled while the
/// rest of the frame may still be arriving.
struct SectorRecord {
  std::uint32_t frame = 0;         ///< Number of its frame.
  std::uint32_t first_return = 0;  ///< Index in the frame of its first return.
  /// Stamps of the packets of its first and last firing.
  std::int64_t first_packet_ns = 0, last_packet_ns = 0;
  std::int64_t labels_ns = 0;  ///< Time of day when its labels were known.
};

}  // namespace terracut::points
