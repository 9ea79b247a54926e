// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "rt/memory/fixed_text.hpp"

namespace terracut::status {

/// A count with the name of what it counts.
struct NamedCount {
  memory::FixedText<40> name;
  std::uint64_t count = 0;
};

}  // namespace terracut::status
