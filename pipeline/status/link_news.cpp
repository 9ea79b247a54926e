// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "link_news.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace terracut::status {

LinkNews::Trouble LinkNews::trouble_of(const MonitorSnapshot& figures) noexcept {
  if (figures.link == LinkState::kInterfaceGone) return Trouble::kInterfaceGone;
  if (figures.link == LinkState::kSilent) return Trouble::kSilent;
  return figures.head_stands ? Trouble::kHeadStands : Trouble::kNone;
}

std::string LinkNews::look(MonitorSnapshot& figures) {
  const Trouble before = trouble_;
  trouble_ = trouble_of(figures);
  const auto is_silence = [](Trouble trouble) {
    return trouble == Trouble::kSilent || trouble == Trouble::kInterfaceGone;
  };
  const std::int64_t lasted_ns = std::max<std::int64_t>(figures.taken_ns - since_ns_, 0);
  if (is_silence(before) && !is_silence(trouble_)) silent_ns_ += lasted_ns;
  if (is_silence(trouble_) && !is_silence(before)) ++silences_;
  const bool goes_on = is_silence(before) && is_silence(trouble_);
  if (trouble_ != before && !goes_on) {
    const bool counts_from_packet = is_silence(trouble_) && figures.last_packet_ns > 0;
    since_ns_ = counts_from_packet ? figures.last_packet_ns : figures.taken_ns;
  }
  figures.silences = silences_;
  figures.silent_ns = silent_ns_;
  if (is_silence(trouble_))
    figures.silent_ns += std::max<std::int64_t>(figures.taken_ns - since_ns_, 0);

  if (trouble_ == before) return {};
  const double lasted_s = static_cast<double>(lasted_ns) * 1e-9;
  switch (trouble_) {
    case Trouble::kSilent:
      return fmt::format("the sensor is silent: no packet for {:.1f} s",
                         static_cast<double>(figures.taken_ns - since_ns_) * 1e-9);
    case Trouble::kInterfaceGone:
      return "the network interface is down or gone; it is waited for";
    case Trouble::kHeadStands:
      return "the sensor's head does not rotate: its packets come, but no frames";
    case Trouble::kNone:
      break;
  }
  return before == Trouble::kHeadStands
             ? fmt::format("the sensor's head rotates again, after {:.1f} s", lasted_s)
             : fmt::format("the sensor is heard again, after {:.1f} s", lasted_s);
}

}  // namespace terracut::status
