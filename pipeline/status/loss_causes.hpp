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

/// Every cause of loss under its name in reports ("network_gap_packets", "rejected_wrong_size"),
/// those that did not happen included. Allocates, as all here: not for real-time threads.
[[nodiscard]] std::vector<NamedCount> causes_of(const frame::LossCounters& losses);

/// What a live source did not pass on, or not as it should be; kernel_drops is among the other
/// losses.
[[nodiscard]] std::vector<NamedCount> causes_of(const net::ReceiveCounters& counters);

/// Whether a cause counts what a client that looks on did not get, of the page, of Foxglove's door
/// or of /metrics: nothing is lost between sensor and label, nor in what is recorded or handed on.
[[nodiscard]] bool is_of_onlookers(std::string_view cause) noexcept;

/// Where the datagrams of a live run went. With those in doubt they are what was received.
[[nodiscard]] std::vector<NamedCount> outcomes_of(const net::DatagramAccount& account);

/// Adds causes to the figures that watchers see. std::length_error when there is no room.
void show_losses(std::span<const NamedCount> causes, MonitorSnapshot& figures);

/// Shows what was received and where it went. std::length_error when there is no room.
void show_datagrams(const net::DatagramAccount& account, MonitorSnapshot& figures);

}  // namespace terracut::status
