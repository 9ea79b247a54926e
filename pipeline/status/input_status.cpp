// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/input_status.hpp"

#include "pipeline/status/loss_causes.hpp"

namespace terracut::status {
namespace {

constexpr std::int64_t kSilence_ns = 1'000'000'000;

LinkState link_of(const InputState& input, const MonitorSnapshot& figures) noexcept {
  if (input.link == net::LinkState::kGone || input.link == net::LinkState::kDown) {
    return LinkState::kInterfaceGone;
  }
  if (figures.last_packet_ns == 0) return LinkState::kWaiting;
  const bool silent = figures.taken_ns - figures.last_packet_ns > kSilence_ns;
  return silent ? LinkState::kSilent : LinkState::kReceiving;
}

}  // namespace

std::string InputStatus::show(const InputState& input, MonitorSnapshot& figures) {
  show_datagrams(input.account, figures);
  figures.before_labelling = input.before_labelling;
  figures.head_stands = standing_head_.is_standing(input.account) ? 1 : 0;
  figures.blind_from_cdeg = input.blind.from_cdeg;
  figures.blind_to_cdeg = input.blind.to_cdeg;
  figures.last_packet_ns = input.newest_packet_ns;
  figures.link = link_of(input, figures);
  return news_.look(figures);
}

}  // namespace terracut::status
