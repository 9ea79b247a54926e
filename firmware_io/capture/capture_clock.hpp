// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>

namespace terracut::capture {

/// Computes the time since the start of a capture from the stamps of its packets in file order.
/// Stamps need not ascend: the recording machine's clock may be set while it records, and files are
/// joined in any order. So no stamp is a reason to drop a packet.
///
/// Packets slightly out of order keep their times. After a step back by more than kDisorder_ns,
/// time goes on from its value before the step. If the stamps had jumped ahead less than
/// kDisorder_ns earlier (one odd stamp does this), time goes on from its value before that jump.
class CaptureClock {
 public:
  /// Shorter than the steps in which NTP sets a clock (128 ms), and longer than packets are
  /// reordered in the queues of a network card.
  static constexpr std::int64_t kDisorder_ns = 100'000'000;

  /// Returns a packet's time since the first packet; negative if the packet is slightly earlier.
  /// `stamp_ns` is that of a PcapRecord. Times end at four years.
  std::int64_t add(std::int64_t stamp_ns) noexcept;
  /// Returns the time since the first packet for a stamp close to the newest packet's; 0 before the
  /// first packet.
  [[nodiscard]] std::int64_t since_begin_ns(std::int64_t stamp_ns) const noexcept {
    return begun_ ? newest_.since_ns + (stamp_ns - newest_.stamp_ns) : 0;
  }

  /// These return how often stamps stepped back by more than kDisorder_ns, and the longest such
  /// step.
  [[nodiscard]] std::uint64_t steps_back() const noexcept { return steps_back_; }
  [[nodiscard]] std::int64_t longest_step_back_ns() const noexcept { return longest_back_ns_; }

 private:
  struct Instant {
    std::int64_t stamp_ns = 0, since_ns = 0;
  };

  bool begun_ = false;
  Instant newest_;
  std::optional<Instant> before_ahead_;  ///< The time before stamps last jumped ahead.
  std::int64_t ahead_stamp_ns_ = 0;      ///< The stamp that they jumped to.
  std::uint64_t steps_back_ = 0;
  std::int64_t longest_back_ns_ = 0;
};

}  // namespace terracut::capture
