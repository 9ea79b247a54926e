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

/// What people see: results go to stdout, everything said on the way to stderr.
namespace terracut::cli {

/// One line on stderr, as for_terminal() lets it through; wipes a progress line that stands there.
/// From any thread. A line that cannot be written is lost: a message ends nothing.
void say(std::string_view line);
void warn(std::string_view line);

/// From now on messages and results are written by a thread of their own (MessageThread): whoever
/// says something waits for no reader. For runs that have no end of their own. Once.
void write_in_background();
/// Messages that were lost because nobody took them.
[[nodiscard]] std::uint64_t lost_messages();

/// Results on stdout. What cannot be written shows in end_output().
void print_text(std::string_view text);
template <class... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  print_text(fmt::format(format, std::forward<Values>(values)...));
}
/// For results that somebody watches while they come; false where they cannot be written.
[[nodiscard]] bool flush_output();
/// At a program's end: `code`, but kOutputFailed in place of kOk where a result could not be
/// written. Ends the process at once where written texts are not taken within three seconds.
[[nodiscard]] ExitCode end_output(ExitCode code);

/// While it lives, what this thread says and warns of comes here instead of to stderr: for programs
/// that have this one's work done and tell their users in a way of their own. One a thread.
class HeardLines {
 public:
  HeardLines();
  ~HeardLines();
  HeardLines(const HeardLines&) = delete;
  HeardLines& operator=(const HeardLines&) = delete;

  std::vector<std::string> said, warned;
};

/// Prints "error: <message>" and returns the exit code it leads to.
[[nodiscard]] ExitCode refuse(const Error& error);
[[nodiscard]] ExitCode refuse(ExitCode code, std::string_view message);
/// kOk, or the error as above.
[[nodiscard]] ExitCode done_or_refused(const Status& status);

/// How far long work has come: `done` of `total` (0: unknown) after `lasts_s` seconds.
struct ProgressState {
  std::string_view task, unit;
  double done = 0, total = 0, lasts_s = 0;
};
/// "simulating: 0.3 of 3 s, 11 %, after 5 s"
[[nodiscard]] std::string progress_line(const ProgressState& state);

/// Shows how far long work has come: on a terminal one line that is redrawn, else a line every few
/// seconds. Nothing is shown for work that ends at once.
class Progress {
 public:
  /// `unit`: what is counted ("frames", "s"); `total`: how many there will be, 0 when unknown.
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
