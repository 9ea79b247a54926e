// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "dashboard.hpp"
#include "figures_check.hpp"
#include "json_text.hpp"
#include "live_summary.hpp"
#include "rt/status_page.hpp"
#include "rt/status_page_list.hpp"

namespace terracut::cli {
namespace {

using Reader = rt::StatusPageReader<rt::MonitorSnapshot>;

std::int64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

/// The name of the one process that runs. Errors: none runs, or several do.
Expected<std::string> name_of_the_only_one() {
  const std::string folder = rt::status_page_folder().string();
  std::vector<std::string> running;
  std::string left_over;
  for (const rt::StatusPageEntry& page : rt::list_status_pages(folder)) {
    if (page.publisher_lives) {
      running.push_back(page.name);
    } else {
      left_over +=
          fmt::format("; the page '{}' was left by process {}, which is gone", page.name, page.pid);
    }
  }
  if (running.size() == 1) return running.front();
  if (running.empty()) {
    return fail(ErrorCode::kNotFound,
                fmt::format("no `terracut live` is running (status pages are looked for in {}){}",
                            folder, left_over));
  }
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("several are running, name one of them: {}", fmt::join(running, ", ")));
}

Expected<Reader> open_page(const std::string& name) {
  return Reader::open(name, rt::MonitorSnapshot::kLayout);
}

DashboardStyle style_of_stdout() {
  DashboardStyle style;
  style.colours = ::isatty(STDOUT_FILENO) == 1;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    style.columns = size.ws_col;
  }
  return style;
}

/// Overwrites what stands there instead of clearing first, which would flicker. Lines lose what was
/// longer before, and the screen what stood below.
std::string redrawn(const std::string& text) {
  std::string result = "\x1b[H";
  for (const char c : text) {
    if (c == '\n') result += "\x1b[K";
    result += c;
  }
  return result + "\x1b[J";
}

/// The page's figures, for whoever calculates with them.
ExitCode refuse_figures(const Reader& page, const std::string& name) {
  return refuse(kInputRefused,
                fmt::format("the status page '{}' (process {}) holds figures that cannot be: it is "
                            "damaged, or something else writes to it",
                            name, page.publisher_pid()));
}

ExitCode print_once(const Reader& page, const std::string& name, bool as_json) {
  const auto figures = page.read();
  if (!figures) {
    return refuse(kInputRefused, fmt::format("process {} has not published any figures yet",
                                             page.publisher_pid()));
  }
  if (!are_possible(*figures)) return refuse_figures(page, name);
  fmt::print("{}", as_json ? json_text(live_summary(*figures))
                           : dashboard(*figures, now_ns(), style_of_stdout()));
  if (!page.publisher_lives()) {
    return refuse(kInputRefused, fmt::format("process {} of '{}' is gone; these were its last "
                                             "figures",
                                             page.publisher_pid(), name));
  }
  return kOk;
}

ExitCode watch(const Reader& page, const std::string& name, double interval_s) {
  const bool terminal = ::isatty(STDOUT_FILENO) == 1;
  if (terminal) fmt::print("\x1b[2J");
  for (;;) {
    const bool lives = page.publisher_lives();  // asked first: the last figures are shown too
    if (const auto figures = page.read()) {
      if (!are_possible(*figures)) return refuse_figures(page, name);
      const std::string text = dashboard(*figures, now_ns(), style_of_stdout());
      fmt::print("{}", terminal ? redrawn(text) : text + "\n");
      if (std::fflush(stdout) != 0) return refuse(kOutputFailed, "cannot write to stdout");
    }
    if (!lives) {
      say(fmt::format("process {} of '{}' has ended", page.publisher_pid(), name));
      return kOk;
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(interval_s));
  }
}

}  // namespace

/// Reads the status page of a running process, and nothing else of it.
ExitCode run(const TopOptions& options) {
  const Expected<std::string> name =
      options.name.empty() ? name_of_the_only_one() : Expected<std::string>(options.name);
  if (!name) return refuse(name.error());
  const Expected<Reader> page = open_page(*name);
  if (!page) return refuse(page.error());
  if (options.once || options.json) return print_once(*page, *name, options.json);
  return watch(*page, *name, options.interval_s);
}

}  // namespace terracut::cli
