// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "calib/sensor/sensor_model.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::sensor {

/// What sent a UDP payload. Judged by size, magic numbers and block structure, never by port; never
/// reads outside `payload`. On Velodyne's 1206 bytes the product number is believed only when the
/// block order is not that of an HDL-64E, whose last bytes are its status stream. Allocates
/// nothing.
[[nodiscard]] SensorModel recognise_sensor(std::span<const std::uint8_t> payload) noexcept
    TERRACUT_NONBLOCKING;

/// The same where somebody knows that the sensor is a `named` one: so are Velodyne's data packets
/// with a product number not known here, which simulators, old firmware and the VLP-32A send, if
/// their blocks are such a model's.
[[nodiscard]] SensorModel recognise_sensor_as(std::optional<SensorModel> named,
                                              std::span<const std::uint8_t> payload) noexcept
    TERRACUT_NONBLOCKING;

/// What else the payload says of the model, for people: product number and return mode of a
/// Velodyne, type bytes of a RoboSense and what documents say they mean. Empty when nothing.
[[nodiscard]] std::string describe_sensor_hints(std::span<const std::uint8_t> payload);

}  // namespace terracut::sensor
