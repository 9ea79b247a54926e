// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::can {

/// What became of the lines or records of a recording of a CAN bus.
/// records == delivered + no_frame + other_interface + malformed.
struct CanLogCounters {
  std::uint64_t records = 0;
  std::uint64_t delivered = 0;
  std::uint64_t no_frame = 0;         ///< Well formed, but another thing: comments, CAN XL, UDP.
  std::uint64_t other_interface = 0;  ///< Frames of another interface than the one asked for.
  std::uint64_t malformed = 0;        ///< The first one is described by the source's first_fault().
};

}  // namespace terracut::can
