// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

#include "calib/hdl64e/hdl64e_stream_table.hpp"

/// Tables of the status stream with arbitrary laser values, made from the description of the format
/// alone (docs/reference/sensors.md), apart from the code under test.
namespace terracut::test {

using TableImage = std::array<std::uint8_t, hdl64e::kStreamTableBytes>;

inline std::size_t laser_at(std::size_t laser) {
  return 7 + 28 * laser;
}

inline void put_last_word(TableImage& table, unsigned word) {
  table[1818] = static_cast<std::uint8_t>(word);
  table[1819] = static_cast<std::uint8_t>(word >> 8);
}

/// CRC-16, polynomial 0x8005, bit by bit over the 20 bytes after each laser's number.
inline unsigned crc_of(const TableImage& table) {
  unsigned crc = 0;
  for (std::size_t laser = 0; laser < 64; ++laser) {
    for (std::size_t i = 1; i <= 20; ++i) {
      crc ^= static_cast<unsigned>(table[laser_at(laser) + i]) << 8;
      for (int bit = 0; bit < 8; ++bit) {
        crc = (crc & 0x8000U) != 0 ? ((crc << 1) ^ 0x8005U) & 0xFFFFU : crc << 1;
      }
    }
  }
  return crc;
}

inline TableImage random_table(unsigned seed) {
  std::mt19937 random(seed);
  TableImage table;
  for (auto& byte : table) byte = static_cast<std::uint8_t>(random());
  constexpr std::array<std::uint8_t, 5> kBeginning{'U', 'N', 'I', 'T', '#'};
  std::copy(kBeginning.begin(), kBeginning.end(), table.begin());
  for (std::size_t laser = 0; laser < 64; ++laser) {
    table[laser_at(laser)] = static_cast<std::uint8_t>(laser);
    if (laser < 63) table[laser_at(laser) + 21] = 0x20;  // warning: PPS present
  }
  return table;
}

inline TableImage s3_table(unsigned seed = 1) {
  TableImage table = random_table(seed);
  put_last_word(table, crc_of(table));
  return table;
}

inline TableImage s2_table(unsigned seed = 1) {
  TableImage table = random_table(seed);
  put_last_word(table, 1820);
  return table;
}

}  // namespace terracut::test
