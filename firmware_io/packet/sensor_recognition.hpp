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

/// Returns which sensor sent a UDP payload, judged by size, magic numbers and block structure,
/// never by port; never reads outside `payload`. In Velodyne's packets of 1206 bytes the product
/// number is believed only if the block order is not that of an HDL-64E, whose last bytes are its
/// status stream. Allocates nothing.
[[nodiscard]] SensorModel recognise_sensor(std::span<const std::uint8_t> payload) noexcept
    TERRACUT_NONBLOCKING;

/// Returns which sensor sent a payload, as recognise_sensor() does, when the user has named the
/// model. Simulators, old firmware and the VLP-32A send Velodyne's data packets with product
/// numbers not known here; these count as the named model's if their blocks fit it. So do an
/// Ouster's packets, some of which may be of several numbers of rows, and those of a Hesai's size
/// with another version.
[[nodiscard]] SensorModel recognise_sensor_as(std::optional<SensorModel> named,
                                              std::span<const std::uint8_t> payload) noexcept
    TERRACUT_NONBLOCKING;

/// Returns, for people, what else the payload says about the model: product number and return mode
/// of a Velodyne, type bytes or blocks of a RoboSense with what they mean, profile of an Ouster.
/// Empty if it says nothing.
[[nodiscard]] std::string describe_sensor_hints(std::span<const std::uint8_t> payload);

}  // namespace terracut::sensor
