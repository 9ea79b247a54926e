// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/recorder/dump_policy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace terracut::recorder {
namespace {

void check(const DumpRate& rate) {
  if (!(rate.interval_s > 0 && rate.interval_s <= 1e6) || rate.burst < 1 || rate.burst > 1000) {
    throw std::invalid_argument(
        fmt::format("dump rate: {} at once and one every {} s; expected 1 to 1000, and more than "
                    "0 s up to 1e6 s",
                    rate.burst, rate.interval_s));
  }
}

}  // namespace

DumpPolicy::DumpPolicy(const DumpLimits& limits) : folder_(limits.folder) {
  check(limits.missed_deadline);
  check(limits.asked);
  allowances_[static_cast<std::size_t>(DumpReason::kMissedDeadline)].rate = limits.missed_deadline;
  allowances_[static_cast<std::size_t>(DumpReason::kAsked)].rate = limits.asked;
}

tl::expected<void, RefusedDump> DumpPolicy::admit(DumpReason reason, std::int64_t monotonic_ns) {
  ++counters_.wanted[static_cast<std::size_t>(reason)];
  Allowance& allowance = allowances_[static_cast<std::size_t>(reason)];
  const auto burst = static_cast<double>(allowance.rate.burst);
  if (!allowance.started) {
    allowance.started = true;
    allowance.left = burst;
  } else {
    const auto passed_s = static_cast<double>(monotonic_ns - allowance.filled_ns) * 1e-9;
    allowance.left =
        std::min(burst, allowance.left + std::max(0.0, passed_s) / allowance.rate.interval_s);
  }
  allowance.filled_ns = monotonic_ns;
  if (allowance.left < 1) {
    return refuse(
        {DumpRefusal::kTooSoon,
         fmt::format("the last dump for this reason ({}) was too short a time ago; the "
                     "next is allowed in {:.1f} s",
                     to_string(reason), (1 - allowance.left) * allowance.rate.interval_s)});
  }
  allowance.left -= 1;
  return {};
}

tl::expected<std::filesystem::path, RefusedDump> DumpPolicy::make_room(std::uint64_t bytes,
                                                                       DumpReason reason,
                                                                       std::int64_t realtime_ns) {
  auto path = folder_.make_room(bytes, reason, realtime_ns);
  counters_.deleted = folder_.deleted();
  if (!path) return refuse(std::move(path.error()));
  return path;
}

tl::unexpected<RefusedDump> DumpPolicy::refuse(RefusedDump refused) {
  ++counters_.refused[static_cast<std::size_t>(refused.refusal)];
  return tl::unexpected(std::move(refused));
}

}  // namespace terracut::recorder
