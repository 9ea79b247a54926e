// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "ouster_reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <utility>

namespace terracut::reference {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr double kPi = std::numbers::pi;

std::uint64_t little_endian(std::span<const std::uint8_t> bytes, int at, int count) {
  std::uint64_t value = 0;
  for (int i = count - 1; i >= 0; --i)
    value = 256 * value + bytes[static_cast<std::size_t>(at + i)];
  return value;
}

void put(Bytes& bytes, int at, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i, value /= 256) {
    bytes[static_cast<std::size_t>(at + i)] = static_cast<std::uint8_t>(value % 256);
  }
}

void append(std::string& text, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i, value /= 256) text += static_cast<char>(value % 256);
}

std::vector<OusterSheet> make_sheets() {
  using enum ouster::Profile;
  const std::vector<OusterField> low_rate{{"RANGE", 0, 15, 3, 4},
                                          {"FLAGS", 15, 1, 0, 1},
                                          {"REFLECTIVITY", 16, 8, 0, 1},
                                          {"NEAR_IR", 24, 8, 4, 2},
                                          {"RAW32_WORD1", 0, 32, 0, 4}};
  std::vector<OusterField> low_rate_dual = low_rate;
  low_rate_dual.insert(low_rate_dual.end(), {{"RANGE2", 32, 15, 3, 4},
                                             {"FLAGS2", 47, 1, 0, 1},
                                             {"REFLECTIVITY2", 48, 8, 0, 1},
                                             {"RAW32_WORD2", 32, 32, 0, 4}});
  return {{kLegacy,
           0,
           16,
           12,
           4,
           0,
           false,
           {{"RANGE", 0, 20, 0, 4},
            {"FLAGS", 28, 4, 0, 1},
            {"REFLECTIVITY", 32, 8, 0, 1},
            {"SIGNAL", 48, 16, 0, 2},
            {"NEAR_IR", 64, 16, 0, 2},
            {"RAW32_WORD1", 0, 32, 0, 4},
            {"RAW32_WORD2", 32, 32, 0, 4},
            {"RAW32_WORD3", 64, 32, 0, 4}}},
          {kSingle,
           32,
           12,
           12,
           0,
           32,
           false,
           {{"RANGE", 0, 19, 0, 4},
            {"FLAGS", 19, 5, 0, 1},
            {"REFLECTIVITY", 32, 8, 0, 1},
            {"SIGNAL", 48, 16, 0, 2},
            {"NEAR_IR", 64, 16, 0, 2},
            {"RAW32_WORD1", 0, 32, 0, 4},
            {"RAW32_WORD2", 32, 32, 0, 4},
            {"RAW32_WORD3", 64, 32, 0, 4}}},
          {kDual,
           32,
           12,
           16,
           0,
           32,
           true,
           {{"RANGE", 0, 19, 0, 4},
            {"FLAGS", 19, 5, 0, 1},
            {"REFLECTIVITY", 24, 8, 0, 1},
            {"RANGE2", 32, 19, 0, 4},
            {"FLAGS2", 51, 5, 0, 1},
            {"REFLECTIVITY2", 56, 8, 0, 1},
            {"SIGNAL", 64, 16, 0, 2},
            {"SIGNAL2", 80, 16, 0, 2},
            {"NEAR_IR", 96, 16, 0, 2}}},
          {kLowRate, 32, 12, 4, 0, 32, false, low_rate},
          {kLowRateDual, 32, 12, 8, 0, 32, true, low_rate_dual}};
}

}  // namespace

const OusterField& OusterSheet::field(const std::string& name) const {
  return *std::ranges::find(fields, name, &OusterField::name);
}

std::optional<OusterField> OusterSheet::find(const std::string& name) const {
  const auto found = std::ranges::find(fields, name, &OusterField::name);
  return found == fields.end() ? std::nullopt : std::optional(*found);
}

const OusterSheet& ouster_sheet_of(ouster::Profile profile) {
  static const std::vector<OusterSheet> kSheets = make_sheets();
  return *std::ranges::find(kSheets, profile, &OusterSheet::profile);
}

OusterReference::Column OusterReference::column(std::span<const std::uint8_t> payload,
                                                int number) const {
  const int rows = unit_.format.rows, at = sheet_.column_at(rows, number);
  const bool is_legacy = sheet_.column_footer != 0;
  const std::uint64_t status = is_legacy
                                   ? little_endian(payload, at + sheet_.column_bytes(rows) - 4, 4)
                                   : little_endian(payload, at + 10, 2);
  return {little_endian(payload, at, 8), static_cast<int>(little_endian(payload, at + 8, 2)),
          static_cast<std::uint32_t>(status),
          static_cast<std::uint32_t>(is_legacy ? little_endian(payload, at + 10, 2) : 0),
          static_cast<std::uint32_t>(is_legacy ? little_endian(payload, at + 12, 4) : 0)};
}

std::uint64_t OusterReference::value(std::span<const std::uint8_t> payload, int column, int row,
                                     const OusterField& field) const {
  const int at = sheet_.channel_at(unit_.format.rows, column, row);
  std::uint64_t bits = 0;
  for (int i = field.from_bit + field.bits - 1; i >= field.from_bit; --i) {
    bits = 2 * bits + (payload[static_cast<std::size_t>(at + i / 8)] >> (i % 8) & 1U);
  }
  return bits << field.shift;
}

void OusterReference::project(double range_mm, int measurement, std::size_t row, Return& to) const {
  const beams::TableBeam& beam = unit_.lasers[row];
  const double encoder = 2 * kPi * (1 - static_cast<double>(measurement) / unit_.columns_per_frame);
  const double azimuth = -beam.azimuth_offset_rad, altitude = beam.elevation_rad;
  const double from_beam_mm = range_mm - unit_.beam_origin_m * 1e3;
  const double x_mm = from_beam_mm * std::cos(encoder + azimuth) * std::cos(altitude) +
                      unit_.ahead_m * 1e3 * std::cos(encoder);
  const double y_mm = from_beam_mm * std::sin(encoder + azimuth) * std::cos(altitude) +
                      unit_.ahead_m * 1e3 * std::sin(encoder);
  const double z_mm = from_beam_mm * std::sin(altitude) + beam.vert_offset_m * 1e3;
  const auto& T = unit_.T_sensor_lidar;
  const auto turned_m = [&](std::size_t axis) {
    return (T[4 * axis] * x_mm + T[4 * axis + 1] * y_mm + T[4 * axis + 2] * z_mm) / 1e3 +
           T[4 * axis + 3];
  };
  to.x_m = turned_m(0);
  to.y_m = turned_m(1);
  to.z_m = turned_m(2);
}

Packet OusterReference::decode(std::span<const std::uint8_t> payload) const {
  Packet packet;
  const int rows = unit_.format.rows, columns = unit_.format.columns;
  const auto refuse = [&](Refusal refusal) {
    packet = {};
    packet.refusal = refusal;
    return packet;
  };
  if (payload.size() != static_cast<std::size_t>(sheet_.packet_bytes(rows, columns))) {
    return refuse(Refusal::kOtherPacket);
  }
  if (sheet_.packet_header != 0 && payload[0] != 1) return refuse(Refusal::kOtherPacket);
  std::vector<Column> heads;
  for (int i = 0; i < columns; ++i) heads.push_back(column(payload, i));
  const auto is_valid = [](const Column& head) { return head.status % 2 == 1; };
  const bool any_valid = std::ranges::any_of(heads, is_valid);
  // All columns that are believed must give the packet the same first one.
  int first = -1;
  for (int i = 0; i < columns; ++i) {
    const Column& head = heads[static_cast<std::size_t>(i)];
    if (any_valid && !is_valid(head)) continue;
    const int of_this = head.measurement - i;
    if (of_this < 0 || (first >= 0 && of_this != first)) return refuse(Refusal::kOtherPacket);
    first = of_this;
  }
  if (first % columns != 0 || first >= 4096) return refuse(Refusal::kOtherPacket);
  if (first + columns > unit_.columns_per_frame) return refuse(Refusal::kAzimuthRange);
  packet.dual_return = sheet_.is_dual;
  packet.columns = columns * (sheet_.is_dual ? 2 : 1);
  packet.step_deg = 360.0 / unit_.columns_per_frame;
  packet.first_deg = first * packet.step_deg;
  for (int i = 0; i < columns; ++i) {
    if (!is_valid(heads[static_cast<std::size_t>(i)])) continue;
    for (int second = 0; second < (sheet_.is_dual ? 2 : 1); ++second) {
      const std::string number = second == 1 ? "2" : "";
      for (int row = 0; row < rows; ++row) {
        Return found;
        found.raw_distance =
            static_cast<int>(value(payload, i, row, sheet_.field("RANGE" + number)));
        if (found.raw_distance == 0) continue;
        found.column = i * (sheet_.is_dual ? 2 : 1) + second;
        found.laser = row;
        found.intensity =
            static_cast<int>(value(payload, i, row, sheet_.field("REFLECTIVITY" + number)));
        found.rotor_deg = (first + i) * packet.step_deg;
        found.beam_deg = found.rotor_deg +
                         unit_.lasers[static_cast<std::size_t>(row)].azimuth_offset_rad * 180 / kPi;
        found.fired_us = i * 1e6 / (unit_.rate_hz * unit_.columns_per_frame);
        project(found.raw_distance, first + i, static_cast<std::size_t>(row), found);
        packet.returns.push_back(found);
      }
    }
  }
  return packet;
}

std::map<std::string, std::string> OusterReference::fields(
    std::span<const std::uint8_t> payload) const {
  std::map<std::string, std::string> all;
  for (int i = 0; i < unit_.format.columns; ++i) {
    const Column head = column(payload, i);
    append(all["TIMESTAMP"], head.stamp_ns, 8);
    append(all["MEASUREMENT_ID"], static_cast<std::uint64_t>(head.measurement), 2);
    append(all["STATUS"], head.status, 4);
    append(all["FRAME_ID"], head.frame, 2);
    append(all["ENCODER_COUNT"], head.encoder, 4);
  }
  for (const OusterField& field : sheet_.fields) {
    for (int row = 0; row < unit_.format.rows; ++row) {
      for (int i = 0; i < unit_.format.columns; ++i) {
        append(all[field.name], value(payload, i, row, field), field.bytes);
      }
    }
  }
  return all;
}

void set_ouster_columns(const ouster::OusterCalibration& unit, Bytes& payload, int first,
                        std::uint64_t stamp_ns, std::uint32_t valid) {
  const OusterSheet& sheet = ouster_sheet_of(unit.format.profile);
  const double column_ns = 1e9 / (unit.rate_hz * unit.columns_per_frame);
  for (int i = 0; i < unit.format.columns; ++i) {
    const int at = sheet.column_at(unit.format.rows, i);
    const bool is_valid = (valid >> i & 1U) != 0;
    put(payload, at, stamp_ns + static_cast<std::uint64_t>(i * column_ns), 8);
    put(payload, at + 8, static_cast<std::uint64_t>(first + i), 2);
    if (sheet.column_footer != 0) {
      put(payload, at + 12,
          static_cast<std::uint64_t>((first + i) * 90'112 / unit.columns_per_frame), 4);
      put(payload, at + sheet.column_bytes(unit.format.rows) - 4, is_valid ? 0xFFFF'FFFF : 0, 4);
    } else {
      put(payload, at + 10, is_valid ? 1 : 0, 2);
    }
  }
}

std::vector<Payload> ouster_payloads(const ouster::OusterCalibration& unit,
                                     const RotatingHead& head) {
  const OusterSheet& sheet = ouster_sheet_of(unit.format.profile);
  const int rows = unit.format.rows, columns = unit.format.columns;
  const int packets_a_frame = unit.columns_per_frame / columns;
  const double packet_ns = 1e9 / (unit.rate_hz * packets_a_frame);
  constexpr std::int64_t kStart_ns = 1'767'225'600'000'000'000;
  std::mt19937 random(head.seed);
  std::bernoulli_distribution has_return(head.share_of_returns), is_split(0.2);
  std::uniform_int_distribution<int> range_mm(400, 240'000), reflectivity(1, 255);
  const int first = static_cast<int>(head.first_deg / 360 * packets_a_frame);
  std::vector<Payload> payloads;
  for (int n = 0; n < head.packets; ++n) {
    const auto stamp_ns = static_cast<std::int64_t>(n * packet_ns);
    Bytes bytes(static_cast<std::size_t>(sheet.packet_bytes(rows, columns)));
    if (sheet.packet_header != 0) bytes[0] = 1;
    set_ouster_columns(unit, bytes, (first + n) % packets_a_frame * columns,
                       static_cast<std::uint64_t>(kStart_ns + stamp_ns));
    for (int column = 0; column < columns; ++column) {
      for (int row = 0; row < rows; ++row) {
        if (!has_return(random)) continue;
        const bool has_second = sheet.is_dual && is_split(random);
        for (int second = 0; second < (has_second ? 2 : 1); ++second) {
          const std::string number = second == 1 ? "2" : "";
          const OusterField& range = sheet.field("RANGE" + number);
          const OusterField& strength = sheet.field("REFLECTIVITY" + number);
          const int at = sheet.channel_at(rows, column, row);
          put(bytes, at + range.from_bit / 8,
              static_cast<std::uint64_t>(range_mm(random) >> range.shift), range.bits > 16 ? 3 : 2);
          put(bytes, at + strength.from_bit / 8, static_cast<std::uint64_t>(reflectivity(random)),
              1);
        }
      }
    }
    payloads.push_back(
        {std::move(bytes), kStart_ns + stamp_ns + static_cast<std::int64_t>(packet_ns)});
  }
  return payloads;
}

ouster::OusterCalibration random_ouster(int rows, ouster::Profile profile, std::mt19937& random) {
  const auto any = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  ouster::OusterCalibration unit;
  unit.format = {.profile = profile, .rows = rows};
  constexpr std::array<std::pair<int, double>, 6> kModes{
      {{512, 10}, {512, 20}, {1024, 10}, {1024, 20}, {2048, 10}, {4096, 5}}};
  std::tie(unit.columns_per_frame, unit.rate_hz) = kModes[random() % kModes.size()];
  unit.window = {0, unit.columns_per_frame - 1};
  const double span_deg = any(20, 45);
  for (int row = 0; row < rows; ++row) {
    const double altitude_deg = span_deg - 2 * span_deg * row / (rows - 1);
    unit.lasers.push_back(
        {(altitude_deg + any(-0.05, 0.05)) * kPi / 180, any(-12, 12) * kPi / 180, 0});
  }
  unit.ahead_m = any(0.01, 0.03);
  const double up_m = any(-0.01, 0.01);
  for (beams::TableBeam& beam : unit.lasers) beam.vert_offset_m = up_m;
  unit.beam_origin_m = std::hypot(unit.ahead_m, up_m);
  const double turn = any(-kPi, kPi);
  unit.T_sensor_lidar = {std::cos(turn),
                         -std::sin(turn),
                         0,
                         any(-0.05, 0.05),
                         std::sin(turn),
                         std::cos(turn),
                         0,
                         any(-0.05, 0.05),
                         0,
                         0,
                         1,
                         any(0, 0.1)};
  unit.origin = "made here";
  return unit;
}

}  // namespace terracut::reference
