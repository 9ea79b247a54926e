// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "measures.hpp"

namespace terracut::evaluation {
namespace {

void add(pipeline::Quality& quality, Role role, std::uint64_t as_ground,
         std::uint64_t as_obstacle) {
  switch (role) {
    case Role::kIgnored:
      return;
    case Role::kGround:
      quality.ground_as_ground += as_ground;
      quality.ground_as_obstacle += as_obstacle;
      return;
    case Role::kKeyObstacle:
      quality.key_as_ground += as_ground;
      quality.key_as_obstacle += as_obstacle;
      break;
    case Role::kOrdinaryObstacle:
      break;
  }
  quality.obstacle_as_ground += as_ground;
  quality.obstacle_as_obstacle += as_obstacle;
}

/// `labels_of(entry, counts)`: the labels to score instead of those counted.
template <class LabelsOf>
pipeline::Quality score(const FrameCounts& counts, const ClassTable& classes, const Scope& scope,
                        LabelsOf&& labels_of) {
  pipeline::Quality quality;
  for (const auto& [key, counted] : counts.by_class_and_band()) {
    const ClassEntry* const entry = classes.find(key.class_id);
    if (entry == nullptr || (entry->vegetation && !scope.vegetation)) continue;
    if (scope.band && *scope.band != key.band) continue;
    const LabelCounts labels = labels_of(*entry, counted);
    add(quality, entry->role(scope.ground), labels.ground, labels.obstacle);
  }
  return quality;
}

}  // namespace

pipeline::Quality quality_of(const FrameCounts& counts, const ClassTable& classes,
                             const Scope& scope) {
  return score(counts, classes, scope, [&](const ClassEntry&, LabelCounts counted) {
    if (scope.ground == GroundDefinition::kRoad) {
      counted.ground -= counted.other_ground;
      counted.obstacle += counted.other_ground;
    }
    return counted;
  });
}

pipeline::Quality everything_ground(const FrameCounts& counts, const ClassTable& classes,
                                    const Scope& scope) {
  return score(counts, classes, scope, [](const ClassEntry&, const LabelCounts& counted) {
    return LabelCounts{counted.ground + counted.obstacle, 0};
  });
}

pipeline::Quality perfect_ground(const FrameCounts& counts, const ClassTable& classes,
                                 const Scope& scope) {
  return score(counts, classes, scope, [&](const ClassEntry& entry, const LabelCounts& counted) {
    Role truth = entry.role(GroundDefinition::kAll);
    if (truth == Role::kIgnored) truth = entry.role(scope.ground);
    const std::uint64_t points = counted.ground + counted.obstacle;
    return truth == Role::kGround ? LabelCounts{points, 0} : LabelCounts{0, points};
  });
}

double f1_ground(const pipeline::Quality& quality) noexcept {
  const double precision = quality.precision_ground(), recall = quality.recall_ground();
  return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0;
}

}  // namespace terracut::evaluation
