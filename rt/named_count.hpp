// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "rt/fixed_text.hpp"

namespace terracut::rt {

/// A count under the name of what it counts.
struct NamedCount {
  FixedText<40> name;
  std::uint64_t count = 0;
};

}  // namespace terracut::rt
