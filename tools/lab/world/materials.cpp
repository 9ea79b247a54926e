// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "materials.hpp"

namespace terracut::world {

// Returns reflectivities near a wavelength of 905 nm, where asphalt and rubber are dark, and leaves
// and grass are bright.
MaterialProperties properties(Material material) noexcept {
  switch (material) {
    case Material::kAsphalt:
      return {0.14, 0.002, 0};
    case Material::kRoadPaint:
      return {0.5, 0.002, 0};
    case Material::kPaving:
      return {0.22, 0.003, 0};
    case Material::kGravel:
      return {0.2, 0.008, 0};
    case Material::kGrass:
      return {0.4, 0.02, 0};
    case Material::kSoil:
      return {0.22, 0.012, 0};
    case Material::kLightPaint:
      return {0.45, 0.002, 0.03};
    case Material::kDarkPaint:
      return {0.08, 0.002, 0.15};
    case Material::kGlass:
      return {0.1, 0.002, 0.6};
    case Material::kRubber:
      return {0.06, 0.003, 0};
    case Material::kCloth:
      return {0.35, 0.008, 0};
    case Material::kFacade:
      return {0.4, 0.004, 0};
    case Material::kLeaves:
      return {0.45, 0.01, 0};
    case Material::kBark:
      return {0.25, 0.005, 0};
    case Material::kMetal:
      return {0.4, 0.002, 0.05};
    case Material::kWood:
      return {0.35, 0.003, 0};
    case Material::kSign:
      return {2.0, 0.002, 0};
  }
  return {};
}

}  // namespace terracut::world
