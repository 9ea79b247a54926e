// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "firmware_io/vehicle/motion_sample.hpp"
#include "rt/error.hpp"

namespace terracut::drive {

/// Returns the DBC file of the vehicle's CAN bus in simulated and encoded drives. The bus has one
/// message, VEHICLE_MOTION (0x1A0, 8 bytes), with SPEED (km/h, negative backwards) and YAW_RATE
/// (deg/s, positive to the left), each in hundredths in 16 bits, high byte first; its last byte is
/// COUNTER.
[[nodiscard]] std::string vehicle_dbc();
/// Returns a line of a candump log, "(seconds.microseconds) can0 1A0#DATA\n", for each sample.
/// Speeds and yaw rates are clipped to 327.67 km/h or deg/s.
[[nodiscard]] std::string vehicle_log(std::span<const vehicle::MotionSample> samples);

/// These return the files' names beside "<folder>/<name>.pcap": "<name>.can.log", "<name>.can.dbc".
[[nodiscard]] std::filesystem::path can_log_path_of(const std::filesystem::path& pcap_path);
[[nodiscard]] std::filesystem::path can_dbc_path_of(const std::filesystem::path& pcap_path);

/// Writes both files, each whole or not at all. Fails with kWriteFailed. Not real-time safe.
[[nodiscard]] Status write_vehicle_log(const std::filesystem::path& pcap_path,
                                       std::span<const vehicle::MotionSample> samples);

}  // namespace terracut::drive
