// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "firmware_io/can/can_frame.hpp"
#include "rt/error.hpp"

namespace terracut::send {

/// Writes a candump log (candump_line.hpp), which canplayer plays and CandumpSource reads. The log
/// is kept in memory, about 45 bytes a frame, and written whole or not at all by finish(). Not
/// thread-safe.
class CandumpWriter {
 public:
  CandumpWriter(std::filesystem::path path, std::string interface)
      : path_(std::move(path)), interface_(std::move(interface)) {}

  /// Appends one frame. kInvalidArgument, with nothing appended, for one that no log can hold: a
  /// stamp before 1970, an id out of its range, or a length its kind of frame cannot have.
  [[nodiscard]] Status write(const can::CanFrame& frame);

  /// Gives the file its content; kWriteFailed when the disk refuses. Call once.
  [[nodiscard]] Status finish() const;

  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }
  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  std::string interface_;
  std::string text_;
  std::uint64_t frames_ = 0;
};

}  // namespace terracut::send
