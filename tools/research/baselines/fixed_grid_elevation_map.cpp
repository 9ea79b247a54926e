// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "fixed_grid_elevation_map.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_io/frame/each_return.hpp"

namespace terracut::baselines {
FixedGridElevationMap::FixedGridElevationMap(const Config& config, const mount::RingProfile&,
                                             frame::ImageShape shape, std::size_t return_capacity,
                                             memory::FixedMemory& memory)
    : Baseline(stage::Stage::kElevationMap, config.obstacle_height_m, shape, return_capacity,
               memory),
      config_(config),
      side_(static_cast<int>(std::ceil(2.0F * config.extent_m / config.cell_m))),
      end_(memory.take<std::uint32_t>(
          "fixed grid", static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_))),
      samples_(memory.take<Sample>("fixed grid", return_capacity)),
      squares_(memory.take<Square>("fixed grid", end_.size())) {}

std::uint32_t FixedGridElevationMap::square_of(float x_m, float y_m) const noexcept {
  const float squares_per_metre = 1.0F / config_.cell_m;
  const auto last = static_cast<float>(side_ - 1);
  const auto step = [&](float along_m) noexcept {
    const float steps = (along_m + config_.extent_m) * squares_per_metre;
    return steps > 0 ? static_cast<std::uint32_t>(std::min(steps, last)) : 0U;  // NaN too
  };
  return step(y_m) * static_cast<std::uint32_t>(side_) + step(x_m);
}

void FixedGridElevationMap::label_cells(const frame::RangeImage& image,
                                        stage::StageObserver* observer) noexcept {
  sort_returns_into_squares(image);
  std::uint32_t begin = 0;
  for (std::size_t square = 0; square < squares_.size(); ++square) {
    squares_[square] = fit(samples_.subspan(begin, end_[square] - begin));
    begin = end_[square];
  }
  put_labels(image);
  if (observer != nullptr) observer->stage_done(stage::Stage::kElevationMap);
}

/// Sorts by counting: counts the returns of each square, computes where each square ends, then puts
/// every return in place.
void FixedGridElevationMap::sort_returns_into_squares(const frame::RangeImage& image) noexcept {
  std::fill(end_.begin(), end_.end(), 0U);
  frame::for_each_return(image, [this](const frame::PlacedReturn& placed) {
    ++end_[square_of(placed.point.x_m, placed.point.y_m)];
  });
  std::uint32_t sum = 0;
  for (std::uint32_t& end : end_) {
    const std::uint32_t count = end;
    end = sum;  // where the square begins; moves to its end as the square is filled
    sum += count;
  }
  frame::for_each_return(image, [this](const frame::PlacedReturn& placed) {
    const frame::Return& point = placed.point;
    const float sigma_m = config_.sigma_m + config_.sigma_per_metre * point.ground_range_m;
    samples_[end_[square_of(point.x_m, point.y_m)]++] = {point.z_m, 1.0F / (sigma_m * sigma_m)};
  });
}

bool FixedGridElevationMap::is_level(std::span<const Sample> samples) const noexcept {
  float sum_m = 0;
  for (const Sample& sample : samples) sum_m += sample.height_m;
  const auto count = static_cast<float>(samples.size());
  const float mean_m = sum_m / count;
  float sum_of_squares = 0;
  for (const Sample& sample : samples) {
    sum_of_squares += (sample.height_m - mean_m) * (sample.height_m - mean_m);
  }
  return sum_of_squares <= config_.vertical_sigma_m * config_.vertical_sigma_m * count;
}

FixedGridElevationMap::Square FixedGridElevationMap::fit(std::span<Sample> samples) const noexcept {
  Square square;
  if (samples.empty()) return square;
  bool level = is_level(samples);
  if (!level) {
    const auto lower = [](const Sample& a, const Sample& b) { return a.height_m < b.height_m; };
    std::sort(samples.begin(), samples.end(), lower);
    for (std::size_t i = 1; i < samples.size(); ++i) {
      if (samples[i].height_m - samples[i - 1].height_m <= config_.vehicle_height_m) continue;
      square.overhang_m = samples[i].height_m;
      samples = samples.first(i);
      level = is_level(samples);
      break;
    }
  }
  square.kind = level ? SquareKind::kLevel : SquareKind::kVertical;
  square.elevation_m = samples.front().height_m;
  if (!level) return square;
  // This mean equals the result of a Kalman filter updated by returns of these variances. It is
  // computed relative to the first height, so that few bits are lost.
  float weights = 0, weighted_m = 0;
  for (const Sample& sample : samples) {
    weights += sample.weight;
    weighted_m += sample.weight * (sample.height_m - square.elevation_m);
  }
  square.elevation_m += weighted_m / weights;
  return square;
}

void FixedGridElevationMap::put_labels(const frame::RangeImage& image) noexcept {
  for (std::size_t cell = 0; cell < planes_.label.size(); ++cell) {
    if (!image.has_return(cell)) {
      planes_.height_m[cell] = std::numeric_limits<float>::quiet_NaN();
      planes_.label[cell] = frame::Label::kNone;
      continue;
    }
    const float z_m = image.z_m()[cell];
    const Square& square = square_at(image.x_m()[cell], image.y_m()[cell]);
    const float height_m = z_m - square.elevation_m;
    const bool ground = height_m < config_.obstacle_height_m && z_m < square.overhang_m;
    planes_.height_m[cell] = height_m;
    planes_.label[cell] = ground ? frame::Label::kGround : frame::Label::kObstacle;
  }
}

}  // namespace terracut::baselines
