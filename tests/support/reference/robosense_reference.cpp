// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "robosense_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace terracut::reference {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr double kRadPerDeg = std::numbers::pi / 180;
constexpr std::int64_t kStart_ns = 1'767'225'600'000'000'000;  // 2026-01-01
constexpr int kBlocks = 12, kLasers = 32;

int big_endian(std::span<const std::uint8_t> bytes, int at) {
  const auto i = static_cast<std::size_t>(at);
  return 256 * bytes[i] + bytes[i + 1];
}
void put(Bytes& bytes, int at, std::uint64_t value, int count) {
  for (int i = count - 1; i >= 0; --i, value /= 256) {
    bytes[static_cast<std::size_t>(at + i)] = static_cast<std::uint8_t>(value % 256);
  }
}
int return_at(int block, int laser) {
  return 42 + 100 * block + 4 + 3 * laser;
}

std::vector<RoboSenseSheet> make_sheets() {
  RoboSenseSheet rs32{.model = sensor::SensorModel::kRs32,
                      .start = {0x55, 0xAA, 0x05, 0x0A, 0x5A, 0xA5, 0x50, 0xA0},
                      .type = 2,
                      .block_us = 55.52,
                      .fired_us = {},
                      .metres = 0.005,
                      .lens_ahead_m = 0.03997,
                      .has_calendar = true,
                      .device_angle_deg = 0.001};
  // The maker's driver lists these; the manual's formula says the same.
  rs32.fired_us = {0.00,  2.88,  5.76,  8.64,  11.52, 14.40, 17.28, 20.16, 23.04, 25.92, 28.80,
                   31.68, 34.56, 37.44, 40.32, 44.64, 1.44,  4.32,  7.20,  10.08, 12.96, 15.84,
                   18.72, 21.60, 24.48, 27.36, 30.24, 33.12, 36.00, 38.88, 41.76, 46.08};
  RoboSenseSheet helios{.model = sensor::SensorModel::kHelios,
                        .start = {0x55, 0xAA, 0x05, 0x5A},
                        .type = 6,
                        .block_us = 55.56,
                        .fired_us = {},
                        .metres = 0.0025,
                        .lens_ahead_m = 0.03498,
                        .device_angle_deg = 0.01};
  helios.fired_us = {0,     1.57,  3.15,  4.72,  6.3,   7.87,  9.45,  11.36, 13.26, 15.17, 17.08,
                     18.99, 20.56, 22.14, 23.71, 25.29, 26.53, 27.77, 29.01, 30.25, 31.49, 32.73,
                     33.98, 35.22, 36.46, 37.7,  38.94, 40.18, 41.42, 42.67, 43.91, 45.15};
  return {rs32, helios};
}

bool is_packet(const RoboSenseSheet& sheet, std::span<const std::uint8_t> payload) {
  if (payload.size() != 1'248) return false;
  for (std::size_t i = 0; i < sheet.start.size(); ++i) {
    if (payload[i] != sheet.start[i]) return false;
  }
  for (int block = 0; block < kBlocks; ++block) {
    if (big_endian(payload, 42 + 100 * block) != 0xFFEE) return false;
  }
  return payload[31] != 6 || payload[32] != 3;  // a Helios-16P
}

}  // namespace

const RoboSenseSheet& robosense_sheet_of(sensor::SensorModel model) {
  static const std::vector<RoboSenseSheet> kSheets = make_sheets();
  return *std::ranges::find(kSheets, model, &RoboSenseSheet::model);
}

Packet RoboSenseReference::decode(std::span<const std::uint8_t> payload) const {
  Packet packet;
  packet.refusal = Refusal::kOtherPacket;
  if (!is_packet(sheet_, payload)) return packet;
  std::vector<int> cdeg;
  for (int block = 0; block < kBlocks; ++block) {
    cdeg.push_back(big_endian(payload, 44 + 100 * block));
  }
  packet.refusal = Refusal::kAzimuthRange;
  if (std::ranges::max(cdeg) > 35'999) return packet;
  packet.dual_return = true;
  for (std::size_t block = 1; block < cdeg.size(); block += 2) {
    packet.dual_return &= cdeg[block] == cdeg[block - 1];
  }
  const int returns = packet.dual_return ? 2 : 1, firings = kBlocks / returns;
  const int most_cdeg = static_cast<int>(36'000 * 30 * sheet_.block_us * 1e-6) + 1;
  packet.refusal = judge_rotation(cdeg, {.forwards_cdeg = most_cdeg,
                                         .backwards_cdeg = 5,
                                         .least_sweep_cdeg = 2 * (firings - 1),
                                         .standing_back_cdeg = 6});
  if (packet.refusal != Refusal::kNone) return packet;
  packet.step_deg = clockwise_cdeg(cdeg.front(), cdeg.back()) / 100.0 / (firings - 1);
  packet.columns = kBlocks;
  packet.first_deg = cdeg[0] / 100.0;
  // By the Helios's manual byte 17 says whether a count is 2.5 mm or, where it is 0, 5 mm.
  const bool is_coarse = sheet_.type == 6 && payload[17] == 0;
  for (int block = 0; block < kBlocks; ++block) {
    const double block_deg =
        packet.first_deg + clockwise_cdeg(cdeg[0], cdeg[static_cast<std::size_t>(block)]) / 100.0;
    for (int laser = 0; laser < kLasers; ++laser) {
      const int at = return_at(block, laser);
      Return beam;
      beam.column = block;
      beam.laser = laser;
      beam.raw_distance = big_endian(payload, at);
      if (is_coarse) beam.raw_distance = 2 * std::min(beam.raw_distance, 32'767);
      beam.intensity = payload[static_cast<std::size_t>(at) + 2];
      if (beam.raw_distance == 0) continue;
      const double since_us = sheet_.fired_us[static_cast<std::size_t>(laser)];
      beam.fired_us = block / returns * sheet_.block_us + since_us;
      beam.rotor_deg = block_deg + packet.step_deg * since_us / sheet_.block_us;
      const beams::TableBeam& unit = table_.lasers[static_cast<std::size_t>(laser)];
      beam.beam_deg = beam.rotor_deg + unit.azimuth_offset_rad / kRadPerDeg;
      const double azimuth = beam.beam_deg * kRadPerDeg, rotor = beam.rotor_deg * kRadPerDeg;
      const double d = beam.raw_distance * sheet_.metres;
      const double level_m = d * std::cos(unit.elevation_rad);
      beam.x_m = level_m * std::cos(azimuth) + sheet_.lens_ahead_m * std::cos(rotor);
      beam.y_m = -level_m * std::sin(azimuth) - sheet_.lens_ahead_m * std::sin(rotor);
      beam.z_m = d * std::sin(unit.elevation_rad) + unit.vert_offset_m;
      packet.returns.push_back(beam);
    }
  }
  return packet;
}

std::vector<Payload> robosense_payloads(const RoboSenseSheet& sheet, const RotatingHead& head) {
  std::mt19937 random(head.seed);
  std::bernoulli_distribution measured(head.share_of_returns);
  std::uniform_int_distribution<unsigned> distance(1, 65'535), intensity(0, 255);
  const int returns = head.dual_return ? 2 : 1;
  std::vector<Payload> payloads(static_cast<std::size_t>(head.packets));
  for (std::size_t n = 0; n < payloads.size(); ++n) {
    Bytes& bytes = payloads[n].bytes;
    bytes.resize(1'248);
    std::ranges::copy(sheet.start, bytes.begin());
    bytes[31] = static_cast<std::uint8_t>(sheet.type);
    if (sheet.type == 6) bytes[17] = 1;
    const double first_us = static_cast<double>(n) * (kBlocks / returns) * sheet.block_us;
    for (int block = 0; block < kBlocks; ++block) {
      put(bytes, 42 + 100 * block, 0xFFEE, 2);
      const double fired_us = first_us + block / returns * sheet.block_us;
      const double head_deg = head.first_deg + 360.0 * head.spin_hz * fired_us * 1e-6;
      set_robosense_azimuth(bytes, block,
                            static_cast<unsigned>(std::llround(head_deg * 100.0) % 36'000));
      for (int laser = 0; laser < kLasers; ++laser) {
        if (!measured(random)) continue;
        const unsigned raw = distance(random);
        set_robosense_return(bytes, block, laser, raw, intensity(random));
      }
    }
    payloads[n].stamp_ns = kStart_ns + std::llround(first_us * 1e3);
    set_robosense_clock(sheet, bytes, payloads[n].stamp_ns);
  }
  return payloads;
}

void set_robosense_azimuth(Bytes& payload, int block, unsigned cdeg) {
  put(payload, 44 + 100 * block, cdeg, 2);
}

void set_robosense_return(Bytes& payload, int block, int laser, unsigned raw, unsigned intensity) {
  put(payload, return_at(block, laser), raw, 2);
  put(payload, return_at(block, laser) + 2, intensity, 1);
}

void set_robosense_clock(const RoboSenseSheet& sheet, Bytes& payload, std::int64_t time_ns) {
  const auto us = static_cast<std::uint64_t>(time_ns / 1'000), s = us / 1'000'000;
  if (!sheet.has_calendar) {
    put(payload, 20, s, 6);
    put(payload, 26, us % 1'000'000, 4);
    return;
  }
  const std::array<std::uint64_t, 6> date{26, 1, 1, s / 3'600 % 24, s / 60 % 60, s % 60};
  for (std::size_t i = 0; i < date.size(); ++i) put(payload, 20 + static_cast<int>(i), date[i], 1);
  put(payload, 26, us / 1'000 % 1'000, 2);
  put(payload, 28, us % 1'000, 2);
}

Bytes robosense_device_payload(const beams::BeamTable& table) {
  Bytes bytes(1'248);
  std::ranges::copy(std::array{0xA5, 0xFF, 0x00, 0x5A, 0x11, 0x11, 0x55, 0x55}, bytes.begin());
  const double unit_deg = robosense_sheet_of(table.model).device_angle_deg;
  const auto put_angle = [&](int at, double rad) {
    put(bytes, at, rad < 0 ? 1 : 0, 1);
    put(bytes, at + 1,
        static_cast<std::uint64_t>(std::llround(std::abs(rad) / kRadPerDeg / unit_deg)), 2);
  };
  for (int laser = 0; laser < kLasers; ++laser) {
    const beams::TableBeam& beam = table.lasers[static_cast<std::size_t>(laser)];
    put_angle(468 + 3 * laser, beam.elevation_rad);
    put_angle(468 + 96 + 3 * laser, beam.azimuth_offset_rad);
  }
  return bytes;
}

}  // namespace terracut::reference
