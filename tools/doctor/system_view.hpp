// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace terracut::doctor {

/// What the kernel knows about the error of its clock.
struct ClockState {
  bool synchronised = false;
  double max_error_s = 0;
};

/// The machine as described by its files: /proc, /sys, /etc and /run below a root folder, which
/// tests replace. One thread.
class SystemView {
 public:
  /// `clock` is the result of adjtimex(), which no file contains; none if unknown.
  explicit SystemView(std::filesystem::path root, std::optional<ClockState> clock = std::nullopt)
      : root_(std::move(root)), clock_(clock) {}

  /// Returns the view of this machine.
  [[nodiscard]] static SystemView of_this_machine();

  /// Returns the beginning of a file, up to 1 MiB, without white space at its end; none if it is
  /// absent or may not be read. `path` is like "proc/version".
  [[nodiscard]] std::optional<std::string> text(std::string_view path) const;
  /// Returns the first word of a file as a number.
  [[nodiscard]] std::optional<std::int64_t> number(std::string_view path) const;
  /// Returns the names in a folder, sorted; empty if it is absent.
  [[nodiscard]] std::vector<std::string> names_in(std::string_view folder) const;
  [[nodiscard]] bool exists(std::string_view path) const;

  /// Returns the names of all visible running processes.
  [[nodiscard]] const std::set<std::string>& processes() const;

  [[nodiscard]] const std::optional<ClockState>& clock() const noexcept { return clock_; }

 private:
  std::filesystem::path root_;
  std::optional<ClockState> clock_;
  mutable std::optional<std::set<std::string>> processes_;
};

/// Splits a text into lines.
[[nodiscard]] std::vector<std::string> lines_of(std::string_view text);
/// Splits a line into words, at white space.
[[nodiscard]] std::vector<std::string> words_of(std::string_view line);
/// Returns the numbers of a kernel list: 0, 1, 2, 5 for "0-2,5". Empty for anything else.
[[nodiscard]] std::set<int> numbers_of_list(std::string_view list);
/// Finds the line of `text` that begins with `start` and returns the rest of that line, without
/// leading white space.
[[nodiscard]] std::optional<std::string> line_after(std::string_view text, std::string_view start);

}  // namespace terracut::doctor
