// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>

#include "tools/lab/quality/quality.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/statistics/frame_counts.hpp"

namespace terracut::statistics {

/// The points that a measure covers.
struct Scope {
  datasets::GroundDefinition ground = datasets::GroundDefinition::kAll;
  bool vegetation = true;             ///< False: vegetation is ignored.
  std::optional<std::size_t> band{};  ///< Only this range band.
};

/// Returns the counts by the class table's roles. Unknown classes are ignored. Under kRoad, a label
/// for ground that is not road surface counts as a label for an obstacle.
[[nodiscard]] quality::Quality quality_of(const FrameCounts& counts,
                                          const datasets::ClassTable& classes, const Scope& scope);

/// Returns the score of the same points if all of them were called ground.
[[nodiscard]] quality::Quality everything_ground(const FrameCounts& counts,
                                                 const datasets::ClassTable& classes,
                                                 const Scope& scope);
/// Returns the score of a detector that finds all physical ground (GroundDefinition::kAll) and
/// nothing else. Under kRoad this is the most that a method can reach without seeing kerbs. Points
/// ignored under kAll count as found correctly.
[[nodiscard]] quality::Quality perfect_ground(const FrameCounts& counts,
                                              const datasets::ClassTable& classes,
                                              const Scope& scope);

/// Returns the harmonic mean of precision and recall; 0 if both are 0.
[[nodiscard]] double f1_ground(const quality::Quality& quality) noexcept;

}  // namespace terracut::statistics
