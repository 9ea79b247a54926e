// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/remembered/street_memory.hpp"

#include <algorithm>

namespace terracut::remembered {
namespace {

using min_cut::Seed;

constexpr int kSurely = StreetGrid::kSure / 2;
/// With fewer certain returns over certain memory, the motion is not judged.
constexpr std::uint32_t kEnoughToTell = 500;

}  // namespace

StreetMemory::StreetMemory(const Config& config, frame::ImageShape shape,
                           memory::FixedMemory& memory)
    : config_(config),
      grid_(config.grid, memory),
      box_(memory.take<std::uint32_t>("street memory", shape.cells())),
      prior_(memory.take<std::int16_t>("street memory", shape.cells())),
      own_(memory.take<std::uint8_t>("street memory", shape.cells())),
      is_tall_(memory.take<std::uint8_t>(
          "street memory", std::size_t{StreetGrid::kSide} * std::size_t{StreetGrid::kSide})) {}

void StreetMemory::forget() noexcept {
  journey_ = 0;
  report_ = {};
}

void StreetMemory::look_back(const frame::Place& place, const frame::PointPlanes& points,
                             const stage::CellPlanes& planes, std::span<Seed> seeds) noexcept {
  report_ = {.used = journey_ != 0 && journey_ == place.journey};
  if (!report_.used) grid_.clear();
  journey_ = place.journey;
  grid_.begin_frame(place);
  find_boxes(points, planes, seeds);
  if (report_.used && is_contradicted()) {
    report_ = {.contradicted = true};
    grid_.clear();
    grid_.begin_frame(place);
  }
  find_priors(planes, seeds);
}

void StreetMemory::find_boxes(const frame::PointPlanes& points, const stage::CellPlanes& planes,
                              std::span<const Seed> seeds) noexcept {
  std::ranges::fill(is_tall_, std::uint8_t{0});
  agreed_ = contradicted_ = 0;
  for (std::size_t cell = 0; cell < box_.size(); ++cell) {
    box_[cell] = StreetGrid::kOutside;
    if (seeds[cell] == Seed::kNone) continue;
    const std::uint32_t square = grid_.square_of(points.x_m[cell], points.y_m[cell]);
    if (square == StreetGrid::kOutside) continue;
    const float height_m = planes.height_m[cell];
    if (height_m > config_.tall_m && seeds[cell] == Seed::kObstacle) is_tall_[square] = 1;
    const std::uint32_t box = grid_.box_of(square, height_m);
    if (box == StreetGrid::kOutside) continue;
    box_[cell] = box;
    if (seeds[cell] == Seed::kUnknown) continue;
    const int said = grid_.said_before(box);
    if (said > -kSurely && said < kSurely) continue;
    ++((said > 0) == (seeds[cell] == Seed::kGround) ? agreed_ : contradicted_);
  }
}

bool StreetMemory::is_contradicted() const noexcept {
  const std::uint32_t all = agreed_ + contradicted_;
  return all >= kEnoughToTell &&
         static_cast<float>(contradicted_) > config_.max_contradiction * static_cast<float>(all);
}

bool StreetMemory::stands_beside_tall(std::uint32_t square) const noexcept {
  constexpr auto kSide = static_cast<std::uint32_t>(StreetGrid::kSide);
  const std::uint32_t row = square / kSide, column = square % kSide;
  for (const std::uint32_t r : {row + kSide - 1, row, row + 1}) {
    const std::size_t first = std::size_t{r % kSide} * kSide;
    if ((is_tall_[first + (column + kSide - 1) % kSide] | is_tall_[first + column] |
         is_tall_[first + (column + 1) % kSide]) != 0) {
      return true;
    }
  }
  return false;
}

void StreetMemory::find_priors(const stage::CellPlanes& planes, std::span<Seed> seeds) noexcept {
  const float full =
      config_.weight * static_cast<float>(min_cut::kCapacityScale) / float{StreetGrid::kSure};
  const auto reopen = static_cast<int>(config_.reopen_share * float{StreetGrid::kSure});
  for (std::size_t cell = 0; cell < box_.size(); ++cell) {
    if (seeds[cell] != Seed::kUnknown) {
      const bool is_low = seeds[cell] == Seed::kObstacle && box_[cell] != StreetGrid::kOutside &&
                          planes.height_m[cell] < config_.reopen_height_m;
      own_[cell] = kCertain;
      if (!is_low) continue;
      own_[cell] = kLow;
    } else {
      own_[cell] = kOpen;
      prior_[cell] = 0;
    }
    if (!report_.used || box_[cell] == StreetGrid::kOutside) continue;
    const int said = grid_.said_before(box_[cell]);
    if (said == 0 || (own_[cell] == kLow && said < reopen)) continue;
    if (said > 0 && stands_beside_tall(box_[cell] / StreetGrid::kLayers)) continue;
    if (own_[cell] == kLow) {
      seeds[cell] = Seed::kUnknown;
      ++report_.reopened;
    }
    prior_[cell] = static_cast<std::int16_t>(static_cast<float>(said) * full);
    ++report_.priors;
  }
}

}  // namespace terracut::remembered
