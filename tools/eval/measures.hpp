// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>

#include "class_table.hpp"
#include "frame_counts.hpp"
#include "pipeline/quality.hpp"

namespace terracut::evaluation {

/// Which points a measure is about.
struct Scope {
  GroundDefinition ground = GroundDefinition::kAll;
  bool vegetation = true;             ///< False: points of vegetation count nowhere.
  std::optional<std::size_t> band{};  ///< Only this range band.
};

/// The counts as the class table sees them. Classes it does not know count nowhere. Under kRoad
/// ground that was told to be no road surface counts as called obstacle.
[[nodiscard]] pipeline::Quality quality_of(const FrameCounts& counts, const ClassTable& classes,
                                           const Scope& scope);

/// What the same points would score if every one were called ground.
[[nodiscard]] pipeline::Quality everything_ground(const FrameCounts& counts,
                                                  const ClassTable& classes, const Scope& scope);
/// What a detector would score that finds all physical ground (GroundDefinition::kAll) and nothing
/// else: under kRoad, the ceiling of everything that does not see kerbs. Points ignored under kAll
/// are taken as found correctly.
[[nodiscard]] pipeline::Quality perfect_ground(const FrameCounts& counts, const ClassTable& classes,
                                               const Scope& scope);

/// Harmonic mean of precision and recall; 0 when both are.
[[nodiscard]] double f1_ground(const pipeline::Quality& quality) noexcept;

}  // namespace terracut::evaluation
