// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "pipeline/baselines/column_angles.hpp"
#include "pipeline/baselines/fixed_grid_elevation_map.hpp"
#include "pipeline/baselines/height_field_mrf.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "rt/error.hpp"

namespace terracut::ground {

/// The class that does the work.
enum class MethodKind : std::uint8_t { kSegmenter, kPfaff, kBogoslavskyi, kZhang };

/// A method with the parameters of all methods. The default is the `terracut` profile.
struct MethodConfig {
  MethodKind kind = MethodKind::kSegmenter;
  SegmenterConfig segmenter;
  baselines::FixedGridElevationMap::Config pfaff;
  baselines::ColumnAngles::Config bogoslavskyi;
  baselines::HeightFieldMrf::Config zhang;

  MethodConfig() = default;
  /// The terracut method with these parameters; other methods keep their defaults.
  MethodConfig(const SegmenterConfig& config) : segmenter(config) {}  // NOLINT: meant to convert
};

/// Applies remembering() to the SegmenterConfig.
[[nodiscard]] inline MethodConfig remembering(MethodConfig config, bool motion_is_known) noexcept {
  config.segmenter = remembering(config.segmenter, motion_is_known);
  return config;
}

/// A method that can be chosen by name.
struct MethodName {
  std::string_view name;   ///< "bogoslavskyi", as in --method and reports.
  std::string_view about;  ///< "Column angles in the range image (Bogoslavskyi, Stachniss 2017)"
};

/// Returns all methods in the order of the paper's tables: the baselines, the rows of Table III,
/// ours.
[[nodiscard]] std::span<const MethodName> method_names() noexcept;

/// Returns the method of that name with its default parameters. kInvalidArgument, naming the
/// methods there are, for any other name.
[[nodiscard]] Expected<MethodConfig> method_named(std::string_view name);

/// True if the method uses points of an image, which must then have them.
[[nodiscard]] bool needs_all_points(const MethodConfig& config) noexcept;

/// A Segmenter or a baseline, chosen at run time. Has Segmenter's interface and contracts, and
/// costs one switch a frame.
class GroundMethod {
 public:
  /// `reader`: see Segmenter; null if needs_all_points().
  GroundMethod(const MethodConfig& config, const mount::RingProfile& profile,
               frame::ImageShape shape, std::size_t return_capacity, memory::FixedMemory& memory,
               std::unique_ptr<frame::TileReader> reader = nullptr) {
    switch (config.kind) {
      case MethodKind::kSegmenter:
        segmenter_.emplace(config.segmenter, profile, shape, return_capacity, memory,
                           std::move(reader));
        return;
      case MethodKind::kPfaff:
        baseline_ = std::make_unique<baselines::FixedGridElevationMap>(config.pfaff, profile, shape,
                                                                       return_capacity, memory);
        return;
      case MethodKind::kBogoslavskyi:
        baseline_ = std::make_unique<baselines::ColumnAngles>(config.bogoslavskyi, profile, shape,
                                                              return_capacity, memory);
        return;
      case MethodKind::kZhang:
        baseline_ = std::make_unique<baselines::HeightFieldMrf>(config.zhang, profile, shape,
                                                                return_capacity, memory);
        return;
    }
  }

  /// Calls Segmenter::advance(); baselines do nothing ahead.
  void advance(const frame::RangeImage& image, int complete_columns,
               stage::StageObserver* observer = nullptr) noexcept {
    if (segmenter_) segmenter_->advance(image, complete_columns, observer);
  }

  /// Baselines report the stage most like theirs (see their headers) and ignore the budget.
  [[nodiscard]] stage::SegmentationReport segment(
      const frame::RangeImage& image, stage::StageObserver* observer = nullptr,
      const min_cut::CutBudget& budget = {}) noexcept {
    if (segmenter_) return segmenter_->segment(image, budget, observer);
    if (observer != nullptr) observer->resumed();
    return baseline_->segment(image, observer);
  }

  /// Calls Segmenter::set_place(); baselines remember nothing.
  void set_place(const frame::Place& place) noexcept {
    if (segmenter_) segmenter_->set_place(place);
  }

  /// Takes near ground from the frame labelled last.
  void take_near_ground(const frame::RangeImage& image, NearGround& ground) noexcept {
    if (segmenter_) return segmenter_->take_near_ground(image, ground);
    ground::take_near_ground(image, ground);
  }

  [[nodiscard]] std::span<const frame::Label> labels() const noexcept {
    return segmenter_ ? segmenter_->labels() : baseline_->labels();
  }
  [[nodiscard]] const stage::CellPlanes& planes() const noexcept {
    return segmenter_ ? segmenter_->planes() : baseline_->planes();
  }

 private:
  std::optional<Segmenter> segmenter_;
  std::unique_ptr<baselines::Baseline> baseline_;  // set if there is no segmenter
};

}  // namespace terracut::ground
