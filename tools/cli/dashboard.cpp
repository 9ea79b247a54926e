// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "dashboard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "blind_text.hpp"
#include "bus_text.hpp"
#include "counts_text.hpp"
#include "mount_text.hpp"

namespace terracut::cli {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kStale_ns = 3 * kSecond_ns;  // a page is written many times a second

double milliseconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-6;
}

/// "2 d 03:04:05"
std::string duration(std::int64_t ns) {
  const std::int64_t s = std::max<std::int64_t>(ns, 0) / kSecond_ns;
  const std::string days = s >= 86'400 ? fmt::format("{} d ", s / 86'400) : "";
  return fmt::format("{}{:02}:{:02}:{:02}", days, s / 3600 % 24, s / 60 % 60, s % 60);
}

class Dashboard {
 public:
  Dashboard(const rt::MonitorSnapshot& figures, std::int64_t now_ns, const DashboardStyle& style)
      : figures_(figures), now_ns_(now_ns), style_(style) {}

  [[nodiscard]] std::string text() && {
    add_process();
    add_link();
    add_deadline();
    line("rungs     {}", counts_of_rungs());
    line("");
    add_times();
    line("");
    add_stages();
    line("");
    add_losses();
    add_mount();
    add_buses();
    add_threads();
    return std::move(text_);
  }

 private:
  void add_process() {
    line("{}", bold(fmt::format("terracut {}  {}", printable(figures_.version.view()),
                                printable(figures_.sensor.view()))));
    const std::int64_t age_ns = now_ns_ - figures_.taken_ns;
    line("up        {}{}", duration(figures_.taken_ns - figures_.started_ns),
         age_ns < kStale_ns
             ? ""
             : alarm(fmt::format("   no news for {}: the process hangs or was stopped",
                                 duration(age_ns))));
  }

  void add_link() {
    const std::string age =
        figures_.last_packet_ns == 0
            ? "no packet yet"
            : fmt::format("last packet {:.3f} s ago",
                          std::max(milliseconds(now_ns_ - figures_.last_packet_ns), 0.0) / 1000.0);
    const std::string state =
        fmt::format("{}{}{}", to_string(figures_.link), figures_.input.empty() ? "" : " on ",
                    printable(figures_.input.view()));
    line("link      {}, {}, {} packets",
         figures_.link == rt::LinkState::kReceiving ? state : alarm(state), age, figures_.packets);
    if (figures_.head_stands) line("          {}", alarm("the sensor's head does not turn"));
    if (figures_.silences > 0) {
      line("          silent {} times, {:.1f} s in all", figures_.silences,
           milliseconds(figures_.silent_ns) / 1000.0);
    }
    if (const std::string blind = blind_text(blind_of(figures_)); !blind.empty()) {
      line("blind     {}", blind);
    }
    line("frames    {:.2f} /s, {} so far, {} returns", figures_.frames_per_s, figures_.frames,
         figures_.returns);
  }

  void add_deadline() {
    const std::uint64_t misses = figures_.all_misses();
    std::string causes;
    for (std::size_t i = 0; i < rt::kMissCauses; ++i) {
      if (figures_.misses[i] == 0) continue;
      causes += fmt::format("{} {} {}", causes.empty() ? ":" : ",",
                            to_string(static_cast<rt::FrameMissCause>(i)), figures_.misses[i]);
    }
    const double percent = figures_.frames == 0 ? 0.0
                                                : 100.0 * static_cast<double>(misses) /
                                                      static_cast<double>(figures_.frames);
    const std::string missed = fmt::format("{} missed ({:.3f} %){}", misses, percent, causes);
    line("deadline  {:.1f} ms, {}", milliseconds(figures_.deadline_ns),
         figures_.consecutive_misses == 0 ? missed : alarm(missed));
    if (misses > 0) {
      line("          {} missed in a row now, {} at most", figures_.consecutive_misses,
           figures_.longest_run_of_misses);
    }
    if (figures_.unjudged > 0) {
      line("          {} frames not judged: their stamps give no latency", figures_.unjudged);
    }
  }

  [[nodiscard]] std::string counts_of_rungs() const {
    std::string text;
    for (std::size_t i = 0; i < rt::kRungs; ++i) {
      text += fmt::format("{}{} {}", i == 0 ? "" : ", ", to_string(static_cast<rt::Rung>(i)),
                          figures_.rungs[i]);
    }
    return text;
  }

  void add_times() {
    line("{}", bold(fmt::format("{:<18}{:>10}{:>10}{:>10}{:>10}{:>10}", "ms", "p50", "p90", "p99",
                                "p99.9", "max")));
    add_time("latency", figures_.latency);
    add_time("hand-over > labels", figures_.wall);
    add_time("cpu, all", figures_.total_cpu);
    add_time("cpu, decode", figures_.decode_cpu);
    add_time("cpu, segment", figures_.segment_cpu);
  }

  void add_time(std::string_view name, const rt::LogLinearHistogram& times) {
    line("{:<18}{:>10.3f}{:>10.3f}{:>10.3f}{:>10.3f}{:>10.3f}", name,
         milliseconds(times.percentile_ns(50)), milliseconds(times.percentile_ns(90)),
         milliseconds(times.percentile_ns(99)), milliseconds(times.percentile_ns(99.9)),
         milliseconds(times.max_ns()));
  }

  /// A bar a stage: '#' up to its median, '-' on to its p99, all on the scale of the longest.
  void add_stages() {
    constexpr int kBesideBar = 18 + 10 + 10 + 2;
    const auto width = static_cast<double>(std::clamp(style_.columns - 1 - kBesideBar, 10, 60));
    std::int64_t longest_ns = 1;
    for (std::size_t i = 0; i < figures_.stages(); ++i) {
      longest_ns = std::max(longest_ns, figures_.stage_cpu[i].percentile_ns(99));
    }
    line("{}",
         bold(fmt::format("{:<18}{:>10}{:>10}  # p50  - p99", "stage, cpu ms", "p50", "p99")));
    for (std::size_t i = 0; i < figures_.stages(); ++i) {
      const std::int64_t p50_ns = figures_.stage_cpu[i].percentile_ns(50);
      const std::int64_t p99_ns = figures_.stage_cpu[i].percentile_ns(99);
      const auto cells = [&](std::int64_t ns) {
        return static_cast<std::size_t>(
            width * static_cast<double>(ns) / static_cast<double>(longest_ns) + 0.5);
      };
      const std::size_t filled = cells(p50_ns);
      line("{:<18}{:>10.3f}{:>10.3f}  {}{}", printable(figures_.stage_names[i].view()),
           milliseconds(p50_ns), milliseconds(p99_ns), std::string(filled, '#'),
           std::string(std::max(cells(p99_ns), filled) - filled, '-'));
    }
  }

  void add_losses() {
    const std::string lost = counts_text(figures_.losses_in_use());
    line("losses    {}", lost.empty() ? "none" : alarm(lost));
  }

  void add_mount() {
    if (const std::string text = contradiction_text(figures_.mount); !text.empty()) {
      line("mount     {}", alarm(text));
    }
  }

  void add_buses() {
    const rt::MotionFigures& motion = figures_.motion;
    const char* begin = "motion    ";
    for (const std::string& text : motion_lines(motion)) {
      line("{}{}", begin, motion.state == rt::MotionState::kKnown ? text : alarm(text));
      begin = "          ";
    }
    const rt::HealthFigures& health = figures_.health;
    if (health.bus.empty()) return;
    const bool all_sent = health.queue_full + health.link_down + health.failed == 0;
    line("health    {}", all_sent ? health_line(health) : alarm(health_line(health)));
  }

  void add_threads() {
    for (const rt::ThreadStatus& thread : figures_.threads_in_use()) {
      const std::string faults =
          fmt::format("page faults {} minor, {} major", thread.minor_faults, thread.major_faults);
      line("thread    {:<10}{:<26}{}", printable(thread.name.view()),
           printable(thread.scheduling.view()),
           thread.minor_faults + thread.major_faults == 0 ? faults : alarm(faults));
    }
  }

  template <class... Values>
  void line(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    text_ += '\n';
  }
  [[nodiscard]] std::string bold(const std::string& text) const {
    return style_.colours ? "\x1b[1m" + text + "\x1b[0m" : text;
  }
  [[nodiscard]] std::string alarm(const std::string& text) const {
    return style_.colours ? "\x1b[31m" + text + "\x1b[0m" : text;
  }

  const rt::MonitorSnapshot& figures_;
  std::int64_t now_ns_;
  DashboardStyle style_;
  std::string text_;
};

}  // namespace

std::string dashboard(const rt::MonitorSnapshot& figures, std::int64_t now_ns,
                      const DashboardStyle& style) {
  return Dashboard(figures, now_ns, style).text();
}

}  // namespace terracut::cli
