// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "height_field_mrf.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "firmware_io/frame/each_return.hpp"

namespace terracut::baselines {
HeightFieldMrf::HeightFieldMrf(const Config& config, const mount::RingProfile& profile,
                               frame::ImageShape shape, std::size_t return_capacity,
                               memory::FixedMemory& memory)
    : Baseline(stage::Stage::kMinCut, config.obstacle_height_m, shape, return_capacity, memory),
      config_(config),
      shape_(shape),
      sensor_height_m_(static_cast<float>(profile.mount.height_m)),
      bands_(static_cast<int>(std::ceil(config.range_limit_m / config.band_m))),
      field_({bands_, config.sectors, config.height_labels, true}, memory),
      returns_at_(memory.take<std::uint16_t>(
          "height field", map_cell(bands_, 0) * static_cast<std::size_t>(config.height_labels))),
      least_slope_(memory.take<float>("height field", map_cell(bands_, 0))),
      sector_of_column_(
          memory.take<std::uint16_t>("height field", static_cast<std::size_t>(shape.stride()))) {
  for (int column = 0; column < shape.columns; ++column) {
    sector_of_column_[static_cast<std::size_t>(column)] =
        static_cast<std::uint16_t>(column * config.sectors / shape.columns);
  }
  put_slopes();
}

int HeightFieldMrf::band_of(float ground_range_m) const noexcept {
  const float bands = ground_range_m / config_.band_m;
  const auto last = static_cast<float>(bands_ - 1);
  return bands > 0 ? static_cast<int>(std::min(bands, last)) : 0;  // NaN gives 0 as well
}

int HeightFieldMrf::label_of(float height_m) const noexcept {
  const float steps =
      height_m / config_.height_step_m + static_cast<float>(config_.height_labels / 2) + 0.5F;
  const auto last = static_cast<float>(config_.height_labels - 1);
  return steps > 0 ? static_cast<int>(std::min(steps, last)) : 0;  // NaN gives 0 as well
}

float HeightFieldMrf::height_of(int label) const noexcept {
  return static_cast<float>(label - config_.height_labels / 2) * config_.height_step_m;
}

void HeightFieldMrf::label_cells(const frame::RangeImage& image,
                                 stage::StageObserver* observer) noexcept {
  count_returns(image);
  put_costs();
  if (observer != nullptr) observer->stage_done(stage::Stage::kElevationMap);
  field_.run(config_.iterations);
  if (observer != nullptr) observer->stage_done(stage::Stage::kMinCut);
  put_labels(image);
}

void HeightFieldMrf::count_returns(const frame::RangeImage& image) noexcept {
  std::fill(returns_at_.begin(), returns_at_.end(), std::uint16_t{0});
  std::fill(least_slope_.begin(), least_slope_.end(), std::numeric_limits<float>::infinity());
  const auto labels = static_cast<std::size_t>(config_.height_labels);
  frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
    const frame::Return& point = placed.point;
    const std::size_t cell = map_cell(band_of(point.ground_range_m), sector_of(placed.column));
    std::uint16_t& count =
        returns_at_[cell * labels + static_cast<std::size_t>(label_of(point.z_m))];
    if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
    const float slope = (point.z_m - sensor_height_m_) / point.ground_range_m;
    if (slope < least_slope_[cell]) least_slope_[cell] = slope;
  });
}

/// Goes through each sector from outside inwards. No ground lies above the lowest beam that passed,
/// so such heights cost more.
void HeightFieldMrf::put_costs() noexcept {
  for (int sector = 0; sector < config_.sectors; ++sector) {
    float least_slope = std::numeric_limits<float>::infinity();
    for (int band = bands_ - 1; band >= 0; --band) {
      const float middle_m = (static_cast<float>(band) + 0.5F) * config_.band_m;
      put_cost(band, sector, sensor_height_m_ + least_slope * middle_m);
      least_slope = std::min(least_slope, least_slope_[map_cell(band, sector)]);
    }
  }
  // Under the vehicle the ground is at height 0.
  const int level = label_of(0);
  for (int sector = 0; sector < config_.sectors; ++sector) {
    const auto cost = field_.data_cost(0, sector);
    for (int label = 0; label < config_.height_labels; ++label) {
      cost[static_cast<std::size_t>(label)] +=
          config_.below_cost * static_cast<float>(std::abs(label - level));
    }
  }
}

/// Sets the costs of a cell's heights. A height is supported by returns at that height and, nearly
/// as well, by returns one step above or below. Returns above it would be obstacles; returns below
/// it are hardly possible.
void HeightFieldMrf::put_cost(int band, int sector, float free_above_m) noexcept {
  const auto labels = static_cast<std::size_t>(config_.height_labels);
  const auto cost = field_.data_cost(band, sector);
  const auto at = returns_at_.subspan(map_cell(band, sector) * labels, labels);
  int all = 0;
  for (const std::uint16_t count : at) all += count;
  const float say =
      all == 0 ? 0.0F : 1.0F / static_cast<float>(std::max(all, config_.full_returns));
  int below = 0;  // returns more than one label below this one
  int near = at[0];
  for (std::size_t l = 0; l < labels; ++l) {
    near += l + 1 < labels ? at[l + 1] : 0;
    if (l >= 2) {
      near -= at[l - 2];
      below += at[l - 2];
    }
    const int above = all - below - near;
    cost[l] = say * (config_.below_cost * static_cast<float>(below) +
                     config_.above_cost * static_cast<float>(above) +
                     config_.beside_cost * static_cast<float>(near - at[l]));
    const bool passed_through =
        height_of(static_cast<int>(l)) > free_above_m + config_.height_step_m;
    if (passed_through) cost[l] += config_.hidden_cost;
  }
}

void HeightFieldMrf::put_slopes() noexcept {
  const auto cost_of = [this](float distance_m) noexcept {
    BeliefPropagation::StepCost cost;
    cost.per_label = config_.step_cost_per_m * config_.height_step_m;
    cost.limit = config_.step_cost_limit;
    const float free = config_.max_slope * distance_m / config_.height_step_m;
    cost.free_labels = static_cast<int>(std::min(free, static_cast<float>(config_.height_labels)));
    return cost;
  };
  for (int band = 0; band < bands_; ++band) {
    const float arc_m = (static_cast<float>(band) + 0.5F) * config_.band_m * 2.0F *
                        std::numbers::pi_v<float> / static_cast<float>(config_.sectors);
    field_.set_step_within_row(band, cost_of(arc_m));
    if (band + 1 < bands_) field_.set_step_between_rows(band, cost_of(config_.band_m));
  }
}

void HeightFieldMrf::put_labels(const frame::RangeImage& image) noexcept {
  for (int row = 0; row < shape_.rows; ++row) {
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(shape_.stride());
    for (int column = 0; column < shape_.stride(); ++column) {
      const std::size_t cell = first + static_cast<std::size_t>(column);
      if (!image.has_return(cell)) {
        planes_.height_m[cell] = std::numeric_limits<float>::quiet_NaN();
        planes_.label[cell] = frame::Label::kNone;
        continue;
      }
      const float height_m = image.z_m()[cell] - ground_m(column, image.ground_range_m()[cell]);
      planes_.height_m[cell] = height_m;
      planes_.label[cell] =
          height_m < config_.obstacle_height_m ? frame::Label::kGround : frame::Label::kObstacle;
    }
  }
}

}  // namespace terracut::baselines
