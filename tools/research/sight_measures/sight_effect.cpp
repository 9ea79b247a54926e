// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sight_effect.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tools/lab/world/random.hpp"
#include "tools/research/hazards/disturbance.hpp"

namespace terracut::sight_measures {
namespace {

using hazards::LabelledFrame;
using hazards::MovedReturns;
using visibility::Cause;
using world::Random;

/// Removes returns of columns beginning anywhere, over an angle; all, or a share of the beams.
MovedReturns covered(const LabelledFrame& frame, std::uint64_t place, double wide_deg,
                     double share) {
  Random where(place);
  const int columns = frame.shape.columns;
  const int begin = where.pick(columns);
  const int wide = static_cast<int>(std::lround(wide_deg / frame.shape.pitch_deg()));
  MovedReturns moved;
  for (std::uint32_t i = 0; i < frame.size(); ++i) {
    const LabelledFrame::Cell cell = frame.cell[i];
    if ((cell.column - begin + columns) % columns >= wide) continue;
    Random beam(world::mix_keys(place, frame.shape.cell(cell.row, cell.column)));
    if (beam.chance(share)) moved.push_back({.index = i});
  }
  return moved;
}

MovedReturns hand(const LabelledFrame& frame, std::uint64_t place, std::uint64_t) {
  return covered(frame, place, 40, 1);
}
MovedReturns mud(const LabelledFrame& frame, std::uint64_t place, std::uint64_t) {
  return covered(frame, place, 30, 0.97);
}

/// Spots of 1 to 4 degrees, and an eighth of the rows, until a tenth of all beams is covered.
MovedReturns dirt(const LabelledFrame& frame, std::uint64_t place, std::uint64_t) {
  constexpr double kShare = 0.1;
  const int rows = frame.shape.rows, columns = frame.shape.columns;
  std::vector<std::uint8_t> is_covered(frame.shape.cells());
  Random random(place);
  for (int covered = 0; covered < kShare * rows * columns;) {
    const double width_deg = random.uniform(1, 4);
    const int wide = std::max(1, static_cast<int>(width_deg / frame.shape.pitch_deg()));
    const int high = std::max(1, rows / 8);
    const int first_row = random.pick(rows), first_column = random.pick(columns);
    for (int row = first_row; row < std::min(first_row + high, rows); ++row) {
      for (int i = 0; i < wide; ++i) {
        std::uint8_t& cell = is_covered[frame.shape.cell(row, (first_column + i) % columns)];
        covered += cell == 0 ? 1 : 0;
        cell = 1;
      }
    }
  }
  MovedReturns moved;
  for (std::uint32_t i = 0; i < frame.size(); ++i) {
    const LabelledFrame::Cell cell = frame.cell[i];
    if (is_covered[frame.shape.cell(cell.row, cell.column)] != 0) moved.push_back({.index = i});
  }
  return moved;
}

/// Light fades by exp(-3 / visual range) a metre. Without fog, ground is seen up to about 50 m at a
/// grazing angle that falls with distance, other surfaces up to 120 m; with fog as far as as much
/// light comes back as from there, give or take a factor of two. Of the beams that are lost, some
/// are returned by droplets in the first metres.
MovedReturns fog(const LabelledFrame& frame, std::uint64_t, std::uint64_t turn) {
  constexpr double kFade_per_m = 3.0 / 30, kGround_m = 50, kOther_m = 120;
  constexpr double kDropletShare = 0.2, kNearest_m = 1.5, kFarthest_m = 8;
  MovedReturns moved;
  for (std::uint32_t i = 0; i < frame.size(); ++i) {
    Random random(world::mix_keys(turn, i));
    const double range_m = frame.range_m[i];
    const double without =
        frame.ground[i] ? std::pow(kGround_m / range_m, 3) : std::pow(kOther_m / range_m, 2);
    const double light = without * std::exp(-2 * kFade_per_m * range_m);
    if (light * std::exp2(random.uniform(-1, 1)) > 1) continue;
    const bool is_droplet = random.chance(kDropletShare);
    moved.push_back({i, is_droplet ? random.uniform(kNearest_m, kFarthest_m) : 0});
  }
  return moved;
}

MovedReturns disturbance(const LabelledFrame& frame, std::string_view word, std::uint64_t turn) {
  const auto* const found =
      std::ranges::find(hazards::disturbances(), word, &hazards::Disturbance::word).operator->();
  return hazards::disturbed(frame, *found, turn);
}
MovedReturns spray(const LabelledFrame& frame, std::uint64_t, std::uint64_t turn) {
  return disturbance(frame, "spray", turn);
}
MovedReturns snow(const LabelledFrame& frame, std::uint64_t, std::uint64_t turn) {
  return disturbance(frame, "snow_10", turn);
}

constexpr std::array kEffects{
    SightEffect{"hand_40", Cause::kCovered, hand}, SightEffect{"mud_30", Cause::kCovered, mud},
    SightEffect{"dirt_10", Cause::kDirt, dirt},    SightEffect{"fog_30m", Cause::kFog, fog},
    SightEffect{"spray", Cause::kAirborne, spray}, SightEffect{"snow", Cause::kAirborne, snow},
};

}  // namespace

std::span<const SightEffect> sight_effects() noexcept {
  return kEffects;
}

}  // namespace terracut::sight_measures
