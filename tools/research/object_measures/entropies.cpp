// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "entropies.hpp"

#include <cmath>

#include "overlaps.hpp"

namespace terracut::object_measures {

Entropies entropies(std::span<const std::uint32_t> true_object,
                    std::span<const std::uint32_t> found_object) {
  const Overlaps counts = overlaps(true_object, found_object);
  const auto part = [](std::uint32_t returns, std::uint32_t of) {
    const double share = static_cast<double>(returns) / static_cast<double>(of);
    return -share * std::log(share);
  };
  Entropies sum;
  for (const auto& [parts, returns] : counts.both) {
    const auto [is_true, is_found] = parts;
    // A found object that lies whole outside true objects adds -1 log 1 = 0.
    if (is_true != 0) sum.over_segmentation += part(returns, counts.first.at(is_true));
    if (is_found != 0) sum.under_segmentation += part(returns, counts.second.at(is_found));
  }
  return sum;
}

}  // namespace terracut::object_measures
