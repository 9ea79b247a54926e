// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/figure.hpp"

#include <algorithm>
#include <cmath>

namespace terracut::status {
namespace {

/// Some 146 years: times up to this can be added or subtracted without overflow.
constexpr std::int64_t kFar_ns = std::int64_t{1} << 62;

bool is_possible_histogram(const measure::LogLinearHistogram& times) noexcept {
  const auto is_time = [](std::int64_t ns) { return ns >= 0 && ns < kFar_ns; };
  if (!is_time(times.max_ns()) || !is_time(times.min_ns())) return false;
  if (!std::isfinite(times.sum_ns()) || times.sum_ns() < 0) return false;
  if (times.mean_ns() >= static_cast<double>(kFar_ns)) return false;
  std::int64_t least_ns = 0;
  for (const double percent : {50.0, 90.0, 99.0, 99.9}) {
    const std::int64_t ns = times.percentile_ns(percent);
    if (ns < least_ns) return false;
    least_ns = ns;
  }
  return least_ns <= times.max_ns();
}

}  // namespace

Counts counts_of(std::string_view label, std::span<const NamedCount> counts) {
  Counts result{label, {}};
  for (const NamedCount& count : counts) result.each.emplace_back(count.name.view(), count.count);
  return result;
}

bool is_possible(const Value& value) noexcept {
  return std::visit(
      EachKind{[](const auto&) { return true; },
               [](const Number& of) { return of.value >= of.least && of.value <= of.most; },
               [](const TimeOfDay& of) { return of.ns >= 0 && of.ns < kFar_ns; },
               [](const Duration& of) { return of.ns > -kFar_ns && of.ns < kFar_ns; },
               [](const State& of) { return of.index < of.names.size(); },
               [](Histogram of) { return is_possible_histogram(*of); },
               [](const Histograms& of) {
                 return std::ranges::all_of(
                     of.each, [](const auto& each) { return is_possible_histogram(*each.second); });
               }},
      value);
}

bool is_nothing(const Value& value) noexcept {
  return std::visit(
      EachKind{
          [](NotKnown) { return true; }, [](bool of) { return !of; },
          [](std::uint64_t of) { return of == 0; }, [](const Number& of) { return of.value == 0; },
          [](const TimeOfDay& of) { return of.ns == 0; },
          [](const Duration& of) { return of.ns == 0; },
          [](const std::string& of) { return of.empty(); }, [](const State&) { return false; },
          [](const Counts& of) {
            return std::ranges::all_of(of.each, [](const auto& each) { return each.second == 0; });
          },
          [](Histogram of) { return of->max_ns() == 0; },
          [](const Histograms& of) { return of.each.empty(); }},
      value);
}

bool is_shown(const Figure& figure) noexcept {
  const auto& [line, text, shown] = figure.phrase;
  if (line.empty()) return false;
  return shown == Shown::kAlways || shown == Shown::kAlarmOrNone || !is_nothing(figure.value);
}

}  // namespace terracut::status
