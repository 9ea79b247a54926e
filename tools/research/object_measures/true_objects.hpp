// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace terracut::object_measures {

/// A place in the vehicle frame, metres.
struct Place {
  float x_m = 0, y_m = 0, z_m = 0;
};

/// Clusters labelled returns as UniBwTAS/continuous_clustering's truth does (commit e59f77e,
/// generateEuclideanClusteringLabels): returns of one label (class and instance) less than 1 m
/// apart belong together; clusters of fewer than 10 or more than 300,000 returns, unlabelled
/// returns and ground are no object. `labels` are entries of SemanticKITTI's label files. Returns
/// the number of each return's object, from 1; 0: none.
[[nodiscard]] std::vector<std::uint32_t> true_objects(std::span<const Place> places,
                                                      std::span<const std::uint32_t> labels);

}  // namespace terracut::object_measures
