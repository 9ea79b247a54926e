// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "hesai_reference.hpp"

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

int little_endian(std::span<const std::uint8_t> bytes, int at) {
  const auto i = static_cast<std::size_t>(at);
  return bytes[i] + 256 * bytes[i + 1];
}

void put(Bytes& bytes, int at, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i, value /= 256) {
    bytes[static_cast<std::size_t>(at + i)] = static_cast<std::uint8_t>(value % 256);
  }
}

std::vector<double> evenly(int lasers, double apart_us, int before_again) {
  std::vector<double> fired_us;
  for (int laser = 0; laser < lasers; ++laser) fired_us.push_back(laser % before_again * apart_us);
  return fired_us;
}

/// The QT128's two kinds of blocks in one: the mean of a laser's times, or the one it has.
std::vector<double> of_both_loops(const std::vector<double>& one,
                                  const std::vector<double>& other) {
  std::vector<double> fired_us;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const bool is_in_both = one[i] > 0 && other[i] > 0;
    fired_us.push_back((one[i] + other[i]) / (is_in_both ? 2 : 1));
  }
  return fired_us;
}

/// The OT128's lasers: eight times of the outer ones and forty of the middle, repeated.
std::vector<double> of_ot128(const std::vector<double>& outer, const std::vector<double>& middle) {
  std::vector<double> fired_us;
  for (std::size_t i = 0; i < 128; ++i) {
    const std::size_t m = i - 24;
    fired_us.push_back(i < 24 || i >= 88 ? outer[i % 8] : middle[m < 40 ? m : m - 24]);
  }
  return fired_us;
}

std::vector<HesaiSheet> make_sheets() {
  using enum sensor::SensorModel;
  const std::vector<double> early{20.52,  16.549, 10.26,  16.549, 20.52, 3.971,  14.231, 7.942,
                                  14.231, 7.942,  10.26,  1.653,  1.653, 3.971,  22.838, 22.838,
                                  14.231, 16.549, 20.52,  7.942,  10.26, 16.549, 1.653,  3.971,
                                  10.26,  22.838, 14.231, 3.971,  20.52, 7.942,  14.231, 16.549,
                                  1.653,  7.942,  10.26,  22.838, 1.653, 3.971,  20.52,  22.838};
  const std::vector<double> late{22.664, 18.693, 10.26,  18.693, 22.664, 3.971,  16.375, 7.942,
                                 16.375, 7.942,  10.26,  1.653,  1.653,  3.971,  24.982, 24.982,
                                 16.375, 18.693, 22.664, 7.942,  10.26,  18.693, 1.653,  3.971,
                                 10.26,  24.982, 16.375, 3.971,  22.664, 7.942,  16.375, 18.693,
                                 1.653,  7.942,  10.26,  24.982, 1.653,  3.971,  22.664, 24.982};
  std::vector<HesaiSheet> sheets{
      {.model = kPandar40p,
       .bytes = 1262,
       .more = 4,
       .lasers = 40,
       .blocks = 10,
       .blocks_have_a_start = true,
       .bytes_a_return = 3,
       .mode_at = 1254,
       .microseconds_at = 1250,
       .date_at = 1256,
       .block_us = 55.56,
       .fired_us = {-42.22, -28.47, -16.04, -3.62,  -45.49, -31.74, -47.46, -54.67, -20.62, -33.71,
                    -40.91, -8.19,  -20.62, -27.16, -50.73, -8.19,  -14.74, -36.98, -45.49, -52.7,
                    -23.89, -31.74, -38.95, -11.47, -18.65, -25.19, -48.76, -6.23,  -12.77, -35.01,
                    -21.92, -9.5,   -43.52, -29.77, -17.35, -4.92,  -42.22, -28.47, -16.04, -3.62}},
      {.model = kPandar64,
       .bytes = 1194,
       .more = 4,
       .first_block = 8,
       .lasers = 64,
       .blocks = 6,
       .bytes_a_return = 3,
       .mode_at = 1186,
       .microseconds_at = 1182,
       .date_at = 1188,
       .block_us = 55.56,
       .fired_us = {-23.18,  -21.876, -20.572, -19.268, -17.964, -16.66,  -11.444, -46.796,
                    -7.532,  -36.956, -50.732, -54.668, -40.892, -44.828, -31.052, -34.988,
                    -48.764, -52.7,   -38.924, -42.86,  -29.084, -33.02,  -46.796, -25.148,
                    -36.956, -50.732, -27.116, -40.892, -44.828, -31.052, -34.988, -48.764,
                    -25.148, -38.924, -42.86,  -29.084, -33.02,  -52.7,   -6.228,  -54.668,
                    -15.356, -27.116, -10.14,  -23.18,  -4.924,  -21.876, -14.052, -17.964,
                    -8.836,  -19.268, -3.62,   -20.572, -12.748, -16.66,  -7.532,  -11.444,
                    -6.228,  -15.356, -10.14,  -4.924,  -3.62,   -14.052, -8.836,  -12.748}},
      {.model = kPandarQt64,
       .bytes = 1072,
       .first_block = 12,
       .lasers = 64,
       .blocks = 4,
       .mode_at = 1060,
       .microseconds_at = 1056,
       .date_at = 1062,
       .block_us = 166.667,
       .fired_us = {12.31,  14.37,  16.43,  18.49,  20.54,  22.6,   24.66,  26.71,  29.16,  31.22,
                    33.28,  35.34,  37.39,  39.45,  41.5,   43.56,  46.61,  48.67,  50.73,  52.78,
                    54.84,  56.9,   58.95,  61.01,  63.45,  65.52,  67.58,  69.63,  71.69,  73.74,
                    75.8,   77.86,  80.9,   82.97,  85.02,  87.08,  89.14,  91.19,  93.25,  95.3,
                    97.75,  99.82,  101.87, 103.93, 105.98, 108.04, 110.1,  112.15, 115.2,  117.26,
                    119.32, 121.38, 123.43, 125.49, 127.54, 129.6,  132.05, 134.11, 136.17, 138.22,
                    140.28, 142.34, 144.39, 146.45}},
      {.model = kPandarQt128,
       .bytes = 1095,
       .more = 32,
       .first_block = 12,
       .lasers = 128,
       .blocks = 2,
       .mode_at = 1073,
       .microseconds_at = 1082,
       .date_at = 1076,
       .block_us = 111.111,
       .fired_us = of_both_loops(
           {0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,
            0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,
            0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    27.656,
            53.0,   2.312,  78.344, 81.512, 5.48,   56.168, 30.824, 33.992, 59.336, 8.648,  84.68,
            87.848, 11.816, 62.504, 37.16,  40.328, 65.672, 14.984, 91.016, 94.184, 18.152, 68.84,
            43.496, 46.664, 72.008, 21.32,  97.352, 100.52, 24.488, 75.176, 49.832, 1.456,  77.488,
            26.8,   52.144, 55.312, 29.968, 80.656, 4.624,  7.792,  83.824, 33.136, 58.48,  61.648,
            36.304, 86.992, 10.96,  14.128, 90.16,  39.472, 64.816, 67.984, 42.64,  93.328, 17.296,
            20.464, 96.496, 45.808, 71.152, 74.32,  48.976, 99.664, 23.632, 25.944, 51.288, 0.6,
            76.632, 79.8,   3.768,  54.456, 29.112, 32.28,  57.624, 6.936,  82.968, 86.136, 10.104,
            60.792, 35.448, 38.616, 63.96,  13.272, 89.304, 92.472, 16.44,  67.128, 41.784, 44.952,
            70.296, 19.608, 95.64,  98.808, 22.776, 73.464, 48.12},
           {2.312,  78.344, 27.656, 53.0,   56.168, 30.824, 81.512, 5.48,   8.648,  84.68,  33.992,
            59.336, 62.504, 37.16,  87.848, 11.816, 14.984, 91.016, 40.328, 65.672, 68.84,  43.496,
            94.184, 18.152, 21.32,  97.352, 46.664, 72.008, 75.176, 49.832, 100.52, 24.488, 0.0,
            0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,
            0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,
            0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.0,    0.6,    76.632,
            25.944, 51.288, 54.456, 29.112, 79.8,   3.768,  6.936,  82.968, 32.28,  57.624, 60.792,
            35.448, 86.136, 10.104, 13.272, 89.304, 38.616, 63.96,  67.128, 41.784, 92.472, 16.44,
            19.608, 95.64,  44.952, 70.296, 73.464, 48.12,  98.808, 22.776, 26.8,   52.144, 1.456,
            77.488, 80.656, 4.624,  55.312, 29.968, 33.136, 58.48,  7.792,  83.824, 86.992, 10.96,
            61.648, 36.304, 39.472, 64.816, 14.128, 90.16,  93.328, 17.296, 67.984, 42.64,  45.808,
            71.152, 20.464, 96.496, 99.664, 23.632, 74.32,  48.976})},
      {.model = kPandarXt16,
       .bytes = 568,
       .first_block = 12,
       .lasers = 16,
       .blocks = 8,
       .mode_at = 550,
       .microseconds_at = 559,
       .date_at = 553,
       .block_us = 50,
       .fired_us = evenly(16, 3.024, 16)},
      {.model = kPandarXt32,
       .bytes = 1080,
       .first_block = 12,
       .lasers = 32,
       .blocks = 8,
       .mode_at = 1062,
       .microseconds_at = 1071,
       .date_at = 1065,
       .block_us = 50,
       .fired_us = evenly(32, 1.512, 32)},
      {.model = kPandarXt32m,
       .bytes = 820,
       .first_block = 12,
       .lasers = 32,
       .blocks = 6,
       .mode_at = 802,
       .microseconds_at = 811,
       .date_at = 805,
       .block_us = 50,
       .fired_us = evenly(32, 2.888, 16)},
      {.model = kOt128,
       .bytes = 861,
       .more = 32,
       .first_block = 12,
       .lasers = 128,
       .blocks = 2,
       .bytes_a_return = 3,
       .mode_at = 817,
       .microseconds_at = 826,
       .date_at = 820,
       .block_us = 55.556,
       .fired_us = of_both_loops(
           of_ot128({46.645, 34.067, 18.867, 6.289, 40.356, 27.778, 12.578, 0}, early),
           of_ot128({46.645, 34.067, 21.011, 6.289, 40.356, 27.778, 14.722, 0}, late)),
       .least_distance = 4,
       .version = 128,
       .state_at = 816,
       .state = 2}};
  HesaiSheet high = sheets.back();
  high.block_us = 27.778;
  high.fired_us =
      of_both_loops(of_ot128({18.867, 6.289, 18.867, 6.289, 12.578, 0, 12.578, 0}, early),
                    of_ot128({18.867, 6.289, 21.011, 6.289, 12.578, 0, 14.722, 0}, late));
  high.state = 0;
  sheets.push_back(high);
  HesaiSheet pandar128 = sheets[sheets.size() - 2];
  pandar128.model = kPandar128;
  pandar128.least_distance = 1;
  pandar128.version = 0;
  pandar128.fired_us = of_both_loops(
      {4.436,  28.554, 0.776,  2.431,  4.436,  30.559, 6.441,  32.564, 34.219, 0.776,  2.431,
       6.441,  28.554, 34.219, 30.559, 28.554, 32.564, 6.441,  32.564, 0.776,  2.431,  30.559,
       34.219, 32.564, 4.436,  38.509, 43.079, 12.666, 43.079, 19.521, 19.521, 36.224, 12.666,
       12.666, 38.509, 52.219, 17.236, 52.219, 43.079, 43.079, 19.521, 17.236, 12.666, 21.806,
       36.224, 21.806, 38.509, 38.509, 21.806, 36.224, 36.224, 19.521, 12.666, 12.666, 52.219,
       52.219, 17.236, 21.806, 17.236, 43.079, 38.509, 43.079, 17.236, 17.236, 36.224, 19.521,
       19.521, 38.509, 52.219, 38.509, 21.806, 12.666, 38.509, 43.079, 21.806, 36.224, 19.521,
       17.236, 36.224, 19.521, 52.219, 52.219, 52.219, 17.236, 21.806, 36.224, 12.666, 21.806,
       43.079, 2.431,  0.776,  4.436,  6.441,  34.219, 30.559, 0.776,  28.554, 2.431,  2.431,
       4.436,  32.564, 28.554, 30.559, 6.441,  4.436,  30.559, 28.554, 32.564, 6.441,  34.219,
       34.219, 32.564, 0.776,  4.436,  32.564, 2.431,  30.559, 34.219, 0.776,  28.554, 4.436,
       6.441,  34.219, 30.559, 2.431,  0.776,  6.441,  28.554},
      {4.436,  28.554, 0.776,  2.781,  4.436,  30.209, 6.091,  31.864, 33.869, 0.776,  2.781,
       6.091,  28.554, 33.869, 30.209, 28.554, 31.864, 6.091,  31.864, 0.776,  2.781,  30.209,
       33.869, 31.864, 4.436,  37.809, 42.379, 12.666, 42.379, 19.521, 19.521, 35.524, 12.666,
       12.666, 37.809, 51.519, 17.236, 51.519, 42.379, 42.379, 19.521, 17.236, 12.666, 21.806,
       35.524, 21.806, 37.809, 37.809, 21.806, 35.524, 35.524, 19.521, 12.666, 12.666, 51.519,
       51.519, 17.236, 21.806, 17.236, 42.379, 37.809, 42.379, 17.236, 17.236, 35.524, 19.521,
       19.521, 37.809, 51.519, 37.809, 21.806, 12.666, 37.809, 42.379, 21.806, 35.524, 19.521,
       17.236, 35.524, 19.521, 51.519, 51.519, 51.519, 17.236, 21.806, 35.524, 12.666, 21.806,
       42.379, 2.781,  0.776,  4.436,  6.091,  33.869, 30.209, 0.776,  28.554, 2.781,  2.781,
       4.436,  31.864, 28.554, 30.209, 6.091,  4.436,  30.209, 28.554, 31.864, 6.091,  33.869,
       33.869, 31.864, 0.776,  4.436,  31.864, 2.781,  30.209, 33.869, 0.776,  28.554, 4.436,
       6.091,  33.869, 30.209, 2.781,  0.776,  6.091,  28.554});
  sheets.push_back(pandar128);
  // At high resolution a laser fires in one or all of four kinds of blocks: the mean of its times.
  pandar128.block_us = 27.778;
  pandar128.fired_us = {
      4.436,  0.776,  0.776,  2.606,  4.436,  2.606,  6.266,  4.436,  6.266,  0.776,  2.606,
      6.266,  0.776,  6.266,  2.606,  0.776,  4.436,  6.266,  4.436,  0.776,  2.606,  2.606,
      6.266,  4.436,  4.436,  10.381, 14.951, 12.666, 14.951, 19.521, 19.521, 8.096,  12.666,
      12.666, 10.381, 24.091, 17.236, 24.091, 14.951, 14.951, 19.521, 17.236, 12.666, 21.806,
      8.096,  21.806, 10.381, 10.381, 21.806, 8.096,  8.096,  19.521, 12.666, 12.666, 24.091,
      24.091, 17.236, 21.806, 17.236, 14.951, 10.381, 14.951, 17.236, 17.236, 8.096,  19.521,
      19.521, 10.381, 24.091, 10.381, 21.806, 12.666, 10.381, 14.951, 21.806, 8.096,  19.521,
      17.236, 8.096,  19.521, 24.091, 24.091, 24.091, 17.236, 21.806, 8.096,  12.666, 21.806,
      14.951, 2.606,  0.776,  4.436,  6.266,  6.266,  2.606,  0.776,  0.776,  2.606,  2.606,
      4.436,  4.436,  0.776,  2.606,  6.266,  4.436,  2.606,  0.776,  4.436,  6.266,  6.266,
      6.266,  4.436,  0.776,  4.436,  4.436,  2.606,  2.606,  6.266,  0.776,  0.776,  4.436,
      6.266,  6.266,  2.606,  2.606,  0.776,  6.266,  0.776};
  pandar128.state = 0;
  sheets.push_back(pandar128);
  for (HesaiSheet& sheet : sheets) {
    const double earliest_us = std::ranges::min(sheet.fired_us);
    for (double& fired_us : sheet.fired_us) fired_us -= earliest_us;
  }
  return sheets;
}

int returns_of(int mode) {
  if (mode == 0x33 || mode == 0x34 || mode == 0x37 || mode == 0x38) return 1;
  return (mode >= 0x39 && mode <= 0x3C) || mode == 0x3E ? 2 : 0;
}

bool is_packet(const HesaiSheet& sheet, std::span<const std::uint8_t> payload) {
  const auto size = static_cast<int>(payload.size());
  if (size != sheet.bytes && size != sheet.bytes + sheet.more) return false;
  if (sheet.blocks_have_a_start) {
    for (int block = 0; block < sheet.blocks; ++block) {
      if (little_endian(payload, sheet.azimuth_at(block) - 2) != 0xEEFF) return false;
    }
    return true;
  }
  const int counts = little_endian(payload, sheet.counts_at());
  return little_endian(payload, 0) == 0xFFEE && counts == sheet.lasers + 256 * sheet.blocks &&
         payload[static_cast<std::size_t>(sheet.counts_at()) + 3] == 4;
}

double clock_us(const HesaiSheet& sheet, std::span<const std::uint8_t> payload) {
  const auto date = payload.subspan(static_cast<std::size_t>(sheet.date_at), 6);
  return little_endian(payload, sheet.microseconds_at) +
         65'536.0 * little_endian(payload, sheet.microseconds_at + 2) +
         1e6 * (3'600 * date[3] + 60 * date[4] + date[5]);
}

}  // namespace

const HesaiSheet& hesai_sheet_of(sensor::SensorModel model, bool is_high) {
  static const std::vector<HesaiSheet> kSheets = make_sheets();
  return *std::ranges::find_if(kSheets, [&](const HesaiSheet& sheet) {
    return sheet.model == model && (!is_high || (sheet.state_at > 0 && sheet.state == 0));
  });
}

Packet HesaiReference::decode(std::span<const std::uint8_t> payload) {
  Packet packet;
  packet.refusal = Refusal::kOtherPacket;
  if (!is_packet(sheet_, payload)) return packet;
  if (sheet_.state_at > 0) {
    const bool is_high = payload[static_cast<std::size_t>(sheet_.state_at)] == 0;
    if (is_high != (sheet_.state == 0)) {
      sheet_ = hesai_sheet_of(sheet_.model, is_high);
      last_step_deg_ = 0;
      last_us_ = -1;
    }
  }
  const int returns = returns_of(payload[static_cast<std::size_t>(sheet_.mode_at)]);
  if (returns == 0) return packet;
  packet.dual_return = returns == 2;
  std::vector<int> cdeg;
  bool in_range = true, agree = true;
  for (int block = 0; block < sheet_.blocks; ++block) {
    cdeg.push_back(little_endian(payload, sheet_.azimuth_at(block)));
    in_range &= cdeg.back() <= 35'999;
    if (block % returns == 1) agree &= cdeg.back() == cdeg[cdeg.size() - 2];
  }
  packet.refusal = agree ? Refusal::kNone : Refusal::kUnequalFirings;
  if (!in_range) packet.refusal = Refusal::kAzimuthRange;
  if (packet.refusal != Refusal::kNone) return packet;
  const int firings = sheet_.blocks / returns;
  const int most_cdeg = static_cast<int>(36'000 * 30 * sheet_.block_us * 1e-6) + 1;
  const double stamp_us = clock_us(sheet_, payload);
  if (firings > 1) {
    packet.refusal = judge_rotation(cdeg, {.forwards_cdeg = most_cdeg,
                                           .backwards_cdeg = 5,
                                           .least_sweep_cdeg = 2 * (firings - 1),
                                           .standing_back_cdeg = 6});
    packet.step_deg = clockwise_cdeg(cdeg.front(), cdeg.back()) / 100.0 / (firings - 1);
  } else {
    const int way_cdeg = clockwise_cdeg(last_cdeg_, cdeg.front());
    const double since_us = stamp_us - last_us_;
    const bool follows = last_us_ >= 0 && since_us > 0 && since_us < 1.5 * sheet_.block_us;
    const double usual_deg = last_step_deg_ > 0 ? last_step_deg_ : 3'600 * sheet_.block_us * 1e-6;
    packet.step_deg = follows && way_cdeg <= most_cdeg ? way_cdeg / 100.0 : usual_deg;
    if (packet.step_deg < 0.02) packet.refusal = Refusal::kNotRotating;
  }
  last_cdeg_ = cdeg.front();
  last_us_ = stamp_us;
  if (packet.refusal != Refusal::kNone) return packet;
  last_step_deg_ = packet.step_deg;

  packet.columns = sheet_.blocks;
  packet.first_deg = cdeg[0] / 100.0;
  for (int block = 0; block < sheet_.blocks; ++block) {
    const double block_deg =
        packet.first_deg + clockwise_cdeg(cdeg[0], cdeg[static_cast<std::size_t>(block)]) / 100.0;
    for (int laser = 0; laser < sheet_.lasers; ++laser) {
      const int at = sheet_.azimuth_at(block) + 2 + laser * sheet_.bytes_a_return;
      Return beam;
      beam.column = block;
      beam.laser = laser;
      beam.raw_distance = little_endian(payload, at);
      beam.intensity = payload[static_cast<std::size_t>(at) + 2];
      if (beam.raw_distance < sheet_.least_distance) continue;
      const double since_us = sheet_.fired_us[static_cast<std::size_t>(laser)];
      beam.fired_us = block / returns * sheet_.block_us + since_us;
      beam.rotor_deg = block_deg + packet.step_deg * since_us / sheet_.block_us;
      const beams::TableBeam& unit = table_.lasers[static_cast<std::size_t>(laser)];
      beam.beam_deg = beam.rotor_deg + unit.azimuth_offset_rad / kRadPerDeg;
      const double azimuth = beam.beam_deg * kRadPerDeg;
      const double d = beam.raw_distance * 0.004;
      beam.x_m = d * std::cos(unit.elevation_rad) * std::cos(azimuth);
      beam.y_m = -d * std::cos(unit.elevation_rad) * std::sin(azimuth);
      beam.z_m = d * std::sin(unit.elevation_rad) + unit.vert_offset_m;
      packet.returns.push_back(beam);
    }
  }
  return packet;
}

std::vector<Payload> hesai_payloads(const HesaiSheet& sheet, const RotatingHead& head) {
  std::mt19937 random(head.seed);
  std::bernoulli_distribution measured(head.share_of_returns);
  std::uniform_int_distribution<unsigned> distance(1, 65'535), intensity(0, 255);
  const int returns = head.dual_return ? 2 : 1;
  std::vector<Payload> payloads(static_cast<std::size_t>(head.packets));
  for (std::size_t n = 0; n < payloads.size(); ++n) {
    Bytes& bytes = payloads[n].bytes;
    bytes.resize(static_cast<std::size_t>(sheet.bytes));
    if (!sheet.blocks_have_a_start) {
      put(bytes, 0, 0xFFEE, 2);
      put(bytes, sheet.counts_at(), static_cast<unsigned>(sheet.lasers + 256 * sheet.blocks), 2);
      put(bytes, sheet.counts_at() + 3, 4, 1);
    }
    put(bytes, sheet.mode_at, head.dual_return ? 0x39 : 0x37, 1);
    if (sheet.version > 0) put(bytes, 4, static_cast<unsigned>(sheet.version), 1);
    if (sheet.state_at > 0) put(bytes, sheet.state_at, static_cast<unsigned>(sheet.state), 1);
    const double first_us = static_cast<double>(n) * (sheet.blocks / returns) * sheet.block_us;
    for (int block = 0; block < sheet.blocks; ++block) {
      if (sheet.blocks_have_a_start) put(bytes, sheet.azimuth_at(block) - 2, 0xEEFF, 2);
      const double fired_us = first_us + block / returns * sheet.block_us;
      const double head_deg = head.first_deg + 360.0 * head.spin_hz * fired_us * 1e-6;
      set_hesai_azimuth(sheet, bytes, block,
                        static_cast<unsigned>(std::llround(head_deg * 100.0) % 36'000));
      for (int laser = 0; laser < sheet.lasers; ++laser) {
        if (!measured(random)) continue;
        const unsigned raw = distance(random);
        set_hesai_return(sheet, bytes, block, laser, raw, intensity(random));
      }
    }
    payloads[n].stamp_ns = kStart_ns + std::llround(first_us * 1e3);
    set_hesai_clock(sheet, bytes, payloads[n].stamp_ns);
  }
  return payloads;
}

void set_hesai_azimuth(const HesaiSheet& sheet, Bytes& payload, int block, unsigned cdeg) {
  put(payload, sheet.azimuth_at(block), cdeg, 2);
}

void set_hesai_return(const HesaiSheet& sheet, Bytes& payload, int block, int laser, unsigned raw,
                      unsigned intensity) {
  const int at = sheet.azimuth_at(block) + 2 + laser * sheet.bytes_a_return;
  put(payload, at, raw, 2);
  put(payload, at + 2, intensity, 1);
}

void set_hesai_clock(const HesaiSheet& sheet, Bytes& payload, std::int64_t time_ns) {
  const std::int64_t us = (time_ns - kStart_ns) / 1'000, s = us / 1'000'000;
  const std::array<std::int64_t, 6> date{126, 1, 1, s / 3'600 % 24, s / 60 % 60, s % 60};
  for (std::size_t i = 0; i < date.size(); ++i) {
    put(payload, sheet.date_at + static_cast<int>(i), static_cast<std::uint64_t>(date[i]), 1);
  }
  put(payload, sheet.microseconds_at, static_cast<std::uint64_t>(us % 1'000'000), 4);
}

}  // namespace terracut::reference
