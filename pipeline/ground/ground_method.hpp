// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "pipeline/baselines/column_angles.hpp"
#include "pipeline/baselines/fixed_grid_elevation_map.hpp"
#include "pipeline/baselines/height_field_mrf.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "rt/error.hpp"

namespace terracut::ground {

/// Which class does the work.
enum class MethodKind : std::uint8_t { kSegmenter, kPfaff, kBogoslavskyi, kZhang };

/// A method and every parameter of it and of the others. The default is the `terracut` profile.
struct MethodConfig {
  MethodKind kind = MethodKind::kSegmenter;
  SegmenterConfig segmenter;
  baselines::FixedGridElevationMap::Config pfaff;
  baselines::ColumnAngles::Config bogoslavskyi;
  baselines::HeightFieldMrf::Config zhang;

  MethodConfig() = default;
  /// The terracut method with these parameters; the other methods keep their defaults.
  MethodConfig(const SegmenterConfig& config) : segmenter(config) {}  // NOLINT: meant to convert
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

/// Segmenter or a baseline, chosen at run time. Has Segmenter's interface and contracts, and costs
/// one switch a frame.
class GroundMethod {
 private:
  /// std::visit without its exception: after the constructor there is always a method.
  template <class Self, class Function>
  static decltype(auto) visit_baseline(Self& self, Function&& function) noexcept {
    if (auto* pfaff = std::get_if<baselines::FixedGridElevationMap>(&self.method_))
      return function(*pfaff);
    if (auto* angles = std::get_if<baselines::ColumnAngles>(&self.method_))
      return function(*angles);
    return function(*std::get_if<baselines::HeightFieldMrf>(&self.method_));
  }

 public:
  GroundMethod(const MethodConfig& config, const mount::RingProfile& profile,
               frame::ImageShape shape, std::size_t return_capacity, memory::FixedMemory& memory) {
    switch (config.kind) {
      case MethodKind::kSegmenter:
        method_.emplace<Segmenter>(config.segmenter, profile, shape, return_capacity, memory);
        return;
      case MethodKind::kPfaff:
        method_.emplace<baselines::FixedGridElevationMap>(config.pfaff, profile, shape,
                                                          return_capacity, memory);
        return;
      case MethodKind::kBogoslavskyi:
        method_.emplace<baselines::ColumnAngles>(config.bogoslavskyi, profile, shape,
                                                 return_capacity, memory);
        return;
      case MethodKind::kZhang:
        method_.emplace<baselines::HeightFieldMrf>(config.zhang, profile, shape, return_capacity,
                                                   memory);
        return;
    }
  }

  /// As Segmenter::advance(); baselines do nothing ahead.
  void advance(const frame::RangeImage& image, int complete_columns,
               stage::StageObserver* observer = nullptr) noexcept {
    if (auto* segmenter = std::get_if<Segmenter>(&method_)) {
      segmenter->advance(image, complete_columns, observer);
    }
  }

  /// Baselines report the stage that is most like theirs (their headers say which).
  [[nodiscard]] stage::SegmentationReport segment(
      const frame::RangeImage& image, stage::StageObserver* observer = nullptr) noexcept {
    if (auto* segmenter = std::get_if<Segmenter>(&method_)) {
      return segmenter->segment(image, {}, observer);
    }
    if (observer != nullptr) observer->resumed();
    return visit_baseline(*this, [&](auto& baseline) { return baseline.segment(image, observer); });
  }

  [[nodiscard]] std::span<const frame::Label> labels() const noexcept {
    if (const auto* segmenter = std::get_if<Segmenter>(&method_)) return segmenter->labels();
    return visit_baseline(*this, [](const auto& baseline) { return baseline.labels(); });
  }
  [[nodiscard]] const stage::CellPlanes& planes() const noexcept {
    if (const auto* segmenter = std::get_if<Segmenter>(&method_)) return segmenter->planes();
    return visit_baseline(
        *this, [](const auto& baseline) -> const stage::CellPlanes& { return baseline.planes(); });
  }

 private:
  std::variant<std::monostate, Segmenter, baselines::FixedGridElevationMap, baselines::ColumnAngles,
               baselines::HeightFieldMrf>
      method_;
};

}  // namespace terracut::ground
