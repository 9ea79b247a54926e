// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/loss_causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace terracut::status {
namespace {

NamedCount rejected(frame::Reject reason, const frame::LossCounters& losses) {
  return {fmt::format("rejected_{}", to_string(reason)),
          losses.rejected[static_cast<std::size_t>(reason)]};
}

/// Copies `more` behind the first `count` elements of `all`, and adds its size to `count`.
template <std::size_t Size>
void append(std::span<const NamedCount> more, std::array<NamedCount, Size>& all,
            std::uint32_t& count) {
  if (more.size() > all.size() - count) throw std::length_error("too many names of counts");
  std::ranges::copy(more, all.begin() + count);
  count += static_cast<std::uint32_t>(more.size());
}

}  // namespace

std::vector<NamedCount> causes_of(const frame::LossCounters& losses) {
  std::vector<NamedCount> causes{{"kernel_drops", losses.kernel_drops},
                                 {"network_gap_packets", losses.network_gap_packets},
                                 {"azimuth_hole_columns", losses.azimuth_hole_columns}};
  for (std::size_t i = 0; i < frame::kRejectReasons; ++i) {
    causes.push_back(rejected(static_cast<frame::Reject>(i), losses));
  }
  causes.push_back({"overflow_full_returns", losses.overflow_full_returns});
  causes.push_back({"late_returns", losses.late_returns});
  causes.push_back({"skipped_frames", losses.skipped_frames});
  causes.push_back({"clock_jumps", losses.clock_jumps});
  return causes;
}

std::vector<NamedCount> causes_of(const net::ReceiveCounters& counters) {
  return {{"foreign_datagrams", counters.foreign},
          {"other_interface_datagrams", counters.other_interface},
          {"overlong_datagrams", counters.truncated},
          {"captured_no_datagram", counters.no_datagram},
          {"unstamped_datagrams", counters.unstamped},
          {"receive_errors", counters.receive_errors},
          {"link_losses", counters.link_losses}};
}

bool is_of_onlookers(std::string_view cause) noexcept {
  return cause.starts_with("view_") || cause.starts_with("foxglove_") ||
         cause.starts_with("metrics_") || cause.starts_with("unviewed_");
}

std::vector<NamedCount> outcomes_of(const net::DatagramAccount& account) {
  std::vector<NamedCount> outcomes{{"decoded", account.decoded},
                                   {"device_info", account.device_info},
                                   {"foreign", account.source.foreign},
                                   {"other_interface", account.source.other_interface},
                                   {"overlong", account.source.truncated},
                                   {"no_datagram", account.source.no_datagram},
                                   {"let_go", account.let_go}};
  for (std::size_t i = 0; i < frame::kRejectReasons; ++i) {
    const auto reason = static_cast<frame::Reject>(i);
    if (reason == frame::Reject::kDeviceInfo) continue;  // counted above; nothing is lost
    outcomes.push_back(rejected(reason, account.losses));
  }
  return outcomes;
}

void show_losses(std::span<const NamedCount> causes, MonitorSnapshot& figures) {
  append(causes, figures.losses, figures.loss_count);
}

void show_datagrams(const net::DatagramAccount& account, MonitorSnapshot& figures) {
  figures.received = account.source.received;
  figures.in_doubt = account.in_doubt;
  figures.packets = account.source.delivered;
  figures.outcome_count = 0;
  append(outcomes_of(account), figures.outcomes, figures.outcome_count);
}

}  // namespace terracut::status
