// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/measure/stolen_time.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

namespace terracut::measure {

StolenTime::StolenTime(ProcFile file, std::int64_t ticks_per_s)
    : file_(std::move(file)), ticks_per_s_(ticks_per_s) {}

Expected<StolenTime> StolenTime::open() {
  auto file = ProcFile::open("/proc/stat");
  if (!file) return tl::unexpected(file.error());
  return StolenTime(std::move(*file), ::sysconf(_SC_CLK_TCK));
}

std::optional<std::int64_t> StolenTime::read_ns() const noexcept TERRACUT_NONBLOCKING {
  std::array<char, 256> text;  // holds the first line (ten numbers), all that is needed
  return parse_ns(file_.read(text), ticks_per_s_);
}

std::optional<std::int64_t> StolenTime::parse_ns(
    std::string_view text, std::int64_t ticks_per_s) noexcept TERRACUT_NONBLOCKING {
  // Format of the first line: "cpu  user nice system idle iowait irq softirq steal guest
  // guest_nice".
  constexpr std::string_view kBegin = "cpu ";
  constexpr int kSteal = 7;
  if (text.size() < kBegin.size()) return std::nullopt;
  if (!std::equal(kBegin.begin(), kBegin.end(), text.begin())) return std::nullopt;
  text.remove_prefix(kBegin.size());
  const std::int64_t ticks = nth_number(text, kSteal);
  if (ticks < 0) return std::nullopt;
  return ticks * (1'000'000'000 / ticks_per_s);
}

}  // namespace terracut::measure
