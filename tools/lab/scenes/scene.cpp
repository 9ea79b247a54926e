// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstddef>

#include "scenes.hpp"

namespace terracut::scenes {
namespace {

constexpr std::array<std::string_view, 5> kNames = {"street", "highway", "rural", "flat", "hill"};
constexpr std::array<Scene (*)(const SceneExtent&), kNames.size()> kMakers = {
    make_street_scene, make_highway_scene, make_rural_scene, make_flat_scene, make_hill_scene};

}  // namespace

std::span<const std::string_view> scene_names() noexcept {
  return kNames;
}

Expected<Scene> make_scene(std::string_view name, const SceneExtent& extent) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) return kMakers[i](extent);
  }
  return fail(
      ErrorCode::kInvalidArgument,
      fmt::format("there is no scene \"{}\"; expected one of: {}", name, fmt::join(kNames, ", ")));
}

}  // namespace terracut::scenes
