// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::stage {

/// The effect of the street memory on a frame.
struct MemoryReport {
  bool used = false;           ///< Earlier frames were used and their motion was trusted.
  bool contradicted = false;   ///< Certain cells contradicted the memory, which was erased.
  std::uint32_t priors = 0;    ///< Unknown cells that the memory knew.
  std::uint32_t reopened = 0;  ///< Low steep obstacles made unknown.
};

}  // namespace terracut::stage
