// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "column_angles.hpp"
#include "fixed_grid_elevation_map.hpp"
#include "height_field_mrf.hpp"
#include "pipeline/ground/frame_method.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/ground/turn_method.hpp"
#include "rt/error.hpp"

namespace terracut::baselines {

/// The class that runs a method: our segmenter or one of the baselines.
enum class MethodKind : std::uint8_t { kSegmenter, kPfaff, kBogoslavskyi, kZhang };

/// A method with the parameters of all methods. The default is the `terracut` profile.
struct MethodConfig {
  MethodKind kind = MethodKind::kSegmenter;
  ground::SegmenterConfig segmenter = {};
  FixedGridElevationMap::Config pfaff = {};
  ColumnAngles::Config bogoslavskyi = {};
  HeightFieldMrf::Config zhang = {};
};

/// A method that can be chosen by name.
struct MethodName {
  std::string_view name;   ///< "bogoslavskyi", as in --method and reports.
  std::string_view about;  ///< "Column angles in the range image (Bogoslavskyi, Stachniss 2017)"
};

/// Returns all methods in the order of the paper's tables: the baselines, the rows of Table III,
/// then our profiles.
[[nodiscard]] std::span<const MethodName> method_names() noexcept;

/// Returns the method of that name with default parameters. For any other name fails with
/// kInvalidArgument; the message lists all.
[[nodiscard]] Expected<MethodConfig> method_named(std::string_view name);

/// Returns the function that makes the chosen method.
[[nodiscard]] ground::MethodMaker maker_of(const MethodConfig& config);
/// Returns the function that makes it for the turns of a sensor.
[[nodiscard]] ground::TurnMethodMaker turn_maker_of(const MethodConfig& config);

}  // namespace terracut::baselines
