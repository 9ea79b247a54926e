// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "calib/ruby128/ruby128_calibration.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/packet/wire_integer.hpp"
#include "rt/threads/nonblocking.hpp"

/// The device packet (DIFOP) of the RS-Ruby128 as sent in the UDP payload, about once a second; big
/// endian (RS-Ruby user manual; a public decoder of the maker; docs/reference/sensors.md). Nothing
/// here allocates or throws.
namespace terracut::ruby128 {

inline constexpr std::array<std::uint8_t, 8> kDifopMagic{0xA5, 0xFF, 0x00, 0x5A,
                                                         0x11, 0x11, 0x55, 0x55};
inline constexpr std::array<std::uint8_t, 2> kDifopTail{0x0F, 0xF0};

/// Values of an angle's sign byte. Units without a stored calibration send kUnset.
inline constexpr std::uint8_t kDifopPlus = 0, kDifopMinus = 1, kDifopUnset = 0xFF;

namespace ruby128_wire {

struct Angle {
  std::uint8_t sign;
  packet::Be16 magnitude;  ///< Hundredths of a degree; of an RS-LiDAR-32 thousandths.
};

/// The fields of the packet. Fields that sources describe differently are marked reserved here; for
/// other fields that terracut does not read, units and meanings are partly unknown.
struct Difop {
  std::array<std::uint8_t, 8> magic;
  packet::Be16 rpm_set;
  std::array<std::uint8_t, 4> device_address, destination_address;
  std::array<std::uint8_t, 6> mac;
  packet::Be16 data_port, reserved1;
  packet::Be16 device_port, reserved2;
  packet::Be16 fov_start_cdeg, fov_end_cdeg;
  packet::Be16 reserved3;
  packet::Be16 phase_lock;
  std::array<std::uint8_t, 5> top_firmware, bottom_firmware, bottom_software, motor_firmware;
  std::array<std::uint8_t, 3> hardware;
  std::array<std::uint8_t, 229> reserved4;
  std::array<std::uint8_t, 6> serial;
  packet::Be16 zero_angle;
  std::uint8_t return_mode;  ///< 3 is dual; sources disagree about the single modes.
  std::uint8_t sync_mode;    ///< See sync_mode_name().
  std::uint8_t sync_status;
  std::array<std::uint8_t, 10> stamp;  ///< Encoded as in the data packet (timestamp.hpp).
  std::array<std::uint8_t, 24> currents_and_voltages;
  std::array<std::uint8_t, 20> reserved5;
  std::uint8_t gps_status;
  std::array<packet::Be16, 5> temperatures;
  std::array<std::uint8_t, 5> reserved6;
  packet::Be16 rpm_actual;
  std::array<std::uint8_t, 7> reserved7;
  std::array<std::uint8_t, 86> gprmc;
  std::array<Angle, kRuby128Lasers> elevations;  ///< Indexed by channel.
  std::array<Angle, kRuby128Lasers> azimuth_offsets;
  std::array<std::uint8_t, 10> reserved8;
  std::array<std::uint8_t, 2> tail;
};

static_assert(sizeof(Angle) == 3 && alignof(Angle) == 1);
static_assert(sizeof(Difop) == kRubyPacketBytes && alignof(Difop) == 1);
static_assert(offsetof(Difop, rpm_set) == 8 && offsetof(Difop, device_address) == 10);
static_assert(offsetof(Difop, destination_address) == 14 && offsetof(Difop, mac) == 18);
static_assert(offsetof(Difop, data_port) == 24 && offsetof(Difop, device_port) == 28);
static_assert(offsetof(Difop, fov_start_cdeg) == 32 && offsetof(Difop, fov_end_cdeg) == 34);
static_assert(offsetof(Difop, phase_lock) == 38 && offsetof(Difop, top_firmware) == 40);
static_assert(offsetof(Difop, bottom_firmware) == 45 && offsetof(Difop, bottom_software) == 50);
static_assert(offsetof(Difop, motor_firmware) == 55 && offsetof(Difop, hardware) == 60);
static_assert(offsetof(Difop, serial) == 292 && offsetof(Difop, zero_angle) == 298);
static_assert(offsetof(Difop, return_mode) == 300 && offsetof(Difop, sync_mode) == 301);
static_assert(offsetof(Difop, sync_status) == 302 && offsetof(Difop, stamp) == 303);
static_assert(offsetof(Difop, currents_and_voltages) == 313 && offsetof(Difop, reserved5) == 337);
static_assert(offsetof(Difop, gps_status) == 357 && offsetof(Difop, temperatures) == 358);
static_assert(offsetof(Difop, rpm_actual) == 373 && offsetof(Difop, gprmc) == 382);
static_assert(offsetof(Difop, elevations) == 468 && offsetof(Difop, azimuth_offsets) == 852);
static_assert(offsetof(Difop, tail) == 1246);
static_assert(std::is_trivially_copyable_v<Difop> && std::is_standard_layout_v<Difop>);

}  // namespace ruby128_wire

/// True if the payload has the length and the first eight bytes of a DIFOP packet. The Ruby Lite
/// and the Ruby Plus send the same. The last bytes are not checked, because no known program relies
/// on them.
[[nodiscard]] bool is_difop(std::span<const std::uint8_t> payload) noexcept TERRACUT_NONBLOCKING;

/// Returns a copy of the payload as a packet; nothing unless is_difop().
[[nodiscard]] std::optional<ruby128_wire::Difop> read_difop(
    std::span<const std::uint8_t> payload) noexcept;

/// Returns a packet to fill in. Magic and tail are set, all angles are marked unset, other bytes
/// are 0.
[[nodiscard]] ruby128_wire::Difop blank_difop() noexcept;

/// Returns a view of `difop` as the payload to send. The view shows later changes and is valid as
/// long as `difop` exists.
[[nodiscard]] std::span<const std::uint8_t, kRubyPacketBytes> payload_of(
    const ruby128_wire::Difop& difop) noexcept;
std::span<const std::uint8_t, kRubyPacketBytes> payload_of(ruby128_wire::Difop&&) = delete;

/// Returns "GPS", "PTP E2E", "PTP P2P", "gPTP", or "unknown".
[[nodiscard]] std::string_view sync_mode_name(std::uint8_t sync_mode) noexcept;

}  // namespace terracut::ruby128
