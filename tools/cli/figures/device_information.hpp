// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "firmware_io/sensor/device_reader.hpp"

namespace terracut::cli {

/// Describes a RoboSense by its newest DIFOP packet: text of several lines, and the same as JSON;
/// empty before the first packet. `model` is what the packets do not say.
[[nodiscard]] std::string device_text(const sensor::DeviceReader& device,
                                      sensor::SensorModel model);
[[nodiscard]] nlohmann::ordered_json device_json(const sensor::DeviceReader& device,
                                                 sensor::SensorModel model);

}  // namespace terracut::cli
