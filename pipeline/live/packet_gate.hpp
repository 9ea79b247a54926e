// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "rt/threads/nonblocking.hpp"

namespace terracut::live {

/// Decides which packets to decode when more come than this machine can handle. The kernel's buffer
/// is a queue of more than a second; without the gate every label would be that late during an
/// overload. There are two rules.
///
/// A packet is dropped if it is older than a frame's duration and the deadline together: its frame
/// is late, whatever is done now. After a standstill this drops the useless packets and no others.
///
/// The backlog is dropped after three frames in a row were labelled too late. This thread
/// catches up with a standstill within two frames, so three late frames mean that it is too slow
/// for the load. It goes on with the newest packets; later frames are in time until the lag has
/// grown again.
///
/// Ages are measured by CLOCK_REALTIME, like the kernel's stamps: a step of the clock costs at most
/// the packets then waiting in the buffer. One thread; reads no clock.
class PacketGate {
 public:
  /// `frame_period_ns` is the duration of one revolution.
  PacketGate(std::int64_t deadline_ns, std::int64_t frame_period_ns) noexcept
      : deadline_ns_(deadline_ns), oldest_useful_ns_(deadline_ns + frame_period_ns) {}

  /// Notes that a batch of packets was fetched. `more_may_wait` says that it was full.
  void begin_batch(bool more_may_wait) noexcept TERRACUT_NONBLOCKING {
    if (!more_may_wait) lets_backlog_go_ = false;
  }
  /// True if a packet of this batch is to be decoded.
  [[nodiscard]] bool lets_in(std::int64_t stamp_ns,
                             std::int64_t now_ns) const noexcept TERRACUT_NONBLOCKING {
    return !lets_backlog_go_ && now_ns - stamp_ns <= oldest_useful_ns_;
  }
  /// Notes that a frame whose last packet has this stamp was labelled.
  void note_frame(std::int64_t last_packet_ns, std::int64_t now_ns) noexcept TERRACUT_NONBLOCKING {
    late_frames_ = now_ns - last_packet_ns > deadline_ns_ ? late_frames_ + 1 : 0;
    if (late_frames_ < kCatchesUpWithin) return;
    lets_backlog_go_ = true;
    late_frames_ = 0;
  }

 private:
  static constexpr int kCatchesUpWithin = 3;

  std::int64_t deadline_ns_, oldest_useful_ns_;
  int late_frames_ = 0;  ///< Successive frames labelled too late.
  bool lets_backlog_go_ = false;
};

}  // namespace terracut::live
