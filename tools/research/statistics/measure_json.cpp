// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "measure_json.hpp"

namespace terracut::statistics {

using Json = nlohmann::ordered_json;

Json number_if(bool is_defined, double value) {
  return is_defined ? Json(value) : Json(nullptr);
}

Json iou_g(const quality::Quality& quality) {
  const bool any =
      quality.ground_as_ground + quality.ground_as_obstacle + quality.obstacle_as_ground > 0;
  return number_if(any, quality.iou_ground());
}

Json recall_o(const quality::Quality& quality) {
  return number_if(quality.key_as_ground + quality.key_as_obstacle > 0,
                   quality.recall_key_obstacles());
}

Json mean(const std::vector<Json>& values) {
  double sum = 0;
  int count = 0;
  for (const Json& value : values) {
    if (value.is_null()) continue;
    sum += value.get<double>();
    ++count;
  }
  return count == 0 ? Json(nullptr) : Json(sum / count);
}

}  // namespace terracut::statistics
