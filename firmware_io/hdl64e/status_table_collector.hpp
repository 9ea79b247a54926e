// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/hdl64e/status_cycle.hpp"

namespace terracut::hdl64e {

/// Assembles the table of the status stream from its bytes, which may come in any order and with
/// holes. The caller knows in which cycle of the stream a byte was sent; in which of the 260 cycles
/// the table begins is found here, from its first bytes "UNIT#".
///
/// A table is accepted if it has no holes, its laser numbers are in their places, and either its
/// CRC is right (S3) or every laser byte came with the same value twice in a row (S2, which has no
/// CRC). The object contains all its memory; nothing allocates or throws.
class StatusTableCollector {
 public:
  using Table = std::array<std::uint8_t, kStreamTableBytes>;

  /// Takes one byte. `cycle` is the number of its cycle, counted from any start; `place` in 0..6 is
  /// its place in the cycle.
  void add(std::int64_t cycle, int place, std::uint8_t value) noexcept;

  /// Drops the bytes collected, but keeps the table accepted last.
  void clear() noexcept;

  /// Returns the number of bytes missing; the table's size until its beginning was seen.
  [[nodiscard]] std::size_t holes() const noexcept;

  /// True if `cycle` is the first of a round; false while the beginning is unknown.
  [[nodiscard]] bool starts_round(std::int64_t cycle) const noexcept;

  /// Tests the bytes present and accepts the table if it is right; `has_crc` is true for an S3.
  /// Does nothing while holes remain. Takes a few microseconds, and only if bytes have changed.
  void try_accept(bool has_crc) noexcept;

  /// Each returns one fact: whether a table was accepted, the table, and how many different ones
  /// were accepted.
  [[nodiscard]] bool accepted() const noexcept { return generation_ != 0; }
  [[nodiscard]] const Table& table() const noexcept { return accepted_; }
  [[nodiscard]] std::uint32_t generation() const noexcept { return generation_; }

 private:
  static constexpr int kNoAnchor = -1;

  [[nodiscard]] bool begins_table(int row) const noexcept;
  [[nodiscard]] bool every_laser_byte_came_twice(const Table& table) const noexcept;
  /// Returns the index of byte `i` of the table in the arrays below.
  [[nodiscard]] std::size_t at(std::size_t i) const noexcept;

  // Indexed by cycle modulo 260, seven bytes each; `anchor_` is the cycle that holds "UNIT#".
  Table bytes_{};
  Table seen_{};  ///< How often in a row the byte had this value: 0 is a hole, 2 means 2 or more.
  std::size_t missing_ = kStreamTableBytes;
  int anchor_ = kNoAnchor;
  bool changed_ = false;  ///< True if a byte changed since the last test.

  Table accepted_{};
  std::uint32_t generation_ = 0;
};

}  // namespace terracut::hdl64e
