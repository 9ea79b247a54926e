// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The judge of tools/beside_peer --objects: `object_entropies SCAN.bin TRUE.label FOUND.label...`
// prints the over- and under-segmentation entropy of each FOUND, a line each. It counts as
// UniBwTAS/continuous_clustering (commit e59f77e) describes: true objects are clusters of 10 to
// 300,000 points of one label less than 1 m apart, but for ground and unlabelled points.
#include <algorithm>
#include <cmath>

#include "object_peer_program.hpp"
#include "radius_clusters.hpp"

namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers true_objects(const std::vector<terracut::peers::Point>& points, const Numbers& labels) {
  constexpr std::array<std::uint32_t, 7> kNoObject{0, 40, 44, 48, 49, 60, 72};
  constexpr float kApart_m = 1.0F;
  constexpr std::size_t kFewest = 10, kMost = 300'000;
  std::vector<std::array<float, 3>> places;
  Numbers kinds;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::find(kNoObject.begin(), kNoObject.end(), labels[i] & 0xFFFF) != kNoObject.end()) {
      continue;
    }
    places.push_back({points[i][0], points[i][1], points[i][2]});
    kinds.push_back(labels[i]);
    indices.push_back(i);
  }
  const Numbers clusters = terracut::object_peers::radius_clusters(places, kinds, kApart_m);
  std::map<std::uint32_t, std::size_t> sizes;
  for (const std::uint32_t cluster : clusters) ++sizes[cluster];
  Numbers objects(points.size());
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const std::size_t size = sizes[clusters[i]];
    if (size >= kFewest && size <= kMost) objects[indices[i]] = clusters[i];
  }
  return objects;
}

/// Returns the sum over the objects of `whole` of the entropy of the parts that `other` makes of
/// each; 0 is no object of `whole`, and a part as any other.
double entropy(const Numbers& whole, const Numbers& other) {
  std::map<std::uint32_t, std::map<std::uint32_t, double>> parts;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (whole[i] != 0) ++parts[whole[i]][other[i]];
  }
  double sum = 0;
  for (const auto& [object, of_object] : parts) {
    double points = 0;
    for (const auto& [part, count] : of_object) points += count;
    for (const auto& [part, count] : of_object) sum -= count / points * std::log(count / points);
  }
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: " << argv[0] << " SCAN.bin TRUE.label FOUND.label...\n";
    return 1;
  }
  const std::vector<terracut::peers::Point> points = terracut::peers::read_scan(argv[1]);
  const Numbers labels = terracut::object_peers::read_labels(argv[2]);
  if (points.empty() || points.size() != labels.size()) {
    std::cerr << argv[2] << ": not the labels of " << argv[1] << '\n';
    return 1;
  }
  const Numbers truth = true_objects(points, labels);
  for (int i = 3; i < argc; ++i) {
    Numbers found = terracut::object_peers::read_labels(argv[i]);
    if (found.size() != points.size()) {
      std::cerr << argv[i] << ": not the labels of " << argv[1] << '\n';
      return 1;
    }
    for (std::uint32_t& label : found) label >>= 16;
    std::printf("%.9f %.9f\n", entropy(truth, found), entropy(found, truth));
  }
  return 0;
}
