// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/send/device_stamp_shift.hpp"

#include <algorithm>
#include <cstddef>

#include "calib/ouster/packet_format.hpp"
#include "firmware_io/hesai/models.hpp"
#include "firmware_io/hesai/stamp.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/packet/sensor_recognition.hpp"
#include "firmware_io/robosense/models.hpp"

namespace terracut::send {
namespace {

constexpr std::int64_t rounded_us(std::int64_t time_ns) noexcept {
  return time_ns >= 0 ? (time_ns + 500) / 1000 : -((-time_ns + 500) / 1000);
}

template <class Bytes>
void write_at(std::span<std::uint8_t> payload, std::size_t offset, const Bytes& bytes) noexcept {
  const auto field = payload.subspan(offset, bytes.size());
  std::copy(bytes.begin(), bytes.end(), field.begin());
}

void shift_velodyne(std::span<std::uint8_t> payload, const hdl64e::wire::Packet& packet,
                    std::int64_t shift_ns) noexcept {
  constexpr std::int64_t kHour_us = hdl64e::kDeviceHour_us;
  const std::int64_t shifted_us =
      (std::int64_t{packet.stamp_us.value()} + rounded_us(shift_ns)) % kHour_us;
  const auto stamp_us =
      static_cast<std::uint32_t>(shifted_us < 0 ? shifted_us + kHour_us : shifted_us);
  write_at(payload, offsetof(hdl64e::wire::Packet, stamp_us), packet::Le32::of(stamp_us).bytes);
}

void shift_robosense(std::span<std::uint8_t, 10> stamp, ruby128::RubyTimestamp encoding,
                     std::int64_t shift_ns) noexcept {
  const std::int64_t unit_ns = encoding == ruby128::RubyTimestamp::kUtcNanoseconds ? 1 : 1000;
  const std::int64_t step_ns = unit_ns == 1 ? shift_ns : rounded_us(shift_ns) * unit_ns;
  const std::int64_t stamp_ns = ruby128::read_ruby_timestamp(stamp, encoding) + step_ns;
  std::ranges::copy(ruby128::write_ruby_timestamp(std::max<std::int64_t>(stamp_ns, 0), encoding),
                    stamp.begin());
}

void shift_ouster(std::span<std::uint8_t> payload, const ouster::PacketFormat& format,
                  std::int64_t shift_ns) noexcept {
  for (int column = 0; column < format.columns; ++column) {
    std::uint64_t stamp_ns =
        format.head(payload.data(), column).stamp_ns + static_cast<std::uint64_t>(shift_ns);
    for (std::size_t byte = 0; byte < sizeof(stamp_ns); ++byte, stamp_ns >>= 8) {
      payload[format.column_at(column) + byte] = static_cast<std::uint8_t>(stamp_ns & 0xFF);
    }
  }
}

}  // namespace

bool DeviceStampShift::operator()(std::span<std::uint8_t> payload, std::int64_t shift_ns) noexcept {
  const sensor::SensorModel model = sensor::recognise_sensor(payload);
  if (model == sensor::SensorModel::kHdl64e || sensor::has_factory_table(model)) {
    const auto* packet = hdl64e::packet_in(payload);
    if (packet == nullptr) return false;
    shift_velodyne(payload, *packet, shift_ns);
    return true;
  }
  if (sensor::is_robosense(model) || model == sensor::SensorModel::kRubyPlus) {
    const bool is_ruby = !robosense::Models::has(model);
    const std::size_t at =
        is_ruby ? offsetof(ruby128::ruby128_wire::Packet, stamp) : robosense::kStampAt;
    const auto stamp = payload.subspan(at).first<robosense::kStampBytes>();
    const ruby128::RubyTimestamp encoding = ruby_encoding_.add(stamp);
    if (shift_ns != 0) shift_robosense(stamp, encoding, shift_ns);
    return true;
  }
  if (hesai::Models::has(model)) {
    const hesai::PacketLayout& layout = hesai::layout_of(model);
    const std::int64_t stamp_us = hesai::read_stamp_us(layout, payload) + rounded_us(shift_ns);
    hesai::write_stamp_us(layout, stamp_us, payload);
    return true;
  }
  if (const auto format = ouster::format_of(payload); sensor::is_ouster(model) && format) {
    shift_ouster(payload, *format, shift_ns);
    return true;
  }
  return false;
}

}  // namespace terracut::send
