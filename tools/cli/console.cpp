// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <utility>

#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::cli {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr const char* kWipeLine = "\r\x1b[K";
std::atomic<bool> progress_line_stands = false;  // say() may come from any thread
thread_local HeardLines* listener = nullptr;

void print_line(std::string_view line) {
  fmt::print(stderr, "{}{}\n", progress_line_stands.exchange(false) ? kWipeLine : "", line);
}

}  // namespace

void say(std::string_view line) {
  if (listener != nullptr) return void(listener->said.emplace_back(line));
  print_line(line);
}
void warn(std::string_view line) {
  if (listener != nullptr) return void(listener->warned.emplace_back(line));
  print_line(fmt::format("warning: {}", line));
}

HeardLines::HeardLines() {
  listener = this;
}
HeardLines::~HeardLines() {
  listener = nullptr;
}

ExitCode refuse(const Error& error) {
  return refuse(exit_code_of(error.code), error.message);
}

ExitCode refuse(ExitCode code, std::string_view message) {
  print_line(fmt::format("error: {}", message));
  return code;
}

ExitCode done_or_refused(const Status& status) {
  return status ? kOk : refuse(status.error());
}

Progress::Progress(std::string task, std::string unit, double total)
    : task_(std::move(task)),
      unit_(std::move(unit)),
      total_(total),
      terminal_(::isatty(STDERR_FILENO) == 1),
      started_ns_(measure::monotonic_ns()),
      shown_ns_(started_ns_) {}

Progress::~Progress() {
  if (!progress_line_stands) return;
  fmt::print(stderr, "{}", kWipeLine);
  progress_line_stands = false;
}

void Progress::update(double done) {
  const std::int64_t now_ns = measure::monotonic_ns();
  if (now_ns - shown_ns_ < (terminal_ ? kSecond_ns / 5 : 5 * kSecond_ns)) return;
  shown_ns_ = now_ns;
  const double seconds = static_cast<double>(now_ns - started_ns_) * 1e-9;
  std::string line = fmt::format("{}: {:.4g}", task_, done);
  if (total_ > 0) line += fmt::format(" of {:.4g}", total_);
  line += fmt::format(" {}", unit_);
  if (total_ > 0) line += fmt::format(", {:.0f} %", 100.0 * done / total_);
  line += fmt::format(", {:.0f} s", seconds);
  if (terminal_) {
    fmt::print(stderr, "{}{}", kWipeLine, line);
    std::fflush(stderr);
    progress_line_stands = true;
  } else {
    print_line(line);
  }
}

}  // namespace terracut::cli
