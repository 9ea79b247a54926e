// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "tools/research/datasets/class_table.hpp"

namespace terracut::hazards {

/// The kinds of ground that a hazard stands on.
enum class GroundKind : std::uint8_t { kRoad, kSidewalk, kGrass };
inline constexpr std::array kGroundKinds{GroundKind::kRoad, GroundKind::kSidewalk,
                                         GroundKind::kGrass};

/// Returns "road", "sidewalk" or "grass".
[[nodiscard]] std::string_view to_string(GroundKind kind) noexcept;

/// Returns the kind of a class that is ground (GroundDefinition::kAll), by its name: grass if that
/// contains "grass" or "terrain", sidewalk if it contains "sidewalk" or "other", else road. Returns
/// none for any other class.
[[nodiscard]] std::optional<GroundKind> ground_kind(const datasets::ClassEntry& entry) noexcept;

}  // namespace terracut::hazards
