// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::world {

/// The true class of a simulated surface: a class number of SemanticKITTI, as in label files.
enum class Truth : std::uint32_t {
  kCar = 10,
  kTruck = 18,
  kPerson = 30,
  kBicyclist = 31,
  kRoad = 40,
  kParking = 44,
  kSidewalk = 48,  ///< Also the face of a kerb.
  kOtherGround = 49,
  kBuilding = 50,
  kFence = 51,
  kVegetation = 70,
  kTrunk = 71,
  kTerrain = 72,
  kPole = 80,
};

/// True for the classes of ground.
[[nodiscard]] constexpr bool is_ground(Truth truth) noexcept {
  return truth == Truth::kRoad || truth == Truth::kParking || truth == Truth::kSidewalk ||
         truth == Truth::kOtherGround || truth == Truth::kTerrain;
}

/// True for the classes of which SemanticKITTI numbers the instances: vehicles and persons.
[[nodiscard]] constexpr bool has_instances(Truth truth) noexcept {
  return truth == Truth::kCar || truth == Truth::kTruck || truth == Truth::kPerson ||
         truth == Truth::kBicyclist;
}

/// The optical material of a surface.
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
  double reflectivity = 0;  ///< Share of light returned at normal incidence; > 1: retro-reflector.
  double roughness_m = 0;   ///< Standard deviation of depth in the spot (grass, gravel).
  double drop_share = 0;  ///< Share of returns lost at any distance: light reflected away by gloss.
};

[[nodiscard]] MaterialProperties properties(Material material) noexcept;

}  // namespace terracut::world
