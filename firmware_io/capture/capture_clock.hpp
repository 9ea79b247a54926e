// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>

namespace terracut::capture {

/// How long a capture has been running, by the stamps of its packets in the order of the file. The
/// recording machine made them, whose clock may be set while it records, and files are joined in
/// any order: stamps tell no order of their own, and none is a reason to leave a packet out.
///
/// Packets a little out of order keep their times. Where stamps step back by more than
/// kDisorder_ns, time goes on from where it was; where they had run ahead for less than that, as
/// one odd stamp does, from before they did.
class CaptureClock {
 public:
  /// Less than the steps in which NTP sets a clock, 128 ms, and more than the queues of a network
  /// card mix up.
  static constexpr std::int64_t kDisorder_ns = 100'000'000;

  /// A packet's time since the first one, which it may precede a little: then it is below 0. Stamps
  /// are those of PcapRecord; times are held at four years.
  std::int64_t add(std::int64_t stamp_ns) noexcept;
  /// The same for a stamp near that of the newest packet; 0 before the first.
  [[nodiscard]] std::int64_t since_begin_ns(std::int64_t stamp_ns) const noexcept {
    return begun_ ? newest_.since_ns + (stamp_ns - newest_.stamp_ns) : 0;
  }

  /// How often stamps stepped back by more than kDisorder_ns, and by how much at most.
  [[nodiscard]] std::uint64_t steps_back() const noexcept { return steps_back_; }
  [[nodiscard]] std::int64_t longest_step_back_ns() const noexcept { return longest_back_ns_; }

 private:
  struct Instant {
    std::int64_t stamp_ns = 0, since_ns = 0;
  };

  bool begun_ = false;
  Instant newest_;
  std::optional<Instant> before_ahead_;  ///< Where time stood before stamps last ran ahead ...
  std::int64_t ahead_stamp_ns_ = 0;      ///< ... to this one.
  std::uint64_t steps_back_ = 0;
  std::int64_t longest_back_ns_ = 0;
};

}  // namespace terracut::capture
