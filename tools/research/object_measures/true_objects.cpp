// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "true_objects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "firmware_io/scan/label_file.hpp"

namespace terracut::object_measures {
namespace {

constexpr float kTogether_m = 1.0F;
constexpr std::size_t kFewest = 10, kMost = 300'000;
/// SemanticKITTI's unlabelled, road, parking, sidewalk, other-ground, lane-marking, terrain.
constexpr std::array<std::uint16_t, 7> kNoObject{0, 40, 44, 48, 49, 60, 72};
/// All returns in a cube of this edge are less than kTogether_m apart.
constexpr float kCube_m = 0.57F;
/// Returns less than kTogether_m apart lie at most so many cubes apart.
constexpr int kReach = 2;

/// A cube of one label.
using CubeKey = std::tuple<std::uint32_t, int, int, int>;

bool are_together(const Place& a, const Place& b) {
  const float x_m = a.x_m - b.x_m, y_m = a.y_m - b.y_m, z_m = a.z_m - b.z_m;
  return x_m * x_m + y_m * y_m + z_m * z_m < kTogether_m * kTogether_m;
}

CubeKey key_of(std::uint32_t label, const Place& place) {
  const auto number = [](float at_m) { return static_cast<int>(std::floor(at_m / kCube_m)); };
  return {label, number(place.x_m), number(place.y_m), number(place.z_m)};
}

std::uint32_t root_of(std::vector<std::uint32_t>& parents, std::uint32_t of) {
  while (parents[of] != of) of = parents[of] = parents[parents[of]];
  return of;
}

}  // namespace

std::vector<std::uint32_t> true_objects(std::span<const Place> places,
                                        std::span<const std::uint32_t> labels) {
  std::map<CubeKey, std::vector<std::uint32_t>> cubes;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    if (std::ranges::find(kNoObject, scan::semantic_class(labels[i])) != kNoObject.end()) continue;
    cubes[key_of(labels[i], places[i])].push_back(i);
  }
  std::vector<std::uint32_t> parents(places.size());
  std::iota(parents.begin(), parents.end(), 0U);
  for (const auto& [key, members] : cubes) {
    for (const std::uint32_t i : members) parents[i] = members.front();
  }
  const auto touch = [&](const auto& some, const auto& others) {
    return std::ranges::any_of(some, [&](std::uint32_t i) {
      return std::ranges::any_of(
          others, [&](std::uint32_t j) { return are_together(places[i], places[j]); });
    });
  };
  for (const auto& [key, members] : cubes) {
    const auto [label, x, y, z] = key;
    for (int dx = -kReach; dx <= kReach; ++dx) {
      for (int dy = -kReach; dy <= kReach; ++dy) {
        for (int dz = -kReach; dz <= kReach; ++dz) {
          const auto other = cubes.find({label, x + dx, y + dy, z + dz});
          if (other == cubes.end() || other->first <= key) continue;
          const std::uint32_t a = root_of(parents, members.front());
          const std::uint32_t b = root_of(parents, other->second.front());
          if (a != b && touch(members, other->second)) parents[a] = b;
        }
      }
    }
  }
  std::vector<std::size_t> sizes(places.size());
  for (const auto& [key, members] : cubes) {
    sizes[root_of(parents, members.front())] += members.size();
  }
  std::vector<std::uint32_t> objects(places.size()), number_of_root(places.size());
  std::uint32_t objects_so_far = 0;
  for (const auto& [key, members] : cubes) {
    const std::uint32_t root = root_of(parents, members.front());
    if (sizes[root] < kFewest || sizes[root] > kMost) continue;
    if (number_of_root[root] == 0) number_of_root[root] = ++objects_so_far;
    for (const std::uint32_t i : members) objects[i] = number_of_root[root];
  }
  return objects;
}

}  // namespace terracut::object_measures
