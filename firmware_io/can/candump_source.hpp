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

/// Frames of a candump log (candump_line.hpp), in file order. Not thread-safe; blocks on the disk.
class CandumpSource {
 public:
  /// Characters a line may have; frames need at most 260.
  static constexpr std::size_t kMostLine = 511;

  /// Frames of `interface` only; empty: of any. kNotFound or kUnreadable.
  [[nodiscard]] static Expected<CandumpSource> open(const std::filesystem::path& path,
                                                    std::string interface = {});

  /// From any stream; `name` stands for the path in messages.
  CandumpSource(std::unique_ptr<std::istream> stream, std::string name, std::string interface = {});

  /// The next frame; nothing at the end. Lines that are no frame are counted and stepped over,
  /// however long they are; nothing is allocated for them after the first malformed one.
  ///
  /// Errors, at the end: kMalformed when not one line was a frame; kNothingCameOut when all frames
  /// were of other interfaces; kUnreadable when the system refused to read on.
  [[nodiscard]] Expected<std::optional<CanFrame>> next();

  [[nodiscard]] const CanLogCounters& counters() const noexcept { return counters_; }
  /// "drive.log:12: its stamp ..." of the first malformed line; empty: none was.
  [[nodiscard]] const std::string& first_fault() const noexcept { return first_fault_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

 private:
  [[nodiscard]] std::optional<std::string_view> read_line();
  void note(std::string_view what, bool malformed);
  [[nodiscard]] Status end() const;

  std::unique_ptr<std::istream> stream_;
  std::string name_, interface_;
  std::array<char, kMostLine + 1> line_{};
  bool too_long_ = false;  ///< The line in line_ is only the beginning of it.
  CanLogCounters counters_;
  std::string first_fault_, first_no_frame_, first_other_interface_;
};

}  // namespace terracut::can
