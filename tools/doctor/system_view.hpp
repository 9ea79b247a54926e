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

/// What the kernel says of its own clock.
struct ClockState {
  bool synchronised = false;
  double max_error_s = 0;
};

/// The machine, as its files tell of it: /proc, /sys, /etc and /run below a root folder, which in
/// tests is a made-up one. One thread.
class SystemView {
 public:
  /// `clock`: what adjtimex() says, which is no file; none where it is not known.
  explicit SystemView(std::filesystem::path root, std::optional<ClockState> clock = std::nullopt)
      : root_(std::move(root)), clock_(clock) {}

  /// The machine this runs on.
  [[nodiscard]] static SystemView of_this_machine();

  /// The beginning of a file, up to 1 MiB, without white space at its end; none where it is absent
  /// or may not be read. `path` as "proc/version".
  [[nodiscard]] std::optional<std::string> text(std::string_view path) const;
  /// The first word of a file as a number.
  [[nodiscard]] std::optional<std::int64_t> number(std::string_view path) const;
  /// Names in a folder, sorted; empty where it is absent.
  [[nodiscard]] std::vector<std::string> names_in(std::string_view folder) const;
  [[nodiscard]] bool exists(std::string_view path) const;

  /// Names of all running processes that can be seen.
  [[nodiscard]] const std::set<std::string>& processes() const;

  [[nodiscard]] const std::optional<ClockState>& clock() const noexcept { return clock_; }

 private:
  std::filesystem::path root_;
  std::optional<ClockState> clock_;
  mutable std::optional<std::set<std::string>> processes_;
};

/// The lines of a text.
[[nodiscard]] std::vector<std::string> lines_of(std::string_view text);
/// The words of a line, between white space.
[[nodiscard]] std::vector<std::string> words_of(std::string_view line);
/// The numbers of a kernel list, "0-2,5": 0, 1, 2, 5. Empty for anything else.
[[nodiscard]] std::set<int> numbers_of_list(std::string_view list);
/// The line of `text` that begins with `start`, without it and the white space behind it.
[[nodiscard]] std::optional<std::string> line_after(std::string_view text, std::string_view start);

}  // namespace terracut::doctor
