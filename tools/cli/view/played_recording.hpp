// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "pipeline/publish/labelled_frame.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// A recording as CapturePlayer shows it. Times are since the recording's beginning. One thread,
/// but for measure().
class PlayedRecording {
 public:
  PlayedRecording() = default;
  PlayedRecording(const PlayedRecording&) = delete;
  PlayedRecording& operator=(const PlayedRecording&) = delete;
  virtual ~PlayedRecording() = default;

  /// From one frame to the next.
  [[nodiscard]] virtual double frame_s() const = 0;

  struct Span {
    std::int64_t begin_ns, end_ns;
  };
  /// Labels the next frame; none at the end, where the recording breaks off, and when
  /// stop_wanted().
  [[nodiscard]] virtual std::optional<Span> next() = 0;
  /// That frame. Its number is the one in the names of its files, wherever it was come from.
  virtual void take(publish::LabelledFrame& frame) = 0;
  /// From here on next() gives the frame of that time, and before it perhaps some earlier ones.
  [[nodiscard]] virtual Status go_to(double seek_s) = 0;
  /// Where not one frame came out: why.
  [[nodiscard]] virtual Status conclude() = 0;

  /// Finds out when the recording begins, by its stamps, and how long it is, and tells as far as it
  /// is known, until it is or the answer is false. From any thread.
  using OnLength = std::function<bool(std::int64_t begin_stamp_ns, std::int64_t length_ns)>;
  virtual void measure(const OnLength& on_length) const = 0;
};

}  // namespace terracut::cli
