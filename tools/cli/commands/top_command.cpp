// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "pipeline/page/status_page.hpp"
#include "pipeline/status/figures.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/export/live_process.hpp"
#include "tools/cli/figures/dashboard.hpp"
#include "tools/cli/figures/figures_json.hpp"
#include "tools/cli/json_text.hpp"

namespace terracut::cli {
namespace {

using Reader = page::StatusPageReader<status::MonitorSnapshot>;

status::LineStyle style_of_stdout() {
  status::LineStyle style{.columns = 80};
  style.colours = ::isatty(STDOUT_FILENO) == 1;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    style.columns = size.ws_col;
  }
  return style;
}

/// Overwrites the screen instead of clearing it, which would flicker: clears the rest of each line,
/// and the screen below the text.
std::string redrawn(const std::string& text) {
  std::string result = "\x1b[H";
  for (const char c : text) {
    if (c == '\n') result += "\x1b[K";
    result += c;
  }
  return result + "\x1b[J";
}

/// Ends the command because the page's figures are impossible.
ExitCode refuse_figures(const Reader& page, const std::string& name) {
  return refuse(kInputRefused,
                fmt::format("the status page '{}' (process {}) holds figures that cannot be: it is "
                            "damaged, or something else writes to it",
                            name, page.publisher_pid()));
}

/// Reads the figures. Waits a while if the publisher is held up in the middle of writing, as
/// happens on a busy machine.
std::optional<status::MonitorSnapshot> read_patiently(const Reader& page) {
  constexpr int kLooks = 100;
  constexpr std::chrono::milliseconds kPause{10};
  auto figures = page.read();
  for (int look = 1; !figures && page.publications() > 0 && look < kLooks; ++look) {
    std::this_thread::sleep_for(kPause);
    figures = page.read();
  }
  return figures;
}

ExitCode print_once(const Reader& page, const std::string& name, bool as_json) {
  const auto figures = read_patiently(page);
  if (!figures) {
    return refuse(
        kInputRefused,
        page.publications() == 0
            ? fmt::format("process {} has not published any figures yet", page.publisher_pid())
            : fmt::format("process {} is held up, or has ended, while it writes its "
                          "figures",
                          page.publisher_pid()));
  }
  if (!status::are_possible(*figures)) return refuse_figures(page, name);
  print_text(as_json ? json_text(live_summary(*figures))
                     : dashboard(*figures, measure::realtime_ns(), style_of_stdout()));
  if (!page.publisher_lives()) {
    return refuse(kInputRefused, fmt::format("process {} of '{}' is gone; these were its last "
                                             "figures",
                                             page.publisher_pid(), name));
  }
  return kOk;
}

ExitCode watch(const Reader& page, const std::string& name, double interval_s) {
  const bool terminal = ::isatty(STDOUT_FILENO) == 1;
  if (terminal) print_out("\x1b[2J");
  for (;;) {
    // Asked before the figures are read, so that a process's last figures are shown.
    const bool lives = page.publisher_lives();
    if (const auto figures = page.read()) {
      if (!status::are_possible(*figures)) return refuse_figures(page, name);
      const std::string text = dashboard(*figures, measure::realtime_ns(), style_of_stdout());
      print_text(terminal ? redrawn(text) : text + "\n");
      if (!flush_output()) return kOutputFailed;
    }
    if (!lives) {
      say(fmt::format("process {} of '{}' has ended", page.publisher_pid(), name));
      return kOk;
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(interval_s));
  }
}

}  // namespace

/// Reads the status page of a running process and nothing else.
ExitCode run_top(const Options& options) {
  std::string name = options.watched;
  if (name.empty()) {
    auto only_one = find_live_process(page::status_page_folder(), name);
    if (!only_one) return refuse(only_one.error());
    name = std::move(only_one->name);
  }
  const auto page = Reader::open(name, status::MonitorSnapshot::kLayout);
  if (!page) return refuse(page.error());
  if (options.once || options.print_json) return print_once(*page, name, options.print_json);
  return watch(*page, name, options.interval_s);
}

}  // namespace terracut::cli
