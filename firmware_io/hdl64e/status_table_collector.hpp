// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/hdl64e/status_cycle.hpp"

namespace terracut::hdl64e {

/// Puts the table of the status stream together from its bytes, in whatever order and with whatever
/// holes they come. The caller knows at which cycle of the stream a byte was sent; where the table
/// begins among the 260 cycles is found here, from its first bytes "UNIT#".
///
/// Believed is a table without holes whose laser numbers are in their places and that either
/// carries a right CRC (S3), or whose every laser byte was the same twice in a row (S2, which has
/// no CRC). All memory is inside the object; nothing allocates or throws.
class StatusTableCollector {
 public:
  using Table = std::array<std::uint8_t, kStreamTableBytes>;

  /// Places one byte: `cycle` counts cycles since any start, `place` is 0..6.
  void add(std::int64_t cycle, int place, std::uint8_t value) noexcept;

  /// Drops the bytes, keeps the last accepted table.
  void clear() noexcept;

  /// Holes left; the whole table's size while its beginning is not known.
  [[nodiscard]] std::size_t holes() const noexcept;

  /// Whether `cycle` is the first of a round; false while the beginning is not known.
  [[nodiscard]] bool starts_round(std::int64_t cycle) const noexcept;

  /// Tests the bytes present and takes the table over if it is to be believed; `has_crc` as the S3.
  /// Without effect while holes remain. Costs a few microseconds, and only when bytes have changed.
  void try_accept(bool has_crc) noexcept;

  /// Whether a table was accepted, the table, and how many different ones were.
  [[nodiscard]] bool accepted() const noexcept { return generation_ != 0; }
  [[nodiscard]] const Table& table() const noexcept { return accepted_; }
  [[nodiscard]] std::uint32_t generation() const noexcept { return generation_; }

 private:
  static constexpr int kNoAnchor = -1;

  [[nodiscard]] bool begins_table(int row) const noexcept;
  [[nodiscard]] bool every_laser_byte_came_twice(const Table& table) const noexcept;
  /// Index of byte `i` of the table in the arrays below.
  [[nodiscard]] std::size_t at(std::size_t i) const noexcept;

  // By cycle modulo 260, seven bytes each; `anchor_` is the cycle that holds "UNIT#".
  Table bytes_{};
  Table seen_{};  ///< Times in a row the byte had this value: 0 = hole, 1, 2 = twice or more.
  std::size_t missing_ = kStreamTableBytes;
  int anchor_ = kNoAnchor;
  bool changed_ = false;  ///< Since the last test.

  Table accepted_{};
  std::uint32_t generation_ = 0;
};

}  // namespace terracut::hdl64e
