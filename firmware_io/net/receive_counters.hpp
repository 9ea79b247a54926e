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

/// What a live source took in and what became of it.
/// received == delivered + foreign + other_interface + truncated + no_datagram.
struct ReceiveCounters {
  std::uint64_t received = 0;         ///< Datagrams (frames, for libpcap) the kernel handed over.
  std::uint64_t delivered = 0;        ///< Returned by receive().
  std::uint64_t foreign = 0;          ///< From another sender than the configured one.
  std::uint64_t other_interface = 0;  ///< Came in by another interface than the configured one.
  std::uint64_t truncated = 0;        ///< Longer than a slot, so no packet of any sensor we know.
  std::uint64_t no_datagram = 0;      ///< Captured frames that hold no whole IPv4 UDP datagram.

  std::uint64_t kernel_drops = 0;    ///< Never handed over: the kernel's buffer was full, or the
                                     ///< UDP checksum was wrong.
  std::uint64_t unstamped = 0;       ///< Without a kernel stamp; the time of reading was taken.
  std::uint64_t receive_errors = 0;  ///< Reads the system refused.
  std::uint64_t link_losses = 0;     ///< Times the configured interface was found down or gone.
  std::uint64_t reopened = 0;        ///< Times the socket was made anew for an interface that is
                                     ///< another one under the same name.

  /// What was counted since `before`.
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

/// How the interface that was asked for stands; kUnknown without one.
enum class LinkState : std::uint8_t { kUnknown, kUp, kDown, kGone };

/// Datagrams that a source takes in at once by default: an HDL-64E sends 70 in 20 ms. Where fewer
/// were received, those left out included, none was left waiting.
inline constexpr std::size_t kBatchDatagrams = 64;

/// What UdpSource and LivePcapSource have in common, for code that takes either:
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
