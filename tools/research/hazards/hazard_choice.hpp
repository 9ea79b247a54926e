// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rt/error.hpp"

namespace terracut::hazards {

struct Disturbance;
struct HazardKind;

/// What to put into frames, and how often.
struct HazardChoice {
  std::vector<const HazardKind*> kinds;          ///< Of hazard_kinds().
  std::vector<const Disturbance*> disturbances;  ///< Of disturbances().
  int trials = 1;  ///< For each kind of hazard, ground and range bin of a frame.
  std::uint64_t seed = 1;
};

/// Sets kinds and disturbances by their words; all if there is no word. kInvalidArgument, naming
/// the existing ones, for an unknown word.
[[nodiscard]] Status choose(std::span<const std::string> words, HazardChoice& choice);

}  // namespace terracut::hazards
