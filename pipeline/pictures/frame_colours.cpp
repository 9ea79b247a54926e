// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/pictures/frame_colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace terracut::pictures {
namespace {

constexpr Colour kDarkSand{84, 74, 58};
constexpr Colour kBrightSand{238, 222, 186};
constexpr Colour kDarkMoss{52, 74, 52};
constexpr Colour kBrightMoss{170, 206, 150};
constexpr Colour kSlate{92, 128, 170};

struct HeightStop {
  double height_m;
  Colour colour;
};
constexpr std::array kHeightStops{HeightStop{0.0, {255, 96, 70}}, HeightStop{1.0, {255, 72, 140}},
                                  HeightStop{2.2, {178, 92, 240}}, HeightStop{4.0, {74, 158, 255}}};

Colour by_height(double height_m) noexcept {
  if (height_m <= kHeightStops.front().height_m) return kHeightStops.front().colour;
  for (std::size_t i = 1; i < kHeightStops.size(); ++i) {
    const HeightStop& low = kHeightStops[i - 1];
    const HeightStop& high = kHeightStops[i];
    if (height_m < high.height_m) {
      return mix(low.colour, high.colour,
                 (height_m - low.height_m) / (high.height_m - low.height_m));
    }
  }
  return kHeightStops.back().colour;
}

}  // namespace

Colour colour_of_return(const LabelledFrame& frame, std::uint32_t return_index,
                        const frame::Return& point) noexcept {
  const bool truth_known = !frame.mistakes.empty();
  if (truth_known && frame.mistakes[return_index] == Mistake::kMissedObstacle) {
    return kMissedObstacleColour;
  }
  if (truth_known && frame.mistakes[return_index] == Mistake::kFalseObstacle) {
    return kFalseObstacleColour;
  }
  if (frame.labels[return_index] == frame::Label::kGround) {
    // The square root brightens dark returns, such as those of asphalt.
    return mix(kDarkSand, kBrightSand, std::sqrt(point.intensity / 255.0));
  }
  if (frame.labels[return_index] == frame::Label::kOtherGround) {
    return mix(kDarkMoss, kBrightMoss, std::sqrt(point.intensity / 255.0));
  }
  return truth_known ? kSlate : by_height(static_cast<double>(point.z_m));
}

std::vector<LegendEntry> legend_of(const LabelledFrame& frame) {
  std::vector<LegendEntry> legend{{"ground", {mix(kDarkSand, kBrightSand, 0.5)}}};
  if (std::ranges::find(frame.labels, frame::Label::kOtherGround) != frame.labels.end()) {
    legend.push_back({"ground beside the road", {mix(kDarkMoss, kBrightMoss, 0.5)}});
  }
  if (!frame.mistakes.empty()) {
    legend.push_back({"obstacle", {kSlate}});
    legend.push_back({"missed obstacle", {kMissedObstacleColour}});
    legend.push_back({"false obstacle", {kFalseObstacleColour}});
    return legend;
  }
  LegendEntry obstacle{"obstacle, 0 to 4 m high", {}};
  constexpr double kStep_m = 0.1;
  for (double height_m = 0; height_m <= kHeightStops.back().height_m; height_m += kStep_m) {
    obstacle.colours.push_back(by_height(height_m));
  }
  legend.push_back(std::move(obstacle));
  if (!frame.free_way.empty()) legend.push_back({"free way", {kFreeWayColour}});
  if (!frame.objects.empty()) legend.push_back({"object", {kObjectColour}});
  return legend;
}

}  // namespace terracut::pictures
