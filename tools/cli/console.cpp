// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#include "message_thread.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/cli/terminal_text.hpp"

namespace terracut::cli {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::chrono::seconds kPatience{3};
constexpr const char* kWipeLine = "\r\x1b[K";
std::atomic<bool> progress_line_stands = false;  // shared, as say() may come from any thread
thread_local HeardLines* listener = nullptr;
std::atomic<int> output_error = 0;  // errno of the first result that could not be written
std::atomic<MessageThread*> background = nullptr;  // never destroyed: it may hang

void note_output_error(int error_number) {
  int none = 0;
  output_error.compare_exchange_strong(none, error_number);
}

/// A message that cannot be written (disk full, reader gone) is dropped: it must not end anything.
void write_message(std::string_view text) {
  if (MessageThread* const thread = background) {
    return thread->put(STDERR_FILENO, std::string(text));
  }
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
}

void print_line(std::string_view line) {
  write_message(fmt::format("{}{}\n", progress_line_stands.exchange(false) ? kWipeLine : "",
                            for_terminal(line)));
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

void write_in_background() {
  if (background != nullptr) return;
  background = new MessageThread([](int descriptor, int error_number) {
    if (descriptor == STDOUT_FILENO) note_output_error(error_number);
  });
}
std::uint64_t lost_messages() {
  const MessageThread* const thread = background;
  return thread == nullptr ? 0 : thread->lost();
}

void print_text(std::string_view text) {
  if (MessageThread* const thread = background) {
    return thread->put(STDOUT_FILENO, std::string(text));
  }
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) note_output_error(errno);
}
bool flush_output() {
  if (std::fflush(stdout) != 0) note_output_error(errno);
  return output_error == 0;
}

ExitCode end_output(ExitCode code) {
  MessageThread* const thread = background;
  if (thread != nullptr && !thread->finish(kPatience)) {
    std::_Exit(code);  // the only way to end with a thread that hangs on a reader
  }
  if (flush_output()) return code;
  // A reader that closes early (`| head`) is no error.
  if (output_error != EPIPE) {
    print_line(fmt::format("error: standard output: {}", std::strerror(output_error)));
  }
  return code == kOk ? kOutputFailed : code;
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

std::string progress_line(const ProgressState& state) {
  const int places = state.unit == "s" ? 1 : 0;
  std::string line = fmt::format("{}: {:.{}f}", state.task, state.done, places);
  if (state.total > 0) {
    const bool is_whole = std::round(state.total) == state.total;
    line += fmt::format(" of {:.{}f}", state.total, is_whole ? 0 : places);
  }
  line += fmt::format(" {}", state.unit);
  if (state.total > 0) line += fmt::format(", {:.0f} %", 100.0 * state.done / state.total);
  return line + fmt::format(", after {:.0f} s", state.lasts_s);
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
  write_message(kWipeLine);
  progress_line_stands = false;
}

void Progress::update(double done) {
  const std::int64_t now_ns = measure::monotonic_ns();
  if (now_ns - shown_ns_ < (terminal_ ? kSecond_ns / 5 : 5 * kSecond_ns)) return;
  shown_ns_ = now_ns;
  const double seconds = static_cast<double>(now_ns - started_ns_) * 1e-9;
  const std::string line = progress_line({task_, unit_, done, total_, seconds});
  if (terminal_) {
    write_message(kWipeLine + line);
    progress_line_stands = true;
  } else {
    print_line(line);
  }
}

}  // namespace terracut::cli
