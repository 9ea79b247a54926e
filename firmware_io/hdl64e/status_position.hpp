// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>

namespace terracut::hdl64e {

/// Numbers the packets of a status stream, whatever is lost, repeated or reordered.
///
/// The device stamp tells how many packet periods have passed since the newest packet, the type
/// letter the packet's place among the 16 of its cycle; together they give every packet its number,
/// exactly across gaps of several hundred packets. The period is measured from adjacent packets, so
/// every return mode works. Nothing allocates or throws.
class StatusPosition {
 public:
  struct Located {
    /// Number of the packet: modulo 16 it is the packet's place in its cycle, divided by 16 the
    /// cycle's number.
    std::int64_t packet = 0;
    /// True if the count began again: earlier numbers are no longer valid.
    bool restarted = false;
  };

  /// Returns the packet's number; nothing for a repeated packet or one that cannot be placed yet.
  /// `place` comes from status_place(): nothing if the type has no fixed place.
  [[nodiscard]] std::optional<Located> locate(std::optional<int> place,
                                              std::uint32_t stamp_us) noexcept;

  void reset() noexcept { *this = StatusPosition{}; }

 private:
  [[nodiscard]] std::optional<Located> restart(std::optional<int> place,
                                               std::uint32_t stamp_us) noexcept;
  [[nodiscard]] std::int64_t periods_in(std::int64_t step_us) const noexcept;
  /// False if the period has changed for good (another return mode).
  [[nodiscard]] bool learn_period(std::int64_t step_us) noexcept;

  bool locked_ = false;
  std::int64_t newest_packet_ = 0;
  std::uint32_t newest_stamp_us_ = 0;
  std::int64_t period_sum_us_ = 0;
  std::int64_t period_count_ = 0;
  int strays_in_a_row_ = 0;
};

}  // namespace terracut::hdl64e
