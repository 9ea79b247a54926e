// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/net/datagram_account.hpp"
#include "firmware_io/net/receive_counters.hpp"
#include "pipeline/status/monitor_snapshot.hpp"
#include "pipeline/status/named_count.hpp"

namespace terracut::status {

/// Returns every cause of loss by its name in reports ("network_gap_packets",
/// "rejected_wrong_size"), even with a count of 0. All functions here allocate: they are not for
/// real-time threads.
[[nodiscard]] std::vector<NamedCount> causes_of(const frame::LossCounters& losses);

/// Returns the datagrams that a live source did not pass on, or passed on with a fault, by cause;
/// kernel_drops is among the other losses.
[[nodiscard]] std::vector<NamedCount> causes_of(const net::ReceiveCounters& counters);

/// True if a cause counts what a viewing client missed (of the page, Foxglove or /metrics): in that
/// case nothing is lost between sensor and label, in recordings or in other outputs.
[[nodiscard]] bool is_of_onlookers(std::string_view cause) noexcept;

/// Returns where the datagrams of a live run went. The sum of these outcomes and of the datagrams
/// in doubt is all that was received.
[[nodiscard]] std::vector<NamedCount> outcomes_of(const net::DatagramAccount& account);

/// Adds causes of loss to the published figures. Throws std::length_error if there is no room.
void show_losses(std::span<const NamedCount> causes, MonitorSnapshot& figures);

/// Shows how many datagrams were received and where they went. Throws std::length_error if there is
/// no room.
void show_datagrams(const net::DatagramAccount& account, MonitorSnapshot& figures);

}  // namespace terracut::status
