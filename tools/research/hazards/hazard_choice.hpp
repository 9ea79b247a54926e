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

/// The hazards and disturbances to put into frames.
struct HazardChoice {
  std::vector<const HazardKind*> kinds;          ///< Elements of hazard_kinds().
  std::vector<const Disturbance*> disturbances;  ///< Elements of disturbances().
  int trials = 1;  ///< Trials of each kind of hazard, ground and range bin in a frame.
  std::uint64_t seed = 1;
};

/// Sets kinds and disturbances by their words; without words, sets all. Fails with kInvalidArgument
/// for an unknown word; the message lists the known ones.
[[nodiscard]] Status choose(std::span<const std::string> words, HazardChoice& choice);

}  // namespace terracut::hazards
