// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "rt/threads/nonblocking.hpp"

namespace terracut::live {

/// Decides how long packets may gather in the kernel's buffer before they are fetched together:
/// waking up for every packet costs more than decoding it. The buffer never gets more than half
/// full. Real-time safe; one thread.
class GatheringPolicy {
 public:
  struct Config {
    std::int64_t frame_period_ns = 0;  ///< Duration of one revolution of the head.
    std::int64_t longest_ns = 0;  ///< Longest time packets may gather; 0: fetch each as it comes.
    /// The number of packets for which the kernel's buffer has room.
    std::size_t room_packets = std::numeric_limits<std::uint32_t>::max();
  };
  explicit GatheringPolicy(const Config& config) noexcept
      : config_(config),
        frame_period_ns_(config.frame_period_ns),
        time_ns_(time_ns(kMostPacketsAFrame)) {}

  /// Returns how long the next packets may gather.
  [[nodiscard]] std::int64_t time_ns() const noexcept { return time_ns_; }

  /// Learns from a frame. `last_packet_ns` is the stamp of its last packet. `received` counts all
  /// datagrams up to now, as those of other senders fill the buffer, too. The period may become
  /// shorter than configured (a head set to rotate faster) but never longer: a lost frame looks
  /// like a slower head.
  void note_frame(std::int64_t last_packet_ns, std::uint64_t received) noexcept {
    const std::int64_t period_ns = last_packet_ns - std::exchange(last_packet_ns_, last_packet_ns);
    frame_period_ns_ = std::clamp<std::int64_t>(period_ns, 0, config_.frame_period_ns);
    const std::uint64_t packets = received - std::exchange(received_before_, received);
    if (period_ns == last_packet_ns) return;  // the first frame may have begun anywhere
    // A flood shortens gathering at once, and for some seconds after its end.
    many_packets_ = std::max(many_packets_ - many_packets_ / 16, packets);
    time_ns_ = time_ns(many_packets_);
  }
  /// Takes the number of datagrams received before the first frame.
  void begin(std::uint64_t received) noexcept { received_before_ = received; }

 private:
  /// Packets per frame of a VLS-128 in dual return at 10 Hz.
  static constexpr std::uint64_t kMostPacketsAFrame = 1875;

  /// Returns the time in which half the kernel's buffer fills at this number of packets per frame,
  /// or the longest that is wanted.
  [[nodiscard]] std::int64_t time_ns(std::uint64_t packets_a_frame) const noexcept {
    const double share_of_frame = static_cast<double>(config_.room_packets / 2) /
                                  static_cast<double>(std::max<std::uint64_t>(packets_a_frame, 1));
    const double half_full_ns = share_of_frame * static_cast<double>(frame_period_ns_);
    return static_cast<std::int64_t>(
        std::min(static_cast<double>(config_.longest_ns), half_full_ns));
  }

  Config config_;
  std::int64_t frame_period_ns_;  ///< Period of the newest frame, or less.
  std::int64_t time_ns_;
  std::uint64_t many_packets_ = 0;     ///< The most packets in a recent frame.
  std::uint64_t received_before_ = 0;  ///< Datagrams received up to the end of the last frame.
  std::int64_t last_packet_ns_ = 0;    ///< Stamp of the newest frame's last packet.
};

}  // namespace terracut::live
