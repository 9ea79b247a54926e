// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "sight_trials.hpp"

namespace terracut::sight_measures {

/// Returns {turns, alarms, standing_turns, standing_alarms, effects[] {effect, cause, sequences,
/// named, most_turns, wrong_turns}}.
[[nodiscard]] nlohmann::ordered_json sight_json(const SightCounts& counts);

/// Returns the result of sight_json() as a table for people and documents.
[[nodiscard]] std::string sight_text(const std::string& method, const nlohmann::ordered_json& json);

}  // namespace terracut::sight_measures
