// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/live/device_stamp_shift.hpp"

#include <algorithm>
#include <cstddef>

#include "firmware_io/capture/sensor_model.hpp"
#include "firmware_io/hdl64e/wire.hpp"

namespace terracut::firmware_io {
namespace {

constexpr std::int64_t rounded_us(std::int64_t time_ns) noexcept {
  return time_ns >= 0 ? (time_ns + 500) / 1000 : -((-time_ns + 500) / 1000);
}

void shift_hdl64e(std::span<std::uint8_t> payload, std::int64_t shift_us,
                  const Hdl64ePacketView& packet) noexcept {
  constexpr std::int64_t kHour_us = kDeviceHour_us;
  const std::int64_t shifted_us = (std::int64_t{packet.stamp_us()} + shift_us) % kHour_us;
  const auto stamp_us =
      static_cast<std::uint32_t>(shifted_us < 0 ? shifted_us + kHour_us : shifted_us);
  const wire::U32 bytes = wire::U32::of(stamp_us);
  std::copy(bytes.bytes.begin(), bytes.bytes.end(),
            payload.begin() + offsetof(wire::Packet, stamp_us));
}

}  // namespace

bool shift_device_stamp(std::span<std::uint8_t> payload, std::int64_t shift_ns) noexcept {
  if (recognise_sensor(payload) != SensorModel::kHdl64e) return false;
  const auto packet = Hdl64ePacketView::of(payload);
  if (!packet) return false;
  shift_hdl64e(payload, rounded_us(shift_ns), *packet);
  return true;
}

}  // namespace terracut::firmware_io
