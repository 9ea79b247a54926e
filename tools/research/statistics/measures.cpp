// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "measures.hpp"

namespace terracut::statistics {
namespace {

/// Returns the quality of the counts with other labels: `labels_of(entry, counts)` returns the
/// labels to use.
template <class LabelsOf>
quality::Quality score(const FrameCounts& counts, const datasets::ClassTable& classes,
                       const Scope& scope, LabelsOf&& labels_of) {
  quality::Quality quality;
  for (const auto& [key, counted] : counts.by_class_and_band()) {
    const datasets::ClassEntry* const entry = classes.find(key.class_id);
    if (entry == nullptr || (entry->vegetation && !scope.vegetation)) continue;
    if (scope.band && *scope.band != key.band) continue;
    const LabelCounts labels = labels_of(*entry, counted);
    quality.add(entry->role(scope.ground), labels.ground, labels.obstacle);
  }
  return quality;
}

}  // namespace

quality::Quality quality_of(const FrameCounts& counts, const datasets::ClassTable& classes,
                            const Scope& scope) {
  return score(counts, classes, scope, [&](const datasets::ClassEntry&, LabelCounts counted) {
    if (scope.ground == datasets::GroundDefinition::kRoad) {
      counted.ground -= counted.other_ground;
      counted.obstacle += counted.other_ground;
    }
    return counted;
  });
}

quality::Quality everything_ground(const FrameCounts& counts, const datasets::ClassTable& classes,
                                   const Scope& scope) {
  return score(counts, classes, scope, [](const datasets::ClassEntry&, const LabelCounts& counted) {
    return LabelCounts{counted.ground + counted.obstacle, 0};
  });
}

quality::Quality perfect_ground(const FrameCounts& counts, const datasets::ClassTable& classes,
                                const Scope& scope) {
  return score(
      counts, classes, scope, [&](const datasets::ClassEntry& entry, const LabelCounts& counted) {
        datasets::Role truth = entry.role(datasets::GroundDefinition::kAll);
        if (truth == datasets::Role::kIgnored) truth = entry.role(scope.ground);
        const std::uint64_t points = counted.ground + counted.obstacle;
        return truth == datasets::Role::kGround ? LabelCounts{points, 0} : LabelCounts{0, points};
      });
}

double f1_ground(const quality::Quality& quality) noexcept {
  const double precision = quality.precision_ground(), recall = quality.recall_ground();
  return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0;
}

}  // namespace terracut::statistics
