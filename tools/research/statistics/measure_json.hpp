// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "tools/lab/quality/quality.hpp"

namespace terracut::statistics {

// Measures as reports store them: a number, or null where the measure is undefined.

[[nodiscard]] nlohmann::ordered_json number_if(bool is_defined, double value);
/// Returns IoU_g; null if there is no ground, neither in truth nor in labels.
[[nodiscard]] nlohmann::ordered_json iou_g(const quality::Quality& quality);
/// Returns Recall_o; null if there is no key obstacle.
[[nodiscard]] nlohmann::ordered_json recall_o(const quality::Quality& quality);
/// Returns the mean of the defined values; null if there are none.
[[nodiscard]] nlohmann::ordered_json mean(const std::vector<nlohmann::ordered_json>& values);

}  // namespace terracut::statistics
