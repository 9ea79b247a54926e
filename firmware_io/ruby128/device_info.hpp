// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "firmware_io/ruby128/difop.hpp"

namespace terracut::ruby128 {

/// What an RS-Ruby128 says of itself in its DIFOP, apart from its angles (difop_angles.hpp). What
/// ends in `_raw` is as sent: sources leave its unit or meaning open (docs/reference/sensors.md).
/// Currents, voltages and fault registers are left out for that reason.
struct Ruby128DeviceInfo {
  std::uint16_t rpm_set = 0, rpm_actual = 0;
  std::array<std::uint8_t, 4> device_address{}, destination_address{};
  std::array<std::uint8_t, 6> mac{};
  std::uint16_t data_port = 0, device_port = 0;  ///< UDP destinations of MSOP and DIFOP.
  std::uint16_t fov_start_cdeg = 0, fov_end_cdeg = 0;
  std::uint16_t phase_lock_raw = 0;
  std::array<std::uint8_t, 5> top_firmware{}, bottom_firmware{}, bottom_software{},
      motor_firmware{};
  std::array<std::uint8_t, 3> hardware{};
  std::array<std::uint8_t, 6> serial{};
  std::uint16_t zero_angle_raw = 0;
  /// 3 is dual return by all sources. They disagree which of the others is which single return.
  std::uint8_t return_mode_raw = 0;
  std::uint8_t sync_mode_raw = 0;  ///< See sync_mode_name().
  std::uint8_t sync_status_raw = 0;
  std::array<std::uint8_t, 10>
      stamp{};  ///< For read_ruby_timestamp(), in the data packets' encoding.
  std::uint8_t gps_status_raw = 0;
  std::array<std::uint16_t, 5> temperatures_raw{};
  /// The GPS receiver's sentence up to the first byte 0 or 0xFF, without line end; bytes that are
  /// not printable ASCII are '?'. At most 86 characters.
  std::string gprmc;

  bool operator==(const Ruby128DeviceInfo&) const = default;
};

/// Allocates (the sentence).
[[nodiscard]] Ruby128DeviceInfo device_info_of(const ruby128_wire::Difop& difop);

/// Puts all facts into the packet; a sentence longer than 86 characters is cut.
void set_device_info(ruby128_wire::Difop& difop, const Ruby128DeviceInfo& info) noexcept;

/// "GPS", "PTP E2E", "PTP P2P", "gPTP", or "unknown".
[[nodiscard]] std::string_view sync_mode_name(std::uint8_t sync_mode_raw) noexcept;

/// "192.168.1.200"
[[nodiscard]] std::string address_text(const std::array<std::uint8_t, 4>& address);
/// Two digits a byte, with `separator` between: "00:1c:23", "0013af".
[[nodiscard]] std::string hex_text(std::span<const std::uint8_t> bytes,
                                   std::string_view separator = "");

}  // namespace terracut::ruby128
