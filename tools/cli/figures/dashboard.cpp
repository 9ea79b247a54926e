// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "dashboard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "pipeline/status/figures.hpp"
#include "pipeline/status/times_table.hpp"
#include "rt/measure/milliseconds.hpp"

namespace terracut::cli {
namespace {

using measure::milliseconds;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
// A running process writes its page many times a second, so an older page means that it hangs.
constexpr std::int64_t kStale_ns = 3 * kSecond_ns;

/// Returns "2 d 03:04:05".
std::string duration(std::int64_t ns) {
  const std::int64_t s = std::max<std::int64_t>(ns, 0) / kSecond_ns;
  const std::string days = s >= 86'400 ? fmt::format("{} d ", s / 86'400) : "";
  return fmt::format("{}{:02}:{:02}:{:02}", days, s / 3600 % 24, s / 60 % 60, s % 60);
}

std::string title(const status::MonitorSnapshot& figures, std::int64_t now_ns,
                  const status::LineStyle& style) {
  std::string text =
      status::in_bold(status::printable(fmt::format("terracut {}  {}", figures.version.view(),
                                                    figures.sensor.view())),
                      style);
  text += "\nup        " + duration(figures.taken_ns - figures.started_ns);
  if (const std::int64_t age_ns = now_ns - figures.taken_ns; age_ns >= kStale_ns) {
    text += fmt::format("{}   no news for {}: the process hangs or was stopped{}",
                        style.colours ? "\x1b[31m" : "", duration(age_ns),
                        style.colours ? "\x1b[0m" : "");
  }
  return text + '\n';
}

/// Draws a bar for each stage: '#' up to its median, '-' up to its p99, all relative to the
/// longest.
std::string bars_of_stages(const status::MonitorSnapshot& figures, const status::LineStyle& style) {
  constexpr int kBesideBar = 18 + 10 + 10 + 2;
  const auto width = static_cast<double>(std::clamp(style.columns - 1 - kBesideBar, 10, 60));
  std::int64_t longest_ns = 1;
  for (std::size_t i = 0; i < figures.stages(); ++i) {
    longest_ns = std::max(longest_ns, figures.stage_cpu[i].percentile_ns(99));
  }
  std::string text =
      status::in_bold(
          fmt::format("{:<18}{:>10}{:>10}  # p50  - p99", "stage, cpu ms", "p50", "p99"), style) +
      '\n';
  for (std::size_t i = 0; i < figures.stages(); ++i) {
    const std::int64_t p50_ns = figures.stage_cpu[i].percentile_ns(50);
    const std::int64_t p99_ns = figures.stage_cpu[i].percentile_ns(99);
    const auto cells = [&](std::int64_t ns) {
      return static_cast<std::size_t>(
          width * static_cast<double>(ns) / static_cast<double>(longest_ns) + 0.5);
    };
    const std::size_t filled = cells(p50_ns);
    text +=
        fmt::format("{:<18}{:>10.3f}{:>10.3f}  {:#<{}}{:-<{}}\n",
                    status::printable(figures.stage_names[i].view()), milliseconds(p50_ns),
                    milliseconds(p99_ns), "", filled, "", std::max(cells(p99_ns), filled) - filled);
  }
  return text;
}

}  // namespace

std::string dashboard(const status::MonitorSnapshot& figures, std::int64_t now_ns,
                      const status::LineStyle& style) {
  const std::vector<status::Figure> all = status::figures_of(figures);
  const std::string lines = title(figures, now_ns, style) + figure_lines(all, style);
  if (figures.frames == 0) return lines;
  return lines + '\n' + times_table(all, style) + '\n' + bars_of_stages(figures, style);
}

std::string closing_lines(const status::MonitorSnapshot& figures) {
  const std::vector<status::Figure> all = status::figures_of(figures);
  return figure_lines(all, {}) + (figures.frames > 0 ? times_table(all, {}) : "");
}

std::string why_no_frames(const status::MonitorSnapshot& figures) {
  if (figures.received == 0 && figures.before_labelling == 0) {
    return "no frame came out, because no datagram came in";
  }
  if (figures.received == 0) {
    return fmt::format(
        "no frame came out: all {} datagrams came before labelling began, while the sensor, its "
        "table and its mount were found. A sensor that goes on sending is labelled then; a capture "
        "needs `terracut send --loop`",
        figures.before_labelling);
  }
  return fmt::format("no frame came out of {} datagrams: {}{}", figures.received,
                     status::counts_text(figures.outcomes_in_use()),
                     figures.head_stands != 0 ? "; the sensor's head does not rotate" : "");
}

}  // namespace terracut::cli
