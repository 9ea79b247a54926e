// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_io/live/datagram_account.hpp"
#include "firmware_io/live/receive_counters.hpp"
#include "firmware_io/loss_counters.hpp"
#include "rt/monitor_snapshot.hpp"

namespace terracut::cli {

/// One cause of loss under its name in reports.
struct LossCause {
  std::string name;  ///< "network_gap_packets", "rejected_wrong_size", ...
  std::uint64_t count = 0;
};

/// Every cause, those that did not happen included, in the order of LossCounters.
[[nodiscard]] std::vector<LossCause> causes_of(const firmware_io::LossCounters& losses);

/// "none", or the causes that happened: "network_gap_packets 12, rejected_late 1".
[[nodiscard]] std::string loss_sentence(const firmware_io::LossCounters& losses);

/// Where the datagrams of a live run went: the counts of DatagramAccount, those that are 0
/// included. With those in doubt they are what was received.
[[nodiscard]] std::vector<LossCause> outcomes_of(const firmware_io::DatagramAccount& account);

/// Shows what was received and where it went. Allocates; std::length_error when there is no room.
void show_datagrams(const firmware_io::DatagramAccount& account, rt::MonitorSnapshot& figures);

/// Adds a cause to the figures that watchers see. std::length_error when there is no room.
void show_loss(std::string_view name, std::uint64_t count, rt::MonitorSnapshot& figures);

/// Adds every cause. Allocates: not for real-time threads.
void show_losses(const firmware_io::LossCounters& losses, rt::MonitorSnapshot& figures);

/// Adds what a live source did not pass on, or not as it should be; kernel_drops is among the other
/// losses.
void show_losses(const firmware_io::ReceiveCounters& counters, rt::MonitorSnapshot& figures);

}  // namespace terracut::cli
