// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "loss_table.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

namespace terracut::cli {

std::vector<LossCause> causes_of(const firmware_io::LossCounters& losses) {
  std::vector<LossCause> causes{{"kernel_drops", losses.kernel_drops},
                                {"network_gap_packets", losses.network_gap_packets},
                                {"azimuth_hole_columns", losses.azimuth_hole_columns}};
  for (std::size_t i = 0; i < firmware_io::kRejectReasons; ++i) {
    causes.push_back({fmt::format("rejected_{}", to_string(static_cast<firmware_io::Reject>(i))),
                      losses.rejected[i]});
  }
  causes.push_back({"overflow_full_returns", losses.overflow_full_returns});
  causes.push_back({"late_returns", losses.late_returns});
  causes.push_back({"skipped_frames", losses.skipped_frames});
  causes.push_back({"clock_jumps", losses.clock_jumps});
  return causes;
}

std::string loss_sentence(const firmware_io::LossCounters& losses) {
  std::string sentence;
  for (const LossCause& cause : causes_of(losses)) {
    if (cause.count == 0) continue;
    sentence += fmt::format("{}{} {}", sentence.empty() ? "" : ", ", cause.name, cause.count);
  }
  return sentence.empty() ? "none" : sentence;
}

void show_loss(std::string_view name, std::uint64_t count, rt::MonitorSnapshot& figures) {
  if (figures.loss_count >= figures.losses.size()) throw std::length_error("too many loss causes");
  figures.losses[figures.loss_count++] = {name, count};
}

void show_losses(const firmware_io::LossCounters& losses, rt::MonitorSnapshot& figures) {
  for (const LossCause& cause : causes_of(losses)) show_loss(cause.name, cause.count, figures);
}

std::vector<LossCause> outcomes_of(const firmware_io::DatagramAccount& account) {
  std::vector<LossCause> outcomes{{"decoded", account.decoded},
                                  {"device_info", account.device_info},
                                  {"foreign", account.source.foreign},
                                  {"other_interface", account.source.other_interface},
                                  {"overlong", account.source.truncated},
                                  {"no_datagram", account.source.no_datagram},
                                  {"let_go", account.let_go}};
  for (std::size_t i = 0; i < firmware_io::kRejectReasons; ++i) {
    const auto reason = static_cast<firmware_io::Reject>(i);
    if (reason == firmware_io::Reject::kDeviceInfo) continue;  // counted above: nothing is lost
    outcomes.push_back({fmt::format("rejected_{}", to_string(reason)), account.losses.rejected[i]});
  }
  return outcomes;
}

void show_datagrams(const firmware_io::DatagramAccount& account, rt::MonitorSnapshot& figures) {
  figures.received = account.source.received;
  figures.in_doubt = account.in_doubt;
  figures.packets = account.source.delivered;
  figures.outcome_count = 0;
  for (const LossCause& outcome : outcomes_of(account)) {
    if (figures.outcome_count >= figures.outcomes.size()) {
      throw std::length_error("too many outcomes of datagrams");
    }
    figures.outcomes[figures.outcome_count++] = {std::string_view(outcome.name), outcome.count};
  }
}

void show_losses(const firmware_io::ReceiveCounters& counters, rt::MonitorSnapshot& figures) {
  show_loss("foreign_datagrams", counters.foreign, figures);
  show_loss("other_interface_datagrams", counters.other_interface, figures);
  show_loss("overlong_datagrams", counters.truncated, figures);
  show_loss("captured_no_datagram", counters.no_datagram, figures);
  show_loss("unstamped_datagrams", counters.unstamped, figures);
  show_loss("receive_errors", counters.receive_errors, figures);
  show_loss("link_losses", counters.link_losses, figures);
}

}  // namespace terracut::cli
