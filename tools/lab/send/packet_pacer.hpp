// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/packet/datagram.hpp"
#include "rt/measure/log_linear_histogram.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "udp_sender.hpp"

namespace terracut::send {

/// Sends datagrams at the times of their stamps, as a sensor would, and measures how late each one
/// was. A deadline is an instant of CLOCK_MONOTONIC, so that being late once does not shift the
/// rest.
///
/// The first datagram is due `start_delay_ns` after it is added; one stamped 1 s later is due
/// 1 s / rate after that. A stamp behind the one before is due with it. Datagrams of one stamp go
/// out together. Fixed memory; one thread, which add() puts to sleep and whose timers it makes
/// exact (Linux delays them by 50 us otherwise).
class PacketPacer {
 public:
  /// `rate`: speed against the stamps, (0, 1000], or 0 for as fast as the system takes them.
  PacketPacer(double rate, memory::FixedMemory& memory, std::int64_t start_delay_ns = 0);

  /// Copies the datagram and plans it; sends those before it when it is due later than they are,
  /// after waiting for their time. `sender` must live until flush().
  void add(const packet::Datagram& datagram, UdpSender& sender) noexcept;
  /// Waits for what is still planned and sends it.
  void flush() noexcept;

  /// Ends the waiting within a tenth of a second and lets nothing be sent any more. From any thread
  /// or a signal handler.
  void stop() noexcept { stopped_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool stopped() const noexcept { return stopped_.load(std::memory_order_relaxed); }

  /// From when each datagram was due until it was given to the system; empty at rate 0.
  [[nodiscard]] const measure::LogLinearHistogram& lateness() const noexcept { return lateness_; }

 private:
  static_assert(std::atomic<bool>::is_always_lock_free, "stop() must suit signal handlers");

  /// More than the longest payload.
  static constexpr std::size_t kArenaBytes = 128U << 10;

  [[nodiscard]] std::int64_t due_ns(std::int64_t stamp_ns) noexcept;
  void sleep_until(std::int64_t due_ns) const noexcept;

  double rate_;
  std::int64_t start_delay_ns_;
  std::span<std::uint8_t> arena_;
  std::span<packet::Datagram> planned_;
  std::size_t planned_count_ = 0, arena_used_ = 0;
  UdpSender* sender_ = nullptr;
  std::int64_t planned_due_ns_ = 0;

  bool begun_ = false;
  std::int64_t first_stamp_ns_ = 0, first_due_ns_ = 0;
  measure::LogLinearHistogram lateness_;
  std::atomic<bool> stopped_ = false;
};

}  // namespace terracut::send
