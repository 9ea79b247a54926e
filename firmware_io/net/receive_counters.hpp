// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/packet/datagram.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::net {

/// Counts what a live source received. received == delivered + foreign + other_interface +
/// truncated + no_datagram.
struct ReceiveCounters {
  std::uint64_t received = 0;   ///< Datagrams (for libpcap, frames) received from the kernel.
  std::uint64_t delivered = 0;  ///< Datagrams returned by receive().
  std::uint64_t foreign = 0;    ///< Datagrams from a sender other than the configured one.
  /// Datagrams from an interface other than the configured one.
  std::uint64_t other_interface = 0;
  std::uint64_t truncated = 0;    ///< Datagrams longer than a slot, so of no known sensor.
  std::uint64_t no_datagram = 0;  ///< Captured frames without a whole IPv4 UDP datagram.

  /// Datagrams dropped by the kernel: buffer full or wrong UDP checksum.
  std::uint64_t kernel_drops = 0;
  std::uint64_t unstamped = 0;  ///< Datagrams without a kernel stamp; they were stamped when read.
  std::uint64_t receive_errors = 0;  ///< Reads that failed.
  std::uint64_t link_losses = 0;     ///< Times the configured interface was found down or gone.
  std::uint64_t reopened = 0;        ///< Times the interface was replaced by one of the same name.

  /// Subtracts counters taken at an earlier moment.
  ReceiveCounters& operator-=(const ReceiveCounters& before) noexcept TERRACUT_NONBLOCKING {
    received -= before.received;
    delivered -= before.delivered;
    foreign -= before.foreign;
    other_interface -= before.other_interface;
    truncated -= before.truncated;
    no_datagram -= before.no_datagram;
    kernel_drops -= before.kernel_drops;
    unstamped -= before.unstamped;
    receive_errors -= before.receive_errors;
    link_losses -= before.link_losses;
    reopened -= before.reopened;
    return *this;
  }
};

/// The state of the configured interface; kUnknown if none is configured.
enum class LinkState : std::uint8_t { kUnknown, kUp, kDown, kGone };

/// The most datagrams that a source fetches at once by default: an HDL-64E sends 70 in 20 ms. If
/// fewer came, counting those left out, none was left waiting.
inline constexpr std::size_t kBatchDatagrams = 64;

/// The interface of UdpSource and LivePcapSource, for code that takes either:
///
/// counters()           kernel_drops as of the last batch that was full, or better after
///                      refresh_drops(), which asks the kernel.
/// receive(timeout_ns)  waits at most so long and returns what came, [1, batch] datagrams in order
///                      of arrival, or none: time is up, or somebody called wake(). Payloads are
///                      valid until the next call. Never waits longer, whatever the interface does.
/// wake()               ends the receive() under way, or the next one that would have to wait, with
///                      an empty result. From any thread or a signal handler.
/// Everything but wake() from one thread.
template <class Source>
concept DatagramSource = requires(Source& source, const Source& idle, std::int64_t timeout_ns) {
  { source.receive(timeout_ns) } noexcept -> std::same_as<std::span<const packet::Datagram>>;
  { idle.wake() } noexcept;
  { idle.counters() } noexcept -> std::same_as<const ReceiveCounters&>;
  { idle.link() } noexcept -> std::same_as<LinkState>;
};

}  // namespace terracut::net
