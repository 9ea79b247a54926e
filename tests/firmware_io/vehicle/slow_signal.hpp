// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "firmware_io/vehicle/dbc_file.hpp"

namespace terracut::test {

/// The value of a whole-number signal, one bit after the other as the numbering of the format
/// defines it: what the quick way is compared with. Sums in long double, so that 64 bits fit.
inline double slow_value(const vehicle::DbcSignal& signal, std::span<const std::uint8_t> bytes) {
  const auto bit_at = [&](int number) {
    return (bytes[static_cast<std::size_t>(number / 8)] >> number % 8 & 1) != 0;
  };
  long double sum = 0;
  int at = signal.start_bit;
  for (int i = 0; i < signal.bit_count; ++i) {
    // Weight of the bit: an Intel signal begins with its lowest, a Motorola one with its highest.
    const int power = signal.motorola ? signal.bit_count - 1 - i : i;
    const bool is_highest = power == signal.bit_count - 1;
    const long double weight = std::ldexp(1.0L, power);
    const bool negative = is_highest && signal.number == vehicle::DbcNumber::kSigned;
    if (bit_at(at)) sum += negative ? -weight : weight;
    if (!signal.motorola) {
      ++at;
    } else {
      at = at % 8 == 0 ? at + 15 : at - 1;
    }
  }
  return static_cast<double>(sum) * signal.factor + signal.offset;
}

}  // namespace terracut::test
