// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::can {

/// Counts the lines or records of a recording of a CAN bus. records == delivered + no_frame +
/// other_interface + malformed.
struct CanLogCounters {
  std::uint64_t records = 0;
  std::uint64_t delivered = 0;
  /// Well-formed lines that are not CAN frames: comments, CAN XL, UDP.
  std::uint64_t no_frame = 0;
  std::uint64_t other_interface = 0;  ///< Frames of an interface other than the one asked for.
  /// Malformed lines; first_fault() of the source describes the first.
  std::uint64_t malformed = 0;
};

}  // namespace terracut::can
