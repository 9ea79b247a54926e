// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "foot_cut.hpp"

#include <algorithm>
#include <array>

namespace terracut::objects {
namespace {

using frame::Label;
using min_cut::Seed;

// Parts are the cut's two sides, decided or not.
static_assert(static_cast<int>(Part::kBody) == static_cast<int>(Seed::kObstacle));
static_assert(static_cast<int>(Part::kFoot) == static_cast<int>(Seed::kGround));
constexpr std::uint8_t kEitherPart =
    static_cast<std::uint8_t>(Part::kBody) | static_cast<std::uint8_t>(Part::kFoot);

}  // namespace

FootCut::FootCut(const Config& config, frame::ImageShape shape, memory::FixedMemory& memory)
    : config_(config),
      shape_(shape),
      cut_(shape, {}, memory),
      seeds_(memory.take<Seed>("objects", shape.cells())),
      sides_(memory.take<Label>("objects", shape.cells())),
      parts_(memory.take<Part>("objects", shape.cells())) {}

void FootCut::plant(const stage::CellPlanes& planes) noexcept {
  const float low_m = config_.low_m;
  for (int row = 0; row < shape_.rows; ++row) {
    const std::size_t begin = shape_.cell(row, 0);
    const std::size_t end = begin + static_cast<std::size_t>(shape_.columns);
    for (std::size_t cell = begin; cell < end; ++cell) {
      const Label label = planes.label[cell];
      const Seed obstacle = planes.height_m[cell] < low_m ? Seed::kUnknown : Seed::kObstacle;
      seeds_[cell] = label == Label::kObstacle ? obstacle : Seed::kNone;
      // Low cells beyond the cut's capacity stay with their bodies.
      sides_[cell] = label;
    }
  }
}

std::span<const Part> FootCut::divide(const frame::RangeImage& image,
                                      const stage::CellPlanes& planes,
                                      const Reach& reach) noexcept {
  plant(planes);
  const frame::PointPlanes points = image.points();
  const auto scaled = [](float cost) {
    return static_cast<std::int32_t>(cost * static_cast<float>(min_cut::kCapacityScale));
  };
  const auto costs = [&](std::uint32_t cell) noexcept {
    const float share = std::clamp(planes.height_m[cell] / config_.low_m, 0.0F, 1.0F);
    return min_cut::LabelCosts{.ground = 0, .obstacle = scaled(config_.body_cost * (1 - share))};
  };
  const auto weights = [&](std::uint32_t cell, const min_cut::NeighbourCells& neighbours,
                           std::span<std::uint16_t, min_cut::kDirections> out) noexcept {
    const int row = static_cast<int>(cell) / shape_.stride();
    const float range_m = points.ground_range_m[cell];
    for (std::size_t d = 0; d < neighbours.size(); ++d) {
      const std::uint32_t other = neighbours[d];
      if (seeds_[other] == Seed::kNone) continue;  // the cut does not look at this weight
      const int rows = min_cut::kCellSteps[d].rows;
      // Both cells of a pair take the same range, so that both find the same weight.
      const float nearer_m = std::min(range_m, points.ground_range_m[other]);
      const float reach_m2 =
          rows == 0 ? reach.along_row_squared_m2(nearer_m)
                    : reach.to_next_row_squared_m2(std::max(row + std::min(rows, 0), 0), nearer_m);
      const float share = distance_squared_m2(points, cell, other) / reach_m2;
      out[d] = static_cast<std::uint16_t>(scaled(share < 1 ? 1 - share : 0));
    }
  };
  report_ = cut_.solve({.shape = shape_,
                        .window = {.begin = 0, .columns = shape_.columns},
                        .seeds = seeds_,
                        .ground_range_m = image.ground_range_m()},
                       costs, weights, {}, sides_);
  for (std::size_t cell = 0; cell < parts_.size(); ++cell) {
    parts_[cell] = static_cast<Part>(static_cast<std::uint8_t>(seeds_[cell]) & kEitherPart);
  }
  return parts_;
}

}  // namespace terracut::objects
