// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "scene.hpp"

/// The functions behind make_scene(), one per file; extent.speed_mps is already the speed to use.
namespace terracut::scenes {

[[nodiscard]] Scene make_street_scene(const SceneExtent& extent);
[[nodiscard]] Scene make_highway_scene(const SceneExtent& extent);
[[nodiscard]] Scene make_rural_scene(const SceneExtent& extent);
[[nodiscard]] Scene make_flat_scene(const SceneExtent& extent);
[[nodiscard]] Scene make_hill_scene(const SceneExtent& extent);

}  // namespace terracut::scenes
