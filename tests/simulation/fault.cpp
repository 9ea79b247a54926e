// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tests/simulation/fault.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <vector>

#include "tests/simulation/dice.hpp"

namespace terracut::simulation {
namespace {

constexpr auto kKinds = static_cast<std::size_t>(FaultKind::kCount);

/// The sizes a kind of fault may have; 0: it has none.
struct Sizes {
  std::string_view name;
  std::int64_t most_span_ms = 0, most_amount = 0;
  bool may_be_negative = false;
};
constexpr std::int64_t kHour_ms = 3'600'000;
constexpr std::array<Sizes, kKinds> kSizes{{
    {"loss", 0, 400},
    {"reorder", 0, 12},
    {"duplicate", 0, 50},
    {"truncated", 0, 50},
    {"garbage", 0, 500},
    {"burst", 400, 0},
    {"cable_pulled", 2'000, 0},
    {"sensor_restart", 3'000, 999},
    {"device_clock", 0, kHour_ms, true},
    {"device_clock_slow", 1'500, 4'000},
    {"head_stands", 2'000, 0},
    {"other_sender", 1'000, 20'000},
    {"twin", 1'500, 0},
    {"host_clock", 0, kHour_ms, true},
    {"stolen_core", 2'000, 0},
    {"slow_work", 1'500, 200},
    {"outlet_stalls", 3'000, 0},
    {"labels_stall", 3'000, 0},
    {"monitor_stalls", 8'000, 0},
    {"motion_stops", 2'000, 0},
}};

bool read_number(std::string_view& text, std::int64_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}
bool read_sign(std::string_view& text, char sign) {
  if (!text.starts_with(sign)) return false;
  text.remove_prefix(1);
  return true;
}

bool read_fault(std::string_view text, Fault& fault) {
  const std::string_view name = text.substr(0, text.find('@'));
  const auto* const found = std::ranges::find(kSizes, name, &Sizes::name);
  if (found == kSizes.end()) return false;
  fault.kind = static_cast<FaultKind>(found - kSizes.begin());
  text.remove_prefix(name.size());
  return read_sign(text, '@') && read_number(text, fault.at_ms) && read_sign(text, '+') &&
         read_number(text, fault.span_ms) && read_sign(text, '*') &&
         read_number(text, fault.amount) && text.empty();
}

}  // namespace

std::string_view to_string(FaultKind kind) noexcept {
  return kind < FaultKind::kCount ? kSizes[static_cast<std::size_t>(kind)].name : "unknown";
}

Faults faults_of(std::uint64_t seed) {
  constexpr std::int64_t kFirst_ms = 2'000, kLast_ms = 18'000;
  Dice dice(seed);
  Faults faults(static_cast<std::size_t>(dice.between(1, 8)));
  // Every other seed has its faults close together, so that one falls into the other's wake.
  const bool close = dice.between(0, 1) == 0;
  const std::int64_t middle_ms = dice.between(kFirst_ms, kLast_ms - 1'000);
  // Few kinds at a time: what must hold where only these happen can then be looked at.
  std::vector<std::size_t> kinds(static_cast<std::size_t>(dice.between(1, 4)));
  for (std::size_t& kind : kinds) kind = static_cast<std::size_t>(dice.between(0, kKinds - 1));
  for (Fault& fault : faults) {
    const std::size_t kind = kinds[static_cast<std::size_t>(
        dice.between(0, static_cast<std::int64_t>(kinds.size()) - 1))];
    const Sizes& sizes = kSizes[kind];
    fault.kind = static_cast<FaultKind>(kind);
    fault.at_ms = close ? middle_ms + dice.between(0, 1'000) : dice.between(kFirst_ms, kLast_ms);
    if (sizes.most_span_ms > 0) fault.span_ms = dice.of_any_size(sizes.most_span_ms);
    if (sizes.most_amount > 0) fault.amount = dice.of_any_size(sizes.most_amount);
    if (sizes.may_be_negative && dice.between(0, 1) == 0) fault.amount = -fault.amount;
  }
  std::ranges::sort(faults, {}, &Fault::at_ms);
  return faults;
}

std::string to_string(const Faults& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    text += fmt::format("{}{}@{}+{}*{}", text.empty() ? "" : " ", to_string(fault.kind),
                        fault.at_ms, fault.span_ms, fault.amount);
  }
  return text;
}

Expected<Faults> parse_faults(std::string_view text) {
  Faults faults;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (word.empty()) continue;
    if (!read_fault(word, faults.emplace_back())) {
      return fail(ErrorCode::kInvalidArgument,
                  fmt::format("'{}' is no fault; expected kind@at_ms+span_ms*amount, for example "
                              "stolen_core@2000+250*0",
                              word));
    }
  }
  return faults;
}

}  // namespace terracut::simulation
