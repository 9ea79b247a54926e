// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>

#include "tools/lab/quality/quality.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/statistics/frame_counts.hpp"

namespace terracut::statistics {

/// Which points a measure is about.
struct Scope {
  datasets::GroundDefinition ground = datasets::GroundDefinition::kAll;
  bool vegetation = true;             ///< False: points of vegetation count nowhere.
  std::optional<std::size_t> band{};  ///< Only this range band.
};

/// The counts as the class table sees them. Classes it does not know count nowhere. Under kRoad
/// ground that was told to be no road surface counts as called obstacle.
[[nodiscard]] quality::Quality quality_of(const statistics::FrameCounts& counts,
                                          const datasets::ClassTable& classes, const Scope& scope);

/// What the same points would score if every one were called ground.
[[nodiscard]] quality::Quality everything_ground(const statistics::FrameCounts& counts,
                                                 const datasets::ClassTable& classes,
                                                 const Scope& scope);
/// What a detector would score that finds all physical ground (GroundDefinition::kAll) and nothing
/// else: under kRoad, the ceiling of everything that does not see kerbs. Points ignored under kAll
/// are taken as found correctly.
[[nodiscard]] quality::Quality perfect_ground(const statistics::FrameCounts& counts,
                                              const datasets::ClassTable& classes,
                                              const Scope& scope);

/// Harmonic mean of precision and recall; 0 when both are.
[[nodiscard]] double f1_ground(const quality::Quality& quality) noexcept;

}  // namespace terracut::statistics
