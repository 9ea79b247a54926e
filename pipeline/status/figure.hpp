// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "pipeline/status/named_count.hpp"
#include "rt/measure/log_linear_histogram.hpp"

namespace terracut::status {

/// Nanoseconds since 1970; 0: not known.
struct TimeOfDay {
  std::int64_t ns = 0;
};
/// A time span or a difference of two instants, which may be negative.
struct Duration {
  std::int64_t ns = 0;
};
/// A measured number and the range outside of which no process can have measured it.
struct Number {
  double value = 0, least = 0, most = 0;
};
/// One of several states, by their names; an index beyond them is possible for no process.
struct State {
  std::size_t index = 0;
  std::vector<std::string_view> names;
};
/// One figure for each of several names, such as causes or stages.
template <class Each>
struct ByName {
  std::string_view label;  ///< What the names are of, as a label of the metric.
  std::vector<std::pair<std::string, Each>> each;
};
using Counts = ByName<std::uint64_t>;
[[nodiscard]] Counts counts_of(std::string_view label, std::span<const NamedCount> counts);
using Histogram = const measure::LogLinearHistogram*;
using Histograms = ByName<Histogram>;

struct NotKnown {};

using Value = std::variant<NotKnown, bool, std::uint64_t, Number, TimeOfDay, Duration, std::string,
                           State, Counts, Histogram, Histograms>;

/// A figure under /metrics; without a name it is not there. Durations are seconds there.
struct Metric {
  std::string_view name;  ///< Ends in _total where it counts from the start of the process.
  std::string_view help;  ///< Of the first figure of this name.
  std::vector<std::pair<std::string_view, std::string>> labels{};
};

enum class Shown : std::uint8_t {
  kAlways,
  kIfAny,        ///< Unless it is 0, false or empty.
  kAlarm,        ///< As kIfAny, in the colour of an alarm.
  kAlarmOrNone,  ///< As kAlarm, and otherwise "none".
};

/// A figure in the lines for people (figure_lines.hpp), and a histogram in the table of times,
/// whose row `text` names; without a line it is not there.
struct Phrase {
  std::string_view line;  ///< What the line begins with.
  /// As for fmt: "{} packets"; of a duration "{ms}" or "{s}". It follows the phrase before after a
  /// comma, unless it begins with a space or a colon; with a line end it begins its line anew.
  std::string_view text = "{}";
  Shown shown = Shown::kAlways;
};

/// A figure, and where and how it is shown.
struct Figure {
  std::string_view key;  ///< Of JSON, in its group, with the unit: "deadline_ms"; empty: not there.
  Value value;
  Metric metric{};
  Phrase phrase{};
  std::string group{};  ///< Of JSON: "frames", "mount.seen"; digits are an index: "threads.0".
};

/// Whether a process can have published this, so that whatever shows it may calculate with it.
[[nodiscard]] bool is_possible(const Value& value) noexcept;

/// 0, false or empty; of times, all of them 0.
[[nodiscard]] bool is_nothing(const Value& value) noexcept;

/// Whether people are shown it, in its line or in the table of times.
[[nodiscard]] bool is_shown(const Figure& figure) noexcept;

/// Lets one function take each kind of value.
template <class... Functions>
struct EachKind : Functions... {
  using Functions::operator()...;
};

}  // namespace terracut::status
