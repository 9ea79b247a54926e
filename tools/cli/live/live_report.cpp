// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_report.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "tools/cli/blind_text.hpp"
#include "tools/cli/bus_text.hpp"
#include "tools/cli/counts_text.hpp"
#include "tools/cli/mount_text.hpp"

namespace terracut::cli {
namespace {

double ms(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-6;
}

std::string times(const rt::LogLinearHistogram& histogram) {
  return fmt::format("{:.2f} ms p50, {:.2f} p99, {:.2f} max", ms(histogram.percentile_ns(50)),
                     ms(histogram.percentile_ns(99)), ms(histogram.max_ns()));
}

std::string misses(const rt::MonitorSnapshot& figures) {
  std::string text =
      fmt::format("{} deadlines of {:.0f} ms", figures.all_misses(), ms(figures.deadline_ns));
  const char* before = ": ";
  for (std::size_t i = 0; i < rt::kMissCauses; ++i) {
    if (figures.misses[i] == 0) continue;
    text += fmt::format("{}{} {}", before, to_string(static_cast<rt::FrameMissCause>(i)),
                        figures.misses[i]);
    before = ", ";
  }
  return text;
}

std::string rungs(const rt::MonitorSnapshot& figures) {
  std::string text;
  for (std::size_t i = 0; i < rt::kRungs; ++i) {
    if (figures.rungs[i] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", to_string(static_cast<rt::Rung>(i)),
                        figures.rungs[i]);
  }
  return text.empty() ? "none" : text;
}

std::string losses(const rt::MonitorSnapshot& figures) {
  const std::string lost = counts_text(figures.losses_in_use());
  return lost.empty() ? "none" : lost;
}

}  // namespace

std::string live_report(const rt::MonitorSnapshot& figures) {
  std::string text = fmt::format(
      "frames    {} of {} packets: {}\nmissed    {}\nlatency   {}\nprocessor {}\nlosses    {}\n",
      figures.frames, figures.packets, rungs(figures), misses(figures), times(figures.latency),
      times(figures.total_cpu), losses(figures));
  if (const std::string blind = blind_text(blind_of(figures)); !blind.empty()) {
    text += "blind     " + blind + '\n';
  }
  if (figures.silences > 0) {
    text += fmt::format("silent    {} times, {:.1f} s in all\n", figures.silences,
                        static_cast<double>(figures.silent_ns) * 1e-9);
  }
  if (const std::string line = contradiction_text(figures.mount); !line.empty()) {
    text += "mount     " + line + '\n';
  }
  const char* begin = "motion    ";
  for (const std::string& line : motion_lines(figures.motion)) {
    text += begin + line + '\n';
    begin = "          ";
  }
  if (const std::string line = health_line(figures.health); !line.empty()) {
    text += "health    " + line + '\n';
  }
  return text;
}

std::string why_no_frames(const rt::MonitorSnapshot& figures) {
  if (figures.received == 0) return "no frame came out, because no datagram came in";
  std::string text = fmt::format("no frame came out of {} datagrams: {}", figures.received,
                                 counts_text(figures.outcomes_in_use()));
  if (figures.head_stands) text += "; the sensor's head does not turn";
  return text;
}

}  // namespace terracut::cli
