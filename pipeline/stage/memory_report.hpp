// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::stage {

/// The effect of the street memory on a frame.
struct MemoryReport {
  bool used = false;           ///< Earlier frames were remembered, and their motion trusted.
  bool contradicted = false;   ///< Certain cells contradicted the memory: all was forgotten.
  std::uint32_t priors = 0;    ///< Unknown cells with a memory.
  std::uint32_t reopened = 0;  ///< Low steep obstacles left to the cut.
};

}  // namespace terracut::stage
