// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ouster/packet_reader.hpp"

#include <algorithm>

#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/packet/sensor_recognition.hpp"
#include "rt/vector_clones.hpp"

namespace terracut::ouster {

std::optional<frame::Reject> read_packet(const Mode& mode, std::span<const std::uint8_t> payload,
                                         packet::PacketAzimuths& azimuths) noexcept {
  const PacketFormat& format = mode.format;
  if (payload.size() == kImuBytes) return frame::Reject::kDeviceInfo;
  const std::optional<PacketHead> head = head_of(format, payload);
  if (!head) {
    const bool has_size = payload.size() == format.packet_bytes();
    const bool is_another =
        !has_size && sensor::recognise_sensor(payload) != sensor::SensorModel::kUnknown;
    if (is_another) return frame::Reject::kWrongModel;
    return has_size ? frame::Reject::kWrongMagic : frame::Reject::kWrongSize;
  }
  const int returns = format.is_dual() ? 2 : 1;
  const std::int32_t column_ns = mode.column_ns();
  azimuths.columns = format.columns * returns;
  azimuths.behind_sector = 0;
  azimuths.dual_return = returns == 2;
  azimuths.device_stamp_us =
      static_cast<std::int64_t>((head->stamp_ns - static_cast<std::uint64_t>(head->stamped_column) *
                                                      static_cast<std::uint64_t>(column_ns)) /
                                1000 % static_cast<std::uint64_t>(kClockWrap_us));
  if (head->first_measurement + format.columns > mode.columns_per_frame) {
    return frame::Reject::kAzimuthOutOfRange;
  }
  for (int column = 0; column < azimuths.columns; ++column) {
    const int measurement = head->first_measurement + column / returns;
    azimuths.azimuth_cdeg[static_cast<std::size_t>(column)] =
        measurement_ticks(measurement, mode.columns_per_frame) / packet::kTicksPerCdeg;
  }
  azimuths.step_ticks = packet::kRevolution_ticks / mode.columns_per_frame;
  azimuths.pace_ticks = azimuths.sweep_ticks = azimuths.widest_ticks = static_cast<std::int32_t>(
      std::int64_t{packet::kRevolution_ticks} * format.columns / mode.columns_per_frame);
  azimuths.nominal_period_ns = column_ns * format.columns;
  const std::int32_t tolerance_ns = azimuths.nominal_period_ns / packet::kPeriodTolerance;
  azimuths.shortest_period_ns = azimuths.nominal_period_ns - tolerance_ns;
  azimuths.longest_period_ns = azimuths.nominal_period_ns + tolerance_ns;
  return std::nullopt;
}

void read_returns(const PacketFormat& format, const std::uint8_t* packet, std::size_t column,
                  std::span<std::uint16_t> raw, std::span<std::uint8_t> fine,
                  std::span<std::uint8_t> intensity) noexcept {
  const ProfileRow& row = row_of(format.profile);
  const int returns = format.is_dual() ? 2 : 1;
  const int in_packet = static_cast<int>(column) / returns;
  const bool is_second = static_cast<int>(column) % returns == 1;
  if (!format.head(packet, in_packet).is_valid) {
    std::ranges::fill(raw, std::uint16_t{0});
    std::ranges::fill(fine, std::uint8_t{0});
    std::ranges::fill(intensity, std::uint8_t{0});
    return;
  }
  const std::uint32_t mask = (1U << row.range_bits) - 1;
  const auto count_mm = static_cast<std::uint32_t>(row.range_mm);
  const std::uint8_t* at = packet + format.channels_at(in_packet) + (is_second ? row.second_at : 0);
  for (std::size_t i = 0; i < raw.size(); ++i, at += row.channel_bytes) {
    constexpr auto kFine = static_cast<std::uint32_t>(frame::kFinePerCount);
    const std::uint32_t range_mm = (little_endian<std::uint32_t>(at) & mask) * count_mm;
    const std::uint32_t counts = (range_mm + kFine - 1) / kFine;
    raw[i] = static_cast<std::uint16_t>(counts);
    fine[i] = static_cast<std::uint8_t>(counts * kFine - range_mm);
    intensity[i] = at[row.reflectivity_at];
  }
}

}  // namespace terracut::ouster
