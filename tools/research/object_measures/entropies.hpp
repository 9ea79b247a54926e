// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

namespace terracut::object_measures {

/// How far found objects and true objects differ in a frame, as sums of entropies (natural
/// logarithm) after UniBwTAS/continuous_clustering (commit e59f77e, evaluateClusters), which takes
/// them from TRAVEL (RA-L 2022). 0 is perfect.
struct Entropies {
  double over_segmentation = 0;   ///< OSE: of found objects in each true object.
  double under_segmentation = 0;  ///< USE: of true objects in each found object.
};

/// Compares the object numbers of returns; 0 is no object, and counts as one part of an object of
/// the other kind. A found object without a return of a true object does not count.
[[nodiscard]] Entropies entropies(std::span<const std::uint32_t> true_object,
                                  std::span<const std::uint32_t> found_object);

}  // namespace terracut::object_measures
