// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "object_trials.hpp"

namespace terracut::object_measures {

/// Returns `tuned` and `unseen`, each
///
///   {frames, objects, milliseconds, ose {mean, deviation}, use {mean, deviation},
///    instances[] {kind, instances, found, false_objects, pq, recall, bands[] {range, ...}}}
///
/// of which the last has the same figures for each range band. pq and recall are in [0, 1], or null
/// without instances.
[[nodiscard]] nlohmann::ordered_json object_json(const SplitCounts& counts);

/// Returns the result of object_json() as a table for people and documents.
[[nodiscard]] std::string object_text(const std::string& method,
                                      const nlohmann::ordered_json& json);

}  // namespace terracut::object_measures
