// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <map>

#include "peer_program.hpp"

/// Code shared by the adapters of peers that find objects; like peer_program.hpp it includes
/// nothing of this project.
namespace terracut::object_peers {

using peers::Point;

/// A scan in which terracut has told obstacles from ground, the same for every peer.
struct MarkedScan {
  std::vector<Point> points;
  std::vector<bool> is_obstacle;  ///< By point.
};

/// Returns the entries of a label file; an empty list if there is no such file.
inline std::vector<std::uint32_t> read_labels(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return {};
  std::vector<std::uint32_t> labels(static_cast<std::size_t>(file.tellg()) / sizeof(std::uint32_t));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(labels.data()),
            static_cast<std::streamsize>(labels.size() * sizeof(labels[0])));
  return file ? labels : std::vector<std::uint32_t>{};
}

/// Returns SCAN.bin, marked by SCAN.label beside it, where the class 99 is an obstacle; nothing if
/// they are no scan and its labels.
inline std::optional<MarkedScan> read_marked_scan(const std::string& path) {
  constexpr std::uint32_t kObstacle = 99, kClass = 0xFFFF;
  MarkedScan scan{peers::read_scan(path.c_str()), {}};
  for (const std::uint32_t label : read_labels(path.substr(0, path.rfind('.')) + ".label")) {
    scan.is_obstacle.push_back((label & kClass) == kObstacle);
  }
  if (scan.points.empty() || scan.points.size() != scan.is_obstacle.size()) return std::nullopt;
  return scan;
}

/// Returns the indices of the points that are obstacles.
inline std::vector<std::size_t> obstacles_of(const MarkedScan& scan) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (scan.is_obstacle[i]) indices.push_back(i);
  }
  return indices;
}

/// main() of a peer that finds objects: a Peer of run_program() with
///
///   static Scan scan_of(const MarkedScan&);                     not timed
///   std::vector<std::uint32_t> object_of(const Scan&);          by point of the MarkedScan; any
///                                                               number but 0 is an object
///
/// The labels' upper 16 bits are the objects, numbered from 1 in order of their first points.
template <class Peer>
int run_object_peer(int argc, char** argv) {
  using Scan = typename Peer::Scan;
  const auto scan_of = [](const char* path) -> std::optional<Scan> {
    const std::optional<MarkedScan> scan = read_marked_scan(path);
    if (!scan) return std::nullopt;
    return Peer::scan_of(*scan);
  };
  const auto labels_of = [](Peer& peer, const Scan& scan) {
    constexpr std::uint32_t kObstacle = 99;
    std::map<std::uint32_t, std::uint32_t> numbers;
    std::vector<std::uint32_t> labels;
    for (const std::uint32_t object : peer.object_of(scan)) {
      std::uint32_t number = 0;
      if (object != 0) {
        const auto next = static_cast<std::uint32_t>(numbers.size() + 1);
        number = numbers.try_emplace(object, next).first->second;
      }
      labels.push_back(number << 16 | kObstacle);
    }
    return labels;
  };
  return peers::run_program<Peer>(argc, argv, scan_of, labels_of);
}

}  // namespace terracut::object_peers
