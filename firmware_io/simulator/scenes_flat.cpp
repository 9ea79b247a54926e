// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <array>

#include "firmware_io/simulator/scene_layout.hpp"
#include "firmware_io/simulator/scenes.hpp"
#include "firmware_io/simulator/shape_makers.hpp"

namespace terracut::firmware_io {
namespace {

constexpr std::array<FlatSceneBox, 6> kBoxes = {{
    {15.0, 4.0, 4.2, 1.8, 1.5, Truth::kCar},
    {8.0, -3.0, 0.5, 0.5, 1.75, Truth::kPerson},
    {25.0, -6.0, 12.0, 2.5, 3.8, Truth::kTruck},
    {-20.0, 12.0, 10.0, 6.0, 8.0, Truth::kBuilding},
    {12.0, -8.0, 0.2, 0.2, 5.0, Truth::kPole},
    {-10.0, -7.0, 6.0, 0.4, 1.0, Truth::kFence},
}};

}  // namespace

std::span<const FlatSceneBox> flat_scene_boxes() noexcept {
  return kBoxes;
}

Scene make_flat_scene(const SceneExtent& extent) {
  Road road;
  road.left.strips = {Strip{.width_m = 1}};
  road.right.strips = road.left.strips;
  Scene scene{Terrain(road, extent.seed), {}, 0, extent.speed_mps < 0 ? 5.0 : extent.speed_mps};
  SceneLayout layout(scene, extent);
  for (const FlatSceneBox& known : kBoxes) {
    SceneObject object;
    object.shapes = {box({0, 0, 0}, {known.length_m, known.width_m, known.height_m},
                         {known.truth, Material::kFacade})};
    layout.add(object, {known.x_m, known.y_m});
  }
  return scene;
}

}  // namespace terracut::firmware_io
