// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <fmt/format.h>

#include <array>
#include <random>
#include <string>

#include "firmware_io/vehicle/dbc_file.hpp"

namespace terracut::test {

/// A signal somewhere in a message of `length` bytes.
inline vehicle::DbcSignal random_signal(std::mt19937& random, int length, std::string name) {
  const auto from = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  constexpr std::array<double, 6> kFactors{1, 0.5, 0.01, 0.0002, 2, -0.1};
  constexpr std::array<double, 4> kOffsets{0, -40.95, 1000, -6.5};
  vehicle::DbcSignal signal;
  signal.name = std::move(name);
  signal.bit_count = from(1, std::min(64, 8 * length));
  signal.motorola = from(0, 1) == 1;
  const int first = from(0, 8 * length - signal.bit_count);
  signal.start_bit = signal.motorola ? first / 8 * 8 + 7 - first % 8 : first;
  if (from(0, 1) == 1) signal.number = vehicle::DbcNumber::kSigned;
  signal.factor = kFactors[static_cast<std::size_t>(from(0, 5))];
  signal.offset = kOffsets[static_cast<std::size_t>(from(0, 3))];
  return signal;
}

/// A message full of random signals, S0, S1 and so on.
inline vehicle::DbcMessage random_message(std::mt19937& random, std::uint32_t written_id,
                                          int length, int signals) {
  vehicle::DbcMessage message;
  message.name = fmt::format("M{}", written_id & 0x7FFFFFFF);
  message.written_id = written_id;
  message.length = length;
  for (int i = 0; i < signals; ++i) {
    message.signals.push_back(random_signal(random, length, fmt::format("S{}", i)));
  }
  return message;
}

/// The file, as text.
inline std::string dbc_text(const vehicle::DbcFile& file) {
  std::string text = "VERSION \"\"\n\nNS_ :\n\tSIG_VALTYPE_\n\nBS_:\n\nBU_: NODE\n\n";
  for (const auto& message : file.messages) {
    text += fmt::format("BO_ {} {}: {} NODE\n", message.written_id, message.name, message.length);
    for (const auto& signal : message.signals) {
      text += fmt::format(" SG_ {} : {}|{}@{}{} ({},{}) [0|0] \"{}\" NODE\n", signal.name,
                          signal.start_bit, signal.bit_count, signal.motorola ? 0 : 1,
                          signal.number == vehicle::DbcNumber::kSigned ? '-' : '+', signal.factor,
                          signal.offset, signal.unit);
    }
    text += '\n';
  }
  return text;
}

}  // namespace terracut::test
