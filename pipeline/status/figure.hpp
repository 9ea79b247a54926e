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

/// A time of day in nanoseconds since 1970; 0: unknown.
struct TimeOfDay {
  std::int64_t ns = 0;
};
/// A time span or a difference of two instants, which may be negative.
struct Duration {
  std::int64_t ns = 0;
};
/// A measured number and the range of its possible values.
struct Number {
  double value = 0, least = 0, most = 0;
};
/// One of several named states; an index beyond the names is impossible.
struct State {
  std::size_t index = 0;
  std::vector<std::string_view> names;
};
/// One figure for each of several names, such as causes or stages.
template <class Each>
struct ByName {
  std::string_view label;  ///< The kind of the names, as a label of the metric.
  std::vector<std::pair<std::string, Each>> each;
};
using Counts = ByName<std::uint64_t>;
[[nodiscard]] Counts counts_of(std::string_view label, std::span<const NamedCount> counts);
using Histogram = const measure::LogLinearHistogram*;
using Histograms = ByName<Histogram>;

struct NotKnown {};

using Value = std::variant<NotKnown, bool, std::uint64_t, Number, TimeOfDay, Duration, std::string,
                           State, Counts, Histogram, Histograms>;

/// A figure as shown under /metrics, in seconds if it is a duration; left out if `name` is empty.
struct Metric {
  std::string_view name;  ///< Ends in _total if it counts from the process' start.
  std::string_view help;  ///< Explanation; taken from the first figure of this name.
  std::vector<std::pair<std::string_view, std::string>> labels{};
};

enum class Shown : std::uint8_t {
  kAlways,
  kIfAny,        ///< Shown unless it is 0, false or empty.
  kAlarm,        ///< Like kIfAny, in the colour of an alarm.
  kAlarmOrNone,  ///< Like kAlarm, and otherwise "none".
};

/// The text of a figure in the lines for people (figure_lines.hpp); a histogram's text is its row
/// in the table of times. Left out if `line` is empty.
struct Phrase {
  std::string_view line;  ///< Title of the line that has the figure.
  /// A format for fmt: "{} packets"; for a duration "{ms}" or "{s}". The text follows the previous
  /// phrase after a comma, unless it begins with a space or a colon; if it begins with a line end,
  /// it begins a new line.
  std::string_view text = "{}";
  Shown shown = Shown::kAlways;
};

/// A measured value with its name, and the places where and the forms in which it is shown.
struct Figure {
  std::string_view key;  ///< In its JSON group, with unit: "deadline_ms"; empty: not in JSON.
  Value value;
  Metric metric{};
  Phrase phrase{};
  std::string group{};  ///< JSON group: "frames", "mount.seen"; digits are an index: "threads.0".
};

/// True if a process can have published this value; calculating with it is then safe.
[[nodiscard]] bool is_possible(const Value& value) noexcept;

/// True for 0, false or an empty value, and for times that are all 0.
[[nodiscard]] bool is_nothing(const Value& value) noexcept;

/// True if the figure is shown to people, in its line or in the table of times.
[[nodiscard]] bool is_shown(const Figure& figure) noexcept;

/// Combines functions so that one visitor takes each kind of value.
template <class... Functions>
struct EachKind : Functions... {
  using Functions::operator()...;
};

}  // namespace terracut::status
