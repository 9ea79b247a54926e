// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::stage {

/// What the street as remembered did for a frame.
struct MemoryReport {
  bool used = false;           ///< Frames before were remembered, and their motion believed.
  bool contradicted = false;   ///< What is certain in this frame did not fit: all was forgotten.
  std::uint32_t priors = 0;    ///< Unknown cells of which something was remembered.
  std::uint32_t reopened = 0;  ///< Low steep obstacles that were left to the cut.
};

}  // namespace terracut::stage
