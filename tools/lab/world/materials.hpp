// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::world {

/// What a simulated surface truly is: class numbers of SemanticKITTI, as in its label files.
enum class Truth : std::uint32_t {
  kCar = 10,
  kTruck = 18,
  kPerson = 30,
  kBicyclist = 31,
  kRoad = 40,
  kParking = 44,
  kSidewalk = 48,  ///< The face of a kerb too.
  kOtherGround = 49,
  kBuilding = 50,
  kFence = 51,
  kVegetation = 70,
  kTrunk = 71,
  kTerrain = 72,
  kPole = 80,
};

/// The classes that are ground.
[[nodiscard]] constexpr bool is_ground(Truth truth) noexcept {
  return truth == Truth::kRoad || truth == Truth::kParking || truth == Truth::kSidewalk ||
         truth == Truth::kOtherGround || truth == Truth::kTerrain;
}

/// What a surface is made of, as far as light is concerned.
enum class Material : std::uint8_t {
  kAsphalt,
  kRoadPaint,
  kPaving,
  kGravel,
  kGrass,
  kSoil,
  kLightPaint,
  kDarkPaint,
  kGlass,
  kRubber,
  kCloth,
  kFacade,
  kLeaves,
  kBark,
  kMetal,
  kWood,
  kSign,
};

struct MaterialProperties {
  double reflectivity =
      0;  ///< Share of light sent back at normal incidence, > 1 for retro-reflectors.
  double roughness_m =
      0;  ///< Standard deviation of depth inside the spot (blades of grass, gravel).
  double drop_share = 0;  ///< Returns lost whatever the distance: light thrown elsewhere by gloss.
};

[[nodiscard]] MaterialProperties properties(Material material) noexcept;

}  // namespace terracut::world
