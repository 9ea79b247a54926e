// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "free_trials.hpp"

namespace terracut::free_measures {

/// Returns
///
///   {frames, milliseconds, seen_m (mean), seen_ends {rows, lost, obstacle, drop: shares},
///    obstacles {right, nearer, farther, empty: sectors},
///    boxes[] and pits[] {from_m, to_m, trials, failed, nearer, worst_m}}
///
/// Means and shares are null without frames; worst_m is null where a box was not found at all.
[[nodiscard]] nlohmann::ordered_json free_json(const FreeCounts& counts);

/// Returns the result of free_json() as tables for people and documents.
[[nodiscard]] std::string free_text(const std::string& method, const nlohmann::ordered_json& json);

}  // namespace terracut::free_measures
