// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/velodyne/packet_reader.hpp"

#include "firmware_io/packet/sensor_recognition.hpp"

namespace terracut::velodyne {
namespace {

std::optional<frame::Reject> reject_model(std::span<const std::uint8_t> payload,
                                          sensor::SensorModel expected, bool is_named) noexcept {
  const sensor::SensorModel model =
      is_named ? sensor::recognise_sensor_as(expected, payload) : sensor::recognise_sensor(payload);
  if (model == expected) return std::nullopt;
  if (model == sensor::SensorModel::kVelodynePosition) return frame::Reject::kDeviceInfo;
  if (model != sensor::SensorModel::kUnknown) return frame::Reject::kWrongModel;
  return payload.size() == kPacketBytes ? frame::Reject::kWrongMagic : frame::Reject::kWrongSize;
}

}  // namespace

std::optional<frame::Reject> PacketReader::read(std::span<const std::uint8_t> payload,
                                                packet::PacketAzimuths& azimuths) noexcept {
  if (const auto reason = reject_model(payload, layout_.model, is_named_)) return reason;
  const auto* packet = hdl64e::packet_in(payload);
  if (packet == nullptr) return frame::Reject::kWrongSize;
  if (const auto reason = read_blocks(*packet, azimuths)) return reason;
  const auto reason = judge_steps(azimuths);
  last_ = {azimuths.device_stamp_us, azimuths.first_cdeg(), true};
  if (!reason) complete(azimuths);
  return reason;
}

std::optional<frame::Reject> PacketReader::read_blocks(
    const hdl64e::wire::Packet& packet, packet::PacketAzimuths& azimuths) const noexcept {
  const std::optional<bool> mode = dual_return_of(packet);
  if (!mode) return frame::Reject::kWrongMagic;
  const bool dual_return = *mode;
  const int columns = layout_.columns(dual_return);
  bool ids_right = true, in_range = true, blocks_agree = true;
  for (int column = 0; column < columns; ++column) {
    std::int32_t& azimuth_cdeg = azimuths.azimuth_cdeg[static_cast<std::size_t>(column)];
    for (int part = 0; part < layout_.blocks_per_column; ++part) {
      const hdl64e::wire::Block& block = packet.blocks[layout_.block(column, part, dual_return)];
      const std::int32_t block_cdeg = block.azimuth_cdeg.value();
      if (part == 0) azimuth_cdeg = block_cdeg;
      ids_right &= block.id.value() == layout_.block_ids[static_cast<std::size_t>(part)];
      in_range &= block_cdeg < beams::kRevolution_cdeg;
      blocks_agree &= block_cdeg == azimuth_cdeg;
    }
    const bool is_second = dual_return && column % 2 == 1;
    blocks_agree &=
        !is_second || azimuth_cdeg == azimuths.azimuth_cdeg[static_cast<std::size_t>(column - 1)];
  }
  if (!ids_right) return frame::Reject::kWrongMagic;
  azimuths.columns = columns;
  azimuths.behind_sector = 0;
  azimuths.dual_return = dual_return;
  azimuths.device_stamp_us = packet.stamp_us.value() % kClockWrap_us;
  if (!in_range) return frame::Reject::kAzimuthOutOfRange;
  return blocks_agree ? std::nullopt : std::optional(frame::Reject::kAzimuthMismatch);
}

std::optional<bool> PacketReader::dual_return_of(
    const hdl64e::wire::Packet& packet) const noexcept {
  const std::uint8_t mode = packet.status_type;
  if (mode == kStrongest || mode == kLast || mode == kDual) return mode == kDual;
  const bool is_known = sensor::recognise_sensor(hdl64e::payload_of(packet)) == layout_.model;
  if (!is_named_ || is_known) return std::nullopt;
  const auto azimuth = [&](std::size_t block) { return packet.blocks[block].azimuth_cdeg.value(); };
  bool are_pairs = true;
  for (std::size_t block = 0; block < packet.blocks.size(); block += 2) {
    are_pairs &= azimuth(block) == azimuth(block + 1);
  }
  return are_pairs;
}

std::optional<frame::Reject> PacketReader::judge_steps(packet::PacketAzimuths& azimuths) noexcept {
  const int most_cdeg = layout_.most_step_cdeg();
  std::int32_t advance_cdeg = 0;
  for (int column = 1; column < azimuths.columns; ++column) {
    const auto c = static_cast<std::size_t>(column);
    const std::int32_t step_cdeg =
        beams::step_cdeg(azimuths.azimuth_cdeg[c - 1], azimuths.azimuth_cdeg[c]);
    advance_cdeg += step_cdeg;
    if (step_cdeg >= -kMaxJitter_cdeg && step_cdeg <= most_cdeg) continue;
    if (azimuths.behind_sector > 0 || step_ticks_ == 0) return frame::Reject::kAzimuthJump;
    azimuths.behind_sector = column;
  }
  if (azimuths.behind_sector > 0) {
    azimuths.step_ticks = step_ticks_;
    return std::nullopt;
  }
  if (advance_cdeg < -kMaxJitter_cdeg) return frame::Reject::kAzimuthJump;
  azimuths.step_ticks = step_of(azimuths, advance_cdeg);
  if (azimuths.step_ticks < kMinStep_cdeg * packet::kTicksPerCdeg) {
    return frame::Reject::kStationary;
  }
  step_ticks_ = azimuths.step_ticks;
  return std::nullopt;
}

/// Returns the step from firing to firing.
std::int32_t PacketReader::step_of(const packet::PacketAzimuths& azimuths,
                                   std::int32_t advance_cdeg) noexcept {
  const int firings = layout_.firings(azimuths.dual_return);
  is_step_guessed_ = false;
  if (firings > 1) return mean_step_ticks(advance_cdeg, firings);
  // A packet of one firing does not show the azimuth step from firing to firing. If no packet was
  // lost before it, the step is the advance of the azimuth since the packet before; else the last
  // known step holds. Before any is known, the step of a sensor at 10 Hz is assumed.
  const std::int64_t since_us =
      packet::clock_step_us(last_.stamp_us, azimuths.device_stamp_us, kClockWrap_us);
  const bool follows =
      last_.is_known && since_us > 0 && since_us * 1000 < layout_.column_ns * 3 / 2;
  if (follows) {
    const std::int32_t step_cdeg = beams::step_cdeg(last_.azimuth_cdeg, azimuths.first_cdeg());
    if (step_cdeg <= layout_.most_step_cdeg()) return step_cdeg * packet::kTicksPerCdeg;
  }
  if (step_ticks_ > 0) return step_ticks_;
  is_step_guessed_ = true;
  return assumed_step_ticks(layout_);
}

void PacketReader::complete(packet::PacketAzimuths& azimuths) const noexcept {
  const std::int32_t firings = layout_.firings(azimuths.dual_return);
  azimuths.pace_ticks = azimuths.widest_ticks = azimuths.step_ticks * firings;
  azimuths.sweep_ticks = azimuths.behind_sector > 0
                             ? azimuths.advance_cdeg(azimuths.columns - 1) * packet::kTicksPerCdeg +
                                   azimuths.step_ticks
                             : azimuths.pace_ticks;
  // While the step is a guess, the sweep is set as wide as it can be; otherwise the gap that a fast
  // head leaves to the next packet would count as a loss.
  if (is_step_guessed_) azimuths.sweep_ticks = layout_.most_step_cdeg() * packet::kTicksPerCdeg;
  azimuths.nominal_period_ns = layout_.column_ns * firings;
  azimuths.shortest_period_ns =
      azimuths.nominal_period_ns - azimuths.nominal_period_ns / packet::kPeriodTolerance;
  azimuths.longest_period_ns =
      azimuths.nominal_period_ns + azimuths.nominal_period_ns / packet::kPeriodTolerance;
}

}  // namespace terracut::velodyne
