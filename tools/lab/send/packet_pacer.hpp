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
/// is sent. Due times are instants of CLOCK_MONOTONIC, so that one late datagram does not delay
/// others.
///
/// The first datagram is due `start_delay_ns` after it is added; one stamped 1 s later is due 1 s /
/// rate after that. A datagram with an earlier stamp than the previous one is due together with it.
/// Datagrams with the same stamp are sent together. Fixed memory; one thread. add() puts that
/// thread to sleep and makes its timers exact (otherwise Linux delays them by 50 us).
class PacketPacer {
 public:
  /// `rate` is the speed relative to the stamps, (0, 1000], or 0 for as fast as possible.
  PacketPacer(double rate, memory::FixedMemory& memory, std::int64_t start_delay_ns = 0);

  /// Copies the datagram and plans it. If it is due later than those planned before, waits for
  /// their time and sends them. `sender` must live until flush().
  void add(const packet::Datagram& datagram, UdpSender& sender) noexcept;
  /// Waits for all planned datagrams and sends them.
  void flush() noexcept;

  /// Ends any waiting within a tenth of a second; nothing is sent any more. For any thread or a
  /// signal handler.
  void stop() noexcept { stopped_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool stopped() const noexcept { return stopped_.load(std::memory_order_relaxed); }

  /// Returns the delays from datagrams' due times to their system calls; empty at rate 0.
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
