// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Euclidean clusters as an object peer of tools/beside_peer: written anew, with the parameters that
// Autoware's autoware_euclidean_cluster has in its config/. Heights do not count, as there. With
// SQUARES it clusters the mean places of squares, else the points; with ALL no cluster is too
// large.
#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

#include "object_peer_program.hpp"
#include "radius_clusters.hpp"

namespace {

constexpr float kTolerance_m = 0.7F;
constexpr std::size_t kFewestPoints = 10;
/// A cluster of more squares (points) is not an object; one of more than `kLarge` squares keeps at
/// most `kPointsOfASquare` of each, chosen by chance.
#if defined(ALL)
constexpr std::size_t kMost = SIZE_MAX, kLarge = SIZE_MAX, kPointsOfASquare = SIZE_MAX;
#elif defined(SQUARES)
constexpr std::size_t kMost = 800, kLarge = 65, kPointsOfASquare = 10;
#else
constexpr std::size_t kMost = 1000, kLarge = SIZE_MAX, kPointsOfASquare = SIZE_MAX;
#endif

using Place = std::array<float, 3>;

class Euclidean {
 public:
  using Scan = terracut::object_peers::MarkedScan;

  static Scan scan_of(const Scan& scan) { return scan; }
  void prepare(const Scan& scan) { objects_.assign(scan.points.size(), 0); }
  void segment(const Scan& scan) {
    const std::vector<std::size_t> points = terracut::object_peers::obstacles_of(scan);
    std::vector<std::size_t> unit_of_point(points.size());
    std::vector<Place> units;
#ifdef SQUARES
    constexpr float kSquare_m = 0.3F;
    std::map<std::pair<int, int>, std::size_t> squares;
    std::vector<float> points_in;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& p = scan.points[points[i]];
      const auto [square, is_new] =
          squares.try_emplace({static_cast<int>(std::floor(p[0] / kSquare_m)),
                               static_cast<int>(std::floor(p[1] / kSquare_m))},
                              units.size());
      if (is_new) units.push_back({}), points_in.push_back(0);
      unit_of_point[i] = square->second;
      units[square->second][0] += p[0], units[square->second][1] += p[1];
      ++points_in[square->second];
    }
    for (std::size_t i = 0; i < units.size(); ++i) {
      units[i][0] /= points_in[i], units[i][1] /= points_in[i];
    }
#else
    for (const std::size_t i : points) units.push_back({scan.points[i][0], scan.points[i][1], 0});
    std::iota(unit_of_point.begin(), unit_of_point.end(), std::size_t{0});
#endif
    const std::vector<std::uint32_t> cluster_of_unit = terracut::object_peers::radius_clusters(
        units, std::vector<std::uint32_t>(units.size()), kTolerance_m);
    std::vector<std::size_t> units_of(units.size() + 1), points_of(units.size() + 1);
    for (const std::uint32_t cluster : cluster_of_unit) ++units_of[cluster];
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (kLarge < SIZE_MAX) std::shuffle(order.begin(), order.end(), std::default_random_engine(42));
    std::vector<std::size_t> kept_of_unit(units.size());
    for (const std::size_t i : order) {
      const std::size_t unit = unit_of_point[i];
      const std::uint32_t cluster = cluster_of_unit[unit];
      if (units_of[cluster] > kMost) continue;
      if (units_of[cluster] > kLarge && ++kept_of_unit[unit] > kPointsOfASquare) continue;
      objects_[points[i]] = cluster;
      ++points_of[cluster];
    }
    for (std::uint32_t& object : objects_) {
      if (points_of[object] < kFewestPoints) object = 0;
    }
  }
  std::vector<std::uint32_t> object_of(const Scan&) { return objects_; }

 private:
  std::vector<std::uint32_t> objects_;
};

}  // namespace

int main(int argc, char** argv) {
  return terracut::object_peers::run_object_peer<Euclidean>(argc, argv);
}
