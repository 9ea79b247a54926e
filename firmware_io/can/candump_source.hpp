// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "firmware_io/can/can_frame.hpp"
#include "firmware_io/can/can_log_counters.hpp"
#include "rt/error.hpp"

namespace terracut::can {

/// Reads frames of a candump log (candump_line.hpp) in file order. Not thread-safe; blocks on the
/// disk.
class CandumpSource {
 public:
  /// The longest line, in characters; frames need at most 260.
  static constexpr std::size_t kMostLine = 511;

  /// Opens a log and delivers only frames of `interface` (if empty, of any). Fails with kNotFound
  /// or kUnreadable.
  [[nodiscard]] static Expected<CandumpSource> open(const std::filesystem::path& path,
                                                    std::string interface = {});

  /// Reads any stream; `name` stands for the path in messages.
  CandumpSource(std::unique_ptr<std::istream> stream, std::string name, std::string interface = {});

  /// Returns the next frame; nothing at the end. Lines without a frame are counted and skipped,
  /// however long they are; after the first malformed one they cause no allocation. Fails at the
  /// end with kMalformed if no line was a frame, kNothingCameOut if all frames were of other
  /// interfaces, kUnreadable if the system refused to read on.
  [[nodiscard]] Expected<std::optional<CanFrame>> next();

  [[nodiscard]] const CanLogCounters& counters() const noexcept { return counters_; }
  /// Describes the first malformed line, "drive.log:12: its stamp ..."; empty if there was none.
  [[nodiscard]] const std::string& first_fault() const noexcept { return first_fault_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

 private:
  [[nodiscard]] std::optional<std::string_view> read_line();
  void note(std::string_view what, bool malformed);
  [[nodiscard]] Status end() const;

  std::unique_ptr<std::istream> stream_;
  std::string name_, interface_;
  std::array<char, kMostLine + 1> line_{};
  bool too_long_ = false;  ///< line_ holds only the beginning of a longer line.
  CanLogCounters counters_;
  std::string first_fault_, first_no_frame_, first_other_interface_;
};

}  // namespace terracut::can
