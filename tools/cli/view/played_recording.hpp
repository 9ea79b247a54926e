// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "frame_comparison.hpp"
#include "pipeline/publish/labelled_frame.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// A labelled frame of a recording, and what it is compared with.
struct PlayedFrame : publish::LabelledFrame {
  FrameComparison comparison;
};

/// A recording that CapturePlayer plays. Times count from the recording's beginning. One thread,
/// except measure().
class PlayedRecording {
 public:
  PlayedRecording() = default;
  PlayedRecording(const PlayedRecording&) = delete;
  PlayedRecording& operator=(const PlayedRecording&) = delete;
  virtual ~PlayedRecording() = default;

  /// Returns the interval between frames.
  [[nodiscard]] virtual double frame_s() const = 0;

  struct Span {
    std::int64_t begin_ns, end_ns;
  };
  /// Labels the next frame. Returns nothing at the end, where the recording breaks off, and when
  /// stop_wanted().
  [[nodiscard]] virtual std::optional<Span> next() = 0;
  /// Copies the frame labelled last. Its number is that in the names of its files, even after a
  /// seek. Fails with kMalformed if the truth is that of another recording.
  [[nodiscard]] virtual Status take(PlayedFrame& frame) = 0;
  /// Seeks: next() then gives the frame of that time, perhaps after some earlier ones.
  [[nodiscard]] virtual Status go_to(double seek_s) = 0;
  /// Returns an error, with its reason, if there was no frame at all.
  [[nodiscard]] virtual Status conclude() = 0;

  /// Measures when the recording begins, by its stamps, and how long it is. Reports what is known
  /// so far, until all is known or `on_length` returns false. From any thread.
  using OnLength = std::function<bool(std::int64_t begin_stamp_ns, std::int64_t length_ns)>;
  virtual void measure(const OnLength& on_length) const = 0;
};

}  // namespace terracut::cli
