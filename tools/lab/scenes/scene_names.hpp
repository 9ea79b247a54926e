// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string_view>

namespace terracut::scenes {

/// "street"   kerbs of 6 to 20 cm, parked cars, people, cyclists, houses, trees; 30 km/h
/// "highway"  two carriageways at 3 % grade, barriers, trucks, banks up and down; 97 km/h
/// "rural"    narrow bending road, ditches, banks, rough grass, hedges, fences; 43 km/h
/// "flat"     a plane at z = 0 with the boxes of flat_scene_boxes(), which do not vary; 18 km/h
/// "hill"     onto a 15 % slope across a hillside; 29 km/h
[[nodiscard]] std::span<const std::string_view> scene_names() noexcept;

}  // namespace terracut::scenes
