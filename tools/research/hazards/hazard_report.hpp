// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "hazard_trials.hpp"

namespace terracut::hazards {

/// Returns the trials of methods[index]. Shares are in [0, 1], or null if undefined.
///
///   hazards[]       {hazard, ground, from_m, to_m, trials, found, unseen, returns,
///                   returns_as_obstacle, elsewhere}; unseen: trials with no return called obstacle
///   disturbances[]  {disturbance, elsewhere}
///   elsewhere       {iou_g, recall_o}, each {before, after}, of the returns that did not move: for
///                   hazards of all trials together, for disturbances the mean over sequences
[[nodiscard]] nlohmann::ordered_json hazard_json(const HazardTrials& trials, std::size_t index);

/// Returns the result of hazard_json() as tables for people.
[[nodiscard]] std::string hazard_text(const std::string& method,
                                      const nlohmann::ordered_json& json);

}  // namespace terracut::hazards
