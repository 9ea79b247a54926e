// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "velodyne_reference.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace terracut::reference {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
/// 2026-01-01 00:59:59.9 UTC, so that the device's hour ends in the stream.
constexpr std::int64_t kStart_ns = 1'767'229'199'900'000'000;
constexpr int kBlocks = 12, kBlockBytes = 100, kReturnsABlock = 32;

int little_endian(std::span<const std::uint8_t> payload, std::size_t at) {
  return payload[at] + 256 * payload[at + 1];
}

void put(Bytes& bytes, std::size_t at, std::uint64_t value, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) bytes[at + i] = (value >> (8 * i)) & 0xFF;
}

std::size_t block_at(int block) {
  return static_cast<std::size_t>(kBlockBytes * block);
}
/// Firing `column`, laser: its three bytes.
std::size_t return_at(const VelodyneSheet& sheet, int column, int laser) {
  const int in_block = column % sheet.firings_a_block * sheet.lasers + laser;
  return block_at(column / sheet.firings_a_block) + static_cast<std::size_t>(4 + 3 * in_block);
}

constexpr std::array kSheets{VelodyneSheet{.model = velodyne::VelodyneModel::kVlp16,
                                           .product = 0x22,
                                           .lasers = 16,
                                           .metres_per_count = 0.002,
                                           .firing_us = 55.296,
                                           .step_us = 2.304,
                                           .firings_a_block = 2}};

/// The azimuths of the blocks, or why there are none.
Refusal read_azimuths(const VelodyneSheet& sheet, std::span<const std::uint8_t> payload,
                      std::array<int, kBlocks>& block_cdeg) {
  if (payload.size() != 1206) return Refusal::kOtherPacket;
  for (int block = 0; block < kBlocks; ++block) {
    if (little_endian(payload, block_at(block)) != 0xEEFF) return Refusal::kOtherPacket;
  }
  const int mode = payload[1204];
  if (payload[1205] != sheet.product || mode < 0x37 || mode > 0x39) return Refusal::kOtherPacket;
  bool in_range = true, pairs_agree = true;
  for (int block = 0; block < kBlocks; ++block) {
    const auto b = static_cast<std::size_t>(block);
    block_cdeg[b] = little_endian(payload, block_at(block) + 2);
    in_range &= block_cdeg[b] <= 35'999;
    pairs_agree &= mode != 0x39 || block % 2 == 0 || block_cdeg[b] == block_cdeg[b - 1];
  }
  if (!in_range) return Refusal::kAzimuthRange;
  return pairs_agree ? Refusal::kNone : Refusal::kUnequalFirings;
}

}  // namespace

const VelodyneSheet& sheet_of(velodyne::VelodyneModel model) {
  for (const VelodyneSheet& sheet : kSheets) {
    if (sheet.model == model) return sheet;
  }
  return kSheets.front();
}

Packet VelodyneReference::decode(std::span<const std::uint8_t> payload) const {
  Packet packet;
  std::array<int, kBlocks> block_cdeg{};
  packet.refusal = read_azimuths(sheet_, payload, block_cdeg);
  if (packet.refusal != Refusal::kNone) return packet;
  packet.dual_return = payload[1204] == 0x39;
  const int firings = packet.dual_return ? kBlocks / 2 : kBlocks;  // with an azimuth of their own
  const double block_us = sheet_.firing_us * sheet_.firings_a_block;
  const RotorLimits limits{.forwards_cdeg = static_cast<int>(36'000 * 30 * block_us * 1e-6) + 1,
                           .backwards_cdeg = 5,
                           .least_sweep_cdeg = 2 * (firings - 1),
                           .standing_back_cdeg = 6};
  packet.refusal = judge_rotation(block_cdeg, limits);
  if (packet.refusal != Refusal::kNone) return packet;

  packet.columns = kBlocks * sheet_.firings_a_block;
  packet.first_deg = block_cdeg[0] / 100.0;
  const double advance_deg = clockwise_cdeg(block_cdeg[0], block_cdeg[kBlocks - 1]) / 100.0;
  packet.step_deg = advance_deg / (firings - 1);
  for (int column = 0; column < packet.columns; ++column) {
    const int block = column / sheet_.firings_a_block;
    const double block_deg =
        packet.first_deg +
        clockwise_cdeg(block_cdeg[0], block_cdeg[static_cast<std::size_t>(block)]) / 100.0;
    for (int laser = 0; laser < sheet_.lasers; ++laser) {
      const std::size_t at = return_at(sheet_, column, laser);
      Return beam;
      beam.column = column;
      beam.laser = laser;
      beam.raw_distance = little_endian(payload, at);
      beam.intensity = payload[at + 2];
      if (beam.raw_distance == 0) continue;
      const double in_block_us =
          column % sheet_.firings_a_block * sheet_.firing_us + sheet_.fired_us(laser);
      beam.fired_us = block / (packet.dual_return ? 2 : 1) * block_us + in_block_us;
      beam.rotor_deg = block_deg + packet.step_deg * in_block_us / block_us;
      const velodyne::VelodyneLaser& unit = table_.lasers[static_cast<std::size_t>(laser)];
      beam.beam_deg = beam.rotor_deg + unit.azimuth_offset_rad / kRadPerDeg;
      const double azimuth = beam.beam_deg * kRadPerDeg;
      const double d = beam.raw_distance * sheet_.metres_per_count;
      beam.x_m = d * std::cos(unit.elevation_rad) * std::cos(azimuth);
      beam.y_m = -d * std::cos(unit.elevation_rad) * std::sin(azimuth);
      beam.z_m = d * std::sin(unit.elevation_rad) + unit.vert_offset_m;
      packet.returns.push_back(beam);
    }
  }
  return packet;
}

std::vector<Payload> velodyne_payloads(const VelodyneSheet& sheet, const RotatingHead& head) {
  std::mt19937 random(head.seed);
  std::bernoulli_distribution measured(head.share_of_returns);
  std::uniform_int_distribution<unsigned> distance(1, 65'535), intensity(0, 255);
  const double block_us = sheet.firing_us * sheet.firings_a_block;
  const int blocks_per_packet = head.dual_return ? kBlocks / 2 : kBlocks;
  std::vector<Payload> payloads(static_cast<std::size_t>(head.packets));
  for (std::size_t n = 0; n < payloads.size(); ++n) {
    Bytes& bytes = payloads[n].bytes;
    bytes.resize(1206);
    const double first_us = static_cast<double>(n) * blocks_per_packet * block_us;
    for (int block = 0; block < kBlocks; ++block) {
      const double fired_us = first_us + block_us * (head.dual_return ? block / 2 : block);
      const double head_deg = head.first_deg + 360.0 * head.spin_hz * fired_us * 1e-6;
      put(bytes, block_at(block), 0xEEFF, 2);
      put(bytes, block_at(block) + 2,
          static_cast<std::uint64_t>(std::llround(head_deg * 100.0) % 36'000), 2);
      for (int one = 0; one < kReturnsABlock; ++one) {
        if (!measured(random)) continue;
        const std::size_t at = block_at(block) + static_cast<std::size_t>(4 + 3 * one);
        put(bytes, at, distance(random), 2);
        put(bytes, at + 2, intensity(random), 1);
      }
    }
    payloads[n].stamp_ns = kStart_ns + std::llround(first_us * 1e3);
    set_velodyne_clock(bytes, payloads[n].stamp_ns);
    bytes[1204] = head.dual_return ? 0x39 : 0x37;
    bytes[1205] = static_cast<std::uint8_t>(sheet.product);
  }
  return payloads;
}

void set_velodyne_azimuth(const VelodyneSheet& sheet, Bytes& payload, int column, unsigned cdeg) {
  if (column % sheet.firings_a_block != 0) return;
  put(payload, block_at(column / sheet.firings_a_block) + 2, cdeg, 2);
}

void set_velodyne_return(const VelodyneSheet& sheet, Bytes& payload, int column, int laser,
                         unsigned raw, unsigned intensity) {
  put(payload, return_at(sheet, column, laser), raw, 2);
  put(payload, return_at(sheet, column, laser) + 2, intensity, 1);
}

void set_velodyne_clock(Bytes& payload, std::int64_t time_ns) {
  put(payload, 1200, static_cast<std::uint64_t>(time_ns / 1'000 % 3'600'000'000), 4);
}

velodyne::VelodyneCalibration random_velodyne(velodyne::VelodyneModel model, std::mt19937& random) {
  const auto off = [&](double most) {
    return std::uniform_real_distribution<double>(-most, most)(random);
  };
  velodyne::VelodyneCalibration table = velodyne::factory_table(model);
  table.origin = "any unit";
  for (velodyne::VelodyneLaser& laser : table.lasers) {
    laser.elevation_rad += off(0.02) * kRadPerDeg;
    laser.azimuth_offset_rad += off(1) * kRadPerDeg;
    laser.vert_offset_m += off(0.01);
  }
  return table;
}

}  // namespace terracut::reference
