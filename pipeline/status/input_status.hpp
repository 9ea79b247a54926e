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

/// The input as of the receiving thread's last look.
struct InputState {
  net::DatagramAccount account;  ///< Since labelling began.
  net::LinkState link = net::LinkState::kUnknown;
  std::int64_t newest_packet_ns = 0;  ///< Kernel's stamp; 0: none yet.
  /// Datagrams that came, or were dropped, before labelling began; not in `account`.
  std::uint64_t before_labelling = 0;
  frame::BlindAzimuths blind;
};

/// Keeps the figures of a live run's input: where each datagram went, whether the sensor is heard,
/// whether its head rotates, where it is blind. One thread, without a deadline.
class InputStatus {
 public:
  /// Shows `input` in `figures`, as of figures.taken_ns. Returns news for people if something has
  /// changed (LinkNews); usually empty.
  [[nodiscard]] std::string show(const InputState& input, MonitorSnapshot& figures);

 private:
  StandingHead standing_head_;
  LinkNews news_;
};

}  // namespace terracut::status
