// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "exit_codes.hpp"
#include "rt/error.hpp"

/// Output for people: results go to stdout, all other messages to stderr.
namespace terracut::cli {

/// Prints one line on stderr, made safe by for_terminal(), after clearing any progress line. For
/// any thread. A line that cannot be written is lost: messages never end the program.
void say(std::string_view line);
void warn(std::string_view line);

/// From now on writes messages and results on a thread of its own (MessageThread), so that no
/// caller waits for a reader; for runs that do not end by themselves. Call it once.
void write_in_background();
/// Returns how many messages were lost because nobody read them.
[[nodiscard]] std::uint64_t lost_messages();

/// Prints a result on stdout. A failure is reported by end_output().
void print_text(std::string_view text);
template <class... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  print_text(fmt::format(format, std::forward<Values>(values)...));
}
/// Flushes results that somebody may be watching; returns false if they cannot be written.
[[nodiscard]] bool flush_output();
/// Ends a program's output and returns `code`, or kOutputFailed instead of kOk if a result could
/// not be written. Ends the process at once if waiting texts are not taken within three seconds.
[[nodiscard]] ExitCode end_output(ExitCode code);

/// While this object lives, collects what its thread would print by say() and warn(), for programs
/// that report to users in their own way. One object per thread.
class HeardLines {
 public:
  HeardLines();
  ~HeardLines();
  HeardLines(const HeardLines&) = delete;
  HeardLines& operator=(const HeardLines&) = delete;

  std::vector<std::string> said, warned;
};

/// Prints "error: <message>" and returns the error's exit code.
[[nodiscard]] ExitCode refuse(const Error& error);
[[nodiscard]] ExitCode refuse(ExitCode code, std::string_view message);
/// Returns kOk, or prints the error and returns its exit code.
[[nodiscard]] ExitCode done_or_refused(const Status& status);

/// The progress of long work: `done` of `total` (0 if unknown), after running for `lasts_s`
/// seconds.
struct ProgressState {
  std::string_view task, unit;
  double done = 0, total = 0, lasts_s = 0;
};
/// Returns "simulating: 0.3 of 3 s, 11 %, after 5 s".
[[nodiscard]] std::string progress_line(const ProgressState& state);

/// Shows the progress of long work: one redrawn line on a terminal, else a line every few seconds.
/// Shows nothing for short work.
class Progress {
 public:
  /// `unit` is what is counted ("frames", "s"); `total` is the final count, 0 if unknown.
  Progress(std::string task, std::string unit, double total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(double done);

 private:
  std::string task_, unit_;
  double total_;
  bool terminal_;
  std::int64_t started_ns_, shown_ns_;
};

}  // namespace terracut::cli
