// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "pipeline/free_way/sector.hpp"
#include "pipeline/objects/object.hpp"
#include "pipeline/pictures/caption.hpp"
#include "pipeline/pictures/png_picture.hpp"

namespace terracut::pictures {

/// How a return's label compares with the truth, for pictures that show mistakes.
enum class Mistake : std::uint8_t {
  kNone,
  kMissedObstacle,  ///< The truth is obstacle, the label ground.
  kFalseObstacle,   ///< The truth is ground, the label obstacle.
};

/// A labelled frame as the pictures need it. All spans are by return index.
struct LabelledFrame {
  const frame::RangeImage& image;
  std::span<const frame::Label> labels;          ///< One label per return.
  std::span<const Mistake> mistakes;             ///< One per return; empty if the truth is unknown.
  std::span<const objects::Object> objects{};    ///< Drawn from above, by their boxes.
  std::span<const free_way::Sector> free_way{};  ///< Drawn from above, as the area that is free.
};

inline constexpr Colour kPictureBackground{14, 17, 23};
inline constexpr Colour kTextColour{240, 244, 248};
inline constexpr Colour kObjectColour{255, 199, 92};
inline constexpr Colour kFreeAreaColour{18, 52, 46};
inline constexpr Colour kFreeWayColour{72, 210, 155};
inline constexpr Colour kMissedObstacleColour{255, 30, 30};
inline constexpr Colour kFalseObstacleColour{255, 221, 0};

/// Returns the colour of a return. Ground is sand, brighter with more returned light. Obstacles go
/// by height, from coral at the ground over violet to blue above 4 m; if mistakes are shown, all
/// other obstacles are slate, so that mistakes stand out.
[[nodiscard]] Colour colour_of_return(const LabelledFrame& frame, std::uint32_t return_index,
                                      const frame::Return& point) noexcept;
/// Returns the legend for the colours of `frame`, in the order of the labels.
[[nodiscard]] std::vector<LegendEntry> legend_of(const LabelledFrame& frame);

}  // namespace terracut::pictures
