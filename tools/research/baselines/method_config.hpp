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
#include "rt/error.hpp"

namespace terracut::baselines {

/// Which class does the work.
enum class MethodKind : std::uint8_t { kSegmenter, kPfaff, kBogoslavskyi, kZhang };

/// A method and every parameter of it and of the others. The default is the `terracut` profile.
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

/// All there are, in the order of the paper's tables: the baselines, the rows of Table III, ours.
[[nodiscard]] std::span<const MethodName> method_names() noexcept;

/// The method of that name with its default parameters. kInvalidArgument, naming those there are,
/// for any other name.
[[nodiscard]] Expected<MethodConfig> method_named(std::string_view name);

/// Whether the method looks at points of an image, which must have them.
[[nodiscard]] bool needs_all_points(const MethodConfig& config) noexcept;

/// Makes the method chosen.
[[nodiscard]] ground::MethodMaker maker_of(const MethodConfig& config);

}  // namespace terracut::baselines
