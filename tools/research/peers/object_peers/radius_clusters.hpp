// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace terracut::object_peers {

/// Clusters points by distance: points of one kind that are less than `reach_m` apart belong
/// together, and so does whatever they belong together with. `places` are metres. Returns the
/// number of each point's cluster, from 1.
inline std::vector<std::uint32_t> radius_clusters(const std::vector<std::array<float, 3>>& places,
                                                  const std::vector<std::uint32_t>& kinds,
                                                  float reach_m) {
  struct Cell {
    std::uint32_t kind;
    std::array<int, 3> at;
    bool operator<(const Cell& other) const {
      return kind != other.kind ? kind < other.kind : at < other.at;
    }
  };
  const auto cell_of = [&](std::size_t i) {
    Cell cell{kinds[i], {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cell.at[axis] = static_cast<int>(std::floor(places[i][axis] / reach_m));
    }
    return cell;
  };
  // Points leave their cell when they are reached, so that no pair is looked at twice.
  std::map<Cell, std::vector<std::size_t>> waiting;
  for (std::size_t i = 0; i < places.size(); ++i) waiting[cell_of(i)].push_back(i);
  std::vector<std::uint32_t> cluster_of(places.size());
  std::uint32_t clusters = 0;
  const auto reach = [&](const std::array<float, 3>& from, std::vector<std::size_t>& points,
                         std::vector<std::size_t>& reached) {
    for (std::size_t k = 0; k < points.size();) {
      const std::array<float, 3>& to = places[points[k]];
      const float x_m = to[0] - from[0], y_m = to[1] - from[1], z_m = to[2] - from[2];
      if (x_m * x_m + y_m * y_m + z_m * z_m < reach_m * reach_m) {
        cluster_of[points[k]] = clusters;
        reached.push_back(points[k]);
        points[k] = points.back();
        points.pop_back();
      } else {
        ++k;
      }
    }
  };
  std::vector<std::size_t> reached;
  for (std::size_t first = 0; first < places.size(); ++first) {
    if (cluster_of[first] != 0) continue;
    ++clusters;
    reached.clear();
    reach(places[first], waiting[cell_of(first)], reached);
    for (std::size_t k = 0; k < reached.size(); ++k) {
      const std::size_t from = reached[k];
      const Cell middle = cell_of(from);
      for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
          for (int z = -1; z <= 1; ++z) {
            const auto found =
                waiting.find({middle.kind, {middle.at[0] + x, middle.at[1] + y, middle.at[2] + z}});
            if (found != waiting.end()) reach(places[from], found->second, reached);
          }
        }
      }
    }
  }
  return cluster_of;
}

}  // namespace terracut::object_peers
