// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/label.hpp"
#include "tools/cli/input/labelled_capture.hpp"

namespace terracut::cli {

/// Labels by another method for frames of a capture. It reads the capture a second time, because
/// methods hand over a frame after different packets.
class CaptureLabels {
 public:
  /// `capture` was opened with the same `options`. Fails with the errors of
  /// LabelledCapture::open().
  [[nodiscard]] static Expected<std::unique_ptr<CaptureLabels>> open(const LabelledCapture& capture,
                                                                     const Options& options,
                                                                     const MethodOptions& method);

  /// Returns the labels of a frame, by return index; empty if there is no such frame. Frames are
  /// asked for in order; `end_ns` is when it ends, since the capture's beginning.
  [[nodiscard]] std::span<const frame::Label> of(const frame::FrameInfo& info, std::int64_t end_ns);
  /// Goes to another place, as LabelledCapture::rewind().
  [[nodiscard]] Status go_to(double start_s);

 private:
  explicit CaptureLabels(std::unique_ptr<LabelledCapture> capture) : capture_(std::move(capture)) {}

  std::unique_ptr<LabelledCapture> capture_;
  const run::Frame* frame_ = nullptr;  ///< The newest; null: none yet, or none any more.
};

}  // namespace terracut::cli
