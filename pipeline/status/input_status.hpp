// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/net/datagram_account.hpp"
#include "firmware_io/net/receive_counters.hpp"
#include "pipeline/status/link_news.hpp"
#include "pipeline/status/monitor_snapshot.hpp"
#include "pipeline/status/standing_head.hpp"

namespace terracut::status {

/// The state of the input when the labelling thread last looked.
struct InputState {
  net::DatagramAccount account;  ///< Datagrams since labelling began.
  net::LinkState link = net::LinkState::kUnknown;
  std::int64_t newest_packet_ns = 0;  ///< Kernel's stamp of the newest packet; 0: none yet.
  /// Datagrams that came or were dropped before labelling began; they are not in `account`.
  std::uint64_t before_labelling = 0;
  frame::BlindAzimuths blind;
};

/// Keeps the figures of a live run's input: where each datagram went, whether the sensor is heard,
/// whether its head rotates, where it is blind. For one thread without a deadline.
class InputStatus {
 public:
  /// Writes `input` to `figures`, as of figures.taken_ns. Returns a sentence for people if the link
  /// has changed (LinkNews), else an empty text.
  [[nodiscard]] std::string show(const InputState& input, MonitorSnapshot& figures);

 private:
  StandingHead standing_head_;
  LinkNews news_;
};

}  // namespace terracut::status
