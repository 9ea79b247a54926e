// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "ground_kind.hpp"

namespace terracut::hazards {

std::string_view to_string(GroundKind kind) noexcept {
  constexpr std::array<std::string_view, kGroundKinds.size()> kNames{"road", "sidewalk", "grass"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::optional<GroundKind> ground_kind(const datasets::ClassEntry& entry) noexcept {
  if (entry.role(datasets::GroundDefinition::kAll) != datasets::Role::kGround) return std::nullopt;
  const auto has = [&](std::string_view word) {
    return entry.name.find(word) != std::string::npos;
  };
  if (has("grass") || has("terrain")) return GroundKind::kGrass;
  if (has("sidewalk") || has("other")) return GroundKind::kSidewalk;
  return GroundKind::kRoad;
}

}  // namespace terracut::hazards
