// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hazard.hpp"
#include "rt/error.hpp"
#include "tools/lab/world/random.hpp"

namespace terracut::hazards {

/// A kind of hazard.
struct HazardKind {
  std::string_view word;           ///< "lying_person"
  Hazard (*make)(world::Random&);  ///< Makes one, of random size within the kind.
};

/// Returns all kinds.
[[nodiscard]] std::span<const HazardKind> hazard_kinds() noexcept;

}  // namespace terracut::hazards
