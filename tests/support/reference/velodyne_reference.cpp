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
bool is_dual(std::span<const std::uint8_t> payload) {
  return payload[1204] == 0x39;
}

/// The block that holds a laser of firing `column`; in dual return both of a pair count.
int block_of(const VelodyneSheet& sheet, int column, int laser, bool dual_return) {
  if (sheet.firings_a_block > 1) return column / sheet.firings_a_block;
  const int part = laser / kReturnsABlock;
  if (dual_return) return 2 * (column / 2 * sheet.blocks_a_firing + part) + column % 2;
  return column * sheet.blocks_a_firing + part;
}
/// Its three bytes.
std::size_t return_at(const VelodyneSheet& sheet, int column, int laser, bool dual_return) {
  const int in_block = sheet.firings_a_block > 1
                           ? column % sheet.firings_a_block * sheet.lasers + laser
                           : laser % kReturnsABlock;
  return block_at(block_of(sheet, column, laser, dual_return)) +
         static_cast<std::size_t>(4 + 3 * in_block);
}

/// Firings of all lasers in a packet; in dual return both of a pair count.
int columns_of(const VelodyneSheet& sheet, bool dual_return) {
  // Eight blocks are one firing with both returns, and four are left empty.
  if (sheet.blocks_a_firing == 4 && dual_return) return 2;
  return kBlocks * sheet.firings_a_block / sheet.blocks_a_firing;
}

constexpr std::array<int, 4> kIds{0xEEFF, 0xDDFF, 0xCCFF, 0xBBFF};

constexpr std::array kSheets{VelodyneSheet{.model = sensor::SensorModel::kVlp16,
                                           .product = 0x22,
                                           .lasers = 16,
                                           .metres_per_count = 0.002,
                                           .firing_us = 55.296,
                                           .step_us = 2.304,
                                           .firings_a_block = 2},
                             VelodyneSheet{.model = sensor::SensorModel::kHdl32e,
                                           .product = 0x21,
                                           .lasers = 32,
                                           .metres_per_count = 0.002,
                                           .firing_us = 46.08,
                                           .step_us = 1.152},
                             VelodyneSheet{.model = sensor::SensorModel::kVlp32c,
                                           .product = 0x28,
                                           .lasers = 32,
                                           .metres_per_count = 0.004,
                                           .firing_us = 55.296,
                                           .step_us = 2.304,
                                           .together = 2},
                             VelodyneSheet{.model = sensor::SensorModel::kVls128,
                                           .product = 0xA1,
                                           .lasers = 128,
                                           .metres_per_count = 0.004,
                                           .firing_us = 55.26,
                                           .step_us = 2.763,
                                           .together = 8,
                                           .blocks_a_firing = 4,
                                           .pause_after = 8}};

/// The azimuths of the firings that have one of their own, or why there are none.
Refusal read_azimuths(const VelodyneSheet& sheet, std::span<const std::uint8_t> payload,
                      std::vector<int>& firing_cdeg) {
  if (payload.size() != 1206) return Refusal::kOtherPacket;
  const int mode = payload[1204];
  const bool dual_return = is_dual(payload);
  const int columns = columns_of(sheet, dual_return);
  // The VLS-128 is told by its blocks.
  if (sheet.blocks_a_firing == 1 && payload[1205] != sheet.product) return Refusal::kOtherPacket;
  if (mode < 0x37 || mode > 0x39) return Refusal::kOtherPacket;
  bool in_range = true, agree = true;
  for (int column = 0; column < columns; column += sheet.firings_a_block) {
    for (int laser = 0; laser < sheet.blocks_a_firing * kReturnsABlock; laser += kReturnsABlock) {
      const std::size_t at = block_at(block_of(sheet, column, laser, dual_return));
      const auto part = static_cast<std::size_t>(laser / kReturnsABlock);
      if (little_endian(payload, at) != kIds[part]) return Refusal::kOtherPacket;
      const int cdeg = little_endian(payload, at + 2);
      in_range &= cdeg <= 35'999;
      if (part == 0) firing_cdeg.push_back(cdeg);
      agree &= cdeg == firing_cdeg.back();
    }
    const bool is_second = dual_return && column / sheet.firings_a_block % 2 == 1;
    agree &= !is_second || firing_cdeg.back() == firing_cdeg[firing_cdeg.size() - 2];
  }
  if (!in_range) return Refusal::kAzimuthRange;
  return agree ? Refusal::kNone : Refusal::kUnequalFirings;
}

}  // namespace

const VelodyneSheet& sheet_of(sensor::SensorModel model) {
  for (const VelodyneSheet& sheet : kSheets) {
    if (sheet.model == model) return sheet;
  }
  return kSheets.front();
}

Packet VelodyneReference::decode(std::span<const std::uint8_t> payload, bool across_sector) {
  Packet packet;
  std::vector<int> cdeg;
  packet.refusal = read_azimuths(sheet_, payload, cdeg);
  if (packet.refusal != Refusal::kNone) return packet;
  packet.dual_return = is_dual(payload);
  const int firings = static_cast<int>(cdeg.size()) / (packet.dual_return ? 2 : 1);
  const double column_us = sheet_.firing_us * sheet_.firings_a_block;
  const int most_cdeg = static_cast<int>(36'000 * 30 * column_us * 1e-6) + 1;
  const double stamp_us = little_endian(payload, 1200) + 65'536.0 * little_endian(payload, 1202);
  if (across_sector) {
    packet.step_deg = last_step_deg_;
  } else if (firings > 1) {
    packet.refusal = judge_rotation(cdeg, {.forwards_cdeg = most_cdeg,
                                           .backwards_cdeg = 5,
                                           .least_sweep_cdeg = 2 * (firings - 1),
                                           .standing_back_cdeg = 6});
    packet.step_deg = clockwise_cdeg(cdeg.front(), cdeg.back()) / 100.0 / (firings - 1);
  } else {
    const int way_cdeg = clockwise_cdeg(last_cdeg_, cdeg.front());
    constexpr double kHour_us = 3.6e9;
    const double since_us = std::fmod(stamp_us - last_us_ + kHour_us, kHour_us);
    const bool follows = last_us_ >= 0 && since_us > 0 && since_us < 1.5 * column_us;
    const double usual_deg = last_step_deg_ > 0 ? last_step_deg_ : 3'600 * column_us * 1e-6;
    packet.step_deg = follows && way_cdeg <= most_cdeg ? way_cdeg / 100.0 : usual_deg;
    if (packet.step_deg < 0.02) packet.refusal = Refusal::kNotRotating;
  }
  last_cdeg_ = cdeg.front();
  last_us_ = stamp_us;
  if (packet.refusal != Refusal::kNone) return packet;
  last_step_deg_ = packet.step_deg;

  packet.columns = columns_of(sheet_, packet.dual_return);
  packet.first_deg = cdeg[0] / 100.0;
  for (int column = 0; column < packet.columns; ++column) {
    const int reading = column / sheet_.firings_a_block;
    double advance_deg = clockwise_cdeg(cdeg[0], cdeg[static_cast<std::size_t>(reading)]) / 100.0;
    if (across_sector && advance_deg < -1) advance_deg += 360;
    const double reading_deg = packet.first_deg + advance_deg;
    for (int laser = 0; laser < sheet_.lasers; ++laser) {
      const std::size_t at = return_at(sheet_, column, laser, packet.dual_return);
      Return beam;
      beam.column = column;
      beam.laser = laser;
      beam.raw_distance = little_endian(payload, at);
      beam.intensity = payload[at + 2];
      if (beam.raw_distance == 0) continue;
      const double since_us =
          column % sheet_.firings_a_block * sheet_.firing_us + sheet_.fired_us(laser);
      beam.fired_us = reading / (packet.dual_return ? 2 : 1) * column_us + since_us;
      beam.rotor_deg = reading_deg + packet.step_deg * since_us / column_us;
      const beams::TableBeam& unit = table_.lasers[static_cast<std::size_t>(laser)];
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
  const int columns = columns_of(sheet, head.dual_return);
  const int firings_per_packet = head.dual_return ? columns / 2 : columns;
  std::vector<Payload> payloads(static_cast<std::size_t>(head.packets));
  for (std::size_t n = 0; n < payloads.size(); ++n) {
    Bytes& bytes = payloads[n].bytes;
    bytes.resize(1206);
    bytes[1204] = head.dual_return ? 0x39 : 0x37;
    bytes[1205] = static_cast<std::uint8_t>(sheet.product);
    const double first_us = static_cast<double>(n) * firings_per_packet * sheet.firing_us;
    for (int column = 0; column < columns; ++column) {
      // A block's two firings are of one return.
      const int reading = column / sheet.firings_a_block;
      const int firing = reading / (head.dual_return ? 2 : 1) * sheet.firings_a_block;
      const double fired_us = first_us + sheet.firing_us * firing;
      const double head_deg = head.first_deg + 360.0 * head.spin_hz * fired_us * 1e-6;
      for (int laser = 0; laser < sheet.blocks_a_firing * kReturnsABlock; laser += kReturnsABlock) {
        put(bytes, block_at(block_of(sheet, column, laser, head.dual_return)),
            static_cast<std::uint64_t>(kIds[static_cast<std::size_t>(laser / kReturnsABlock)]), 2);
      }
      set_velodyne_azimuth(sheet, bytes, column,
                           static_cast<unsigned>(std::llround(head_deg * 100.0) % 36'000));
      for (int laser = 0; laser < sheet.lasers; ++laser) {
        if (!measured(random)) continue;
        const unsigned raw = distance(random);
        set_velodyne_return(sheet, bytes, column, laser, raw, intensity(random));
      }
    }
    payloads[n].stamp_ns = kStart_ns + std::llround(first_us * 1e3);
    set_velodyne_clock(bytes, payloads[n].stamp_ns);
  }
  return payloads;
}

void set_velodyne_azimuth(const VelodyneSheet& sheet, Bytes& payload, int column, unsigned cdeg) {
  if (column % sheet.firings_a_block != 0) return;
  for (int laser = 0; laser < sheet.blocks_a_firing * kReturnsABlock; laser += kReturnsABlock) {
    put(payload, block_at(block_of(sheet, column, laser, is_dual(payload))) + 2, cdeg, 2);
  }
}

void set_velodyne_return(const VelodyneSheet& sheet, Bytes& payload, int column, int laser,
                         unsigned raw, unsigned intensity) {
  const std::size_t at = return_at(sheet, column, laser, is_dual(payload));
  put(payload, at, raw, 2);
  put(payload, at + 2, intensity, 1);
}

void set_velodyne_clock(Bytes& payload, std::int64_t time_ns) {
  put(payload, 1200, static_cast<std::uint64_t>(time_ns / 1'000 % 3'600'000'000), 4);
}

beams::BeamTable random_table(sensor::SensorModel model, std::mt19937& random) {
  const auto off = [&](double most) {
    return std::uniform_real_distribution<double>(-most, most)(random);
  };
  beams::BeamTable table = beams::built_in_table(model);
  table.origin = "any unit";
  for (beams::TableBeam& laser : table.lasers) {
    laser.elevation_rad += off(0.02) * kRadPerDeg;
    laser.azimuth_offset_rad += off(1) * kRadPerDeg;
    laser.vert_offset_m += off(0.01);
  }
  return table;
}

}  // namespace terracut::reference
