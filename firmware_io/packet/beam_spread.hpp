// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::packet {

/// How far beams point off the head: every beam's azimuth minus the head's is in [hindmost,
/// foremost].
struct BeamSpread {
  std::int64_t hindmost_ticks = 0, foremost_ticks = 0;
};

}  // namespace terracut::packet
