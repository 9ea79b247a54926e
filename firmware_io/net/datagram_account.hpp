// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/net/receive_counters.hpp"

namespace terracut::net {

/// Accounts for the datagrams of a live run. At any time each datagram is counted exactly once:
///
///   source.received = source.foreign + source.other_interface + source.truncated
///                     + source.no_datagram    the source left them out
///                   + let_go                  too old for a label in time
///                   + device_info             hold no returns
///                   + losses.rejected, each   the decoder refused them
///                   + in_doubt                contradict the stream: kept, a few at most, until
///                                             they are decoded or refused
///                   + decoded                 their returns are in frames, or in
///                                             losses.overflow_full_returns
///
/// status::outcomes_of() lists these terms, except in_doubt, which is no counter. Datagrams that
/// never reached this process are in none of the terms: source.kernel_drops and
/// losses.network_gap_packets count these.
struct DatagramAccount {
  ReceiveCounters source;
  std::uint64_t let_go = 0;
  std::uint64_t device_info = 0;
  frame::LossCounters losses;
  std::uint64_t in_doubt = 0;
  std::uint64_t decoded = 0;

  [[nodiscard]] bool balances() const noexcept {
    return source.received == source.foreign + source.other_interface + source.truncated +
                                  source.no_datagram + let_go + device_info +
                                  losses.rejected_total() + in_doubt + decoded;
  }
};

}  // namespace terracut::net
