// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A true status stream, bent by the fuzzer: packets lost, repeated, altered, delayed. The reader
// never crashes, and on a stream whose values were not altered it never believes any other table.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "calib/hdl64e/hdl64e_stream_table.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "tools/lab/tables/status_stream_writer.hpp"

namespace {

using Table = std::array<std::uint8_t, terracut::hdl64e::kStreamTableBytes>;

Table true_table() {
  Table table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = static_cast<std::uint8_t>(i * 37 >> 3);
  constexpr std::array<std::uint8_t, 5> kBeginning{'U', 'N', 'I', 'T', '#'};
  for (std::size_t i = 0; i < kBeginning.size(); ++i) table[i] = kBeginning[i];
  for (std::size_t laser = 0; laser < 64; ++laser) {
    table[7 + 28 * laser] = static_cast<std::uint8_t>(laser);
  }
  const std::uint16_t crc = terracut::hdl64e::stream_table_crc(table);
  table[1818] = static_cast<std::uint8_t>(crc & 0xFF);
  table[1819] = static_cast<std::uint8_t>(crc >> 8);
  return table;
}

bool same_lasers(std::span<const std::uint8_t> a, const Table& b) {
  for (std::size_t laser = 0; laser < 64; ++laser) {
    for (std::size_t i = 0; i < 21; ++i) {
      if (a[7 + 28 * laser + i] != b[7 + 28 * laser + i]) return false;
    }
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace terracut;
  static const Table table = true_table();
  tables::StatusStreamWriter writer(table, hdl64e::StatusFlavour::kS3);
  hdl64e::StatusStreamReader reader;
  std::uint32_t stamp_us = 3'599'000'000;  // passes the top of the hour
  bool altered = false;
  for (std::size_t i = 0; i + 1 < size; i += 2) {
    const std::uint8_t action = data[i];
    const std::uint8_t operand = data[i + 1];
    const auto one_packet = [&](bool lost, std::uint8_t type_flip, std::uint8_t value_flip) {
      const hdl64e::StatusPair pair = writer.next(0);
      stamp_us = (stamp_us + 288) % 3'600'000'000U;
      if (lost) return;
      reader.add(pair.type ^ type_flip, pair.value ^ value_flip, stamp_us);
    };
    switch (action % 8) {
      case 0:
      case 1:
      case 2:  // a stretch of good packets
        for (int n = 0; n < 16 * operand; ++n) one_packet(false, 0, 0);
        break;
      case 3:  // a gap
        for (int n = 0; n < 8 * operand; ++n) one_packet(true, 0, 0);
        break;
      case 4:
        one_packet(false, operand, 0);
        altered = altered || operand != 0;
        break;
      case 5:
        one_packet(false, 0, operand);
        altered = altered || operand != 0;
        break;
      case 6:  // the clock jumps
        stamp_us += static_cast<std::uint32_t>(operand) * 7'777'777U;
        altered = altered || operand != 0;
        break;
      default:  // anything at all
        reader.add(action, operand, stamp_us - operand);
        altered = true;
        break;
    }
  }
  if (reader.holes() > terracut::hdl64e::kStreamTableBytes) std::abort();
  if (!altered && reader.has_table() && !same_lasers(reader.table(), table)) std::abort();
  return 0;
}
