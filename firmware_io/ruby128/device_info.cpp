// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/device_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

namespace terracut::ruby128 {
namespace {

std::string printable_sentence(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    if (byte == 0 || byte == 0xFF) break;
    const bool line_end = byte == '\r' || byte == '\n';
    const bool printable = (byte >= ' ' && byte <= '~') || line_end;
    text += printable ? static_cast<char>(byte) : '?';
  }
  text.resize(text.find_last_not_of(" \r\n") + 1);
  // A line end within the sentence would let the sender write lines of its own into a log.
  std::replace_if(text.begin(), text.end(), [](char c) { return c == '\r' || c == '\n'; }, '?');
  return text;
}

}  // namespace

Ruby128DeviceInfo device_info_of(const ruby128_wire::Difop& difop) {
  Ruby128DeviceInfo info;
  info.rpm_set = difop.rpm_set.value();
  info.rpm_actual = difop.rpm_actual.value();
  info.device_address = difop.device_address;
  info.destination_address = difop.destination_address;
  info.mac = difop.mac;
  info.data_port = difop.data_port.value();
  info.device_port = difop.device_port.value();
  info.fov_start_cdeg = difop.fov_start_cdeg.value();
  info.fov_end_cdeg = difop.fov_end_cdeg.value();
  info.phase_lock_raw = difop.phase_lock.value();
  info.top_firmware = difop.top_firmware;
  info.bottom_firmware = difop.bottom_firmware;
  info.bottom_software = difop.bottom_software;
  info.motor_firmware = difop.motor_firmware;
  info.hardware = difop.hardware;
  info.serial = difop.serial;
  info.zero_angle_raw = difop.zero_angle.value();
  info.return_mode_raw = difop.return_mode;
  info.sync_mode_raw = difop.sync_mode;
  info.sync_status_raw = difop.sync_status;
  info.stamp = difop.stamp;
  info.gps_status_raw = difop.gps_status;
  std::transform(difop.temperatures.begin(), difop.temperatures.end(),
                 info.temperatures_raw.begin(),
                 [](const decode::Be16& field) { return field.value(); });
  info.gprmc = printable_sentence(difop.gprmc);
  return info;
}

void set_device_info(ruby128_wire::Difop& difop, const Ruby128DeviceInfo& info) noexcept {
  difop.rpm_set = decode::Be16::of(info.rpm_set);
  difop.rpm_actual = decode::Be16::of(info.rpm_actual);
  difop.device_address = info.device_address;
  difop.destination_address = info.destination_address;
  difop.mac = info.mac;
  difop.data_port = decode::Be16::of(info.data_port);
  difop.device_port = decode::Be16::of(info.device_port);
  difop.fov_start_cdeg = decode::Be16::of(info.fov_start_cdeg);
  difop.fov_end_cdeg = decode::Be16::of(info.fov_end_cdeg);
  difop.phase_lock = decode::Be16::of(info.phase_lock_raw);
  difop.top_firmware = info.top_firmware;
  difop.bottom_firmware = info.bottom_firmware;
  difop.bottom_software = info.bottom_software;
  difop.motor_firmware = info.motor_firmware;
  difop.hardware = info.hardware;
  difop.serial = info.serial;
  difop.zero_angle = decode::Be16::of(info.zero_angle_raw);
  difop.return_mode = info.return_mode_raw;
  difop.sync_mode = info.sync_mode_raw;
  difop.sync_status = info.sync_status_raw;
  difop.stamp = info.stamp;
  difop.gps_status = info.gps_status_raw;
  std::transform(info.temperatures_raw.begin(), info.temperatures_raw.end(),
                 difop.temperatures.begin(),
                 [](std::uint16_t raw) { return decode::Be16::of(raw); });
  difop.gprmc = {};
  std::copy_n(info.gprmc.begin(), std::min(info.gprmc.size(), difop.gprmc.size()),
              difop.gprmc.begin());
}

std::string_view sync_mode_name(std::uint8_t sync_mode_raw) noexcept {
  constexpr std::array<std::string_view, 4> kNames{"GPS", "PTP E2E", "PTP P2P", "gPTP"};
  return sync_mode_raw < kNames.size() ? kNames[sync_mode_raw] : "unknown";
}

std::string address_text(const std::array<std::uint8_t, 4>& address) {
  return fmt::format("{}", fmt::join(address, "."));
}

std::string hex_text(std::span<const std::uint8_t> bytes, std::string_view separator) {
  return fmt::format("{:02x}", fmt::join(bytes.begin(), bytes.end(), separator));
}

}  // namespace terracut::ruby128
