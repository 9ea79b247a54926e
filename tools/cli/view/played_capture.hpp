// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "capture_labels.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "played_recording.hpp"
#include "tools/cli/input/frame_truth.hpp"
#include "tools/cli/input/labelled_capture.hpp"
#include "truth_doubt.hpp"

namespace terracut::cli {

/// A capture as a recording to play. Frames have the numbers that `replay` without --start gives
/// them; after a seek these are found by decoding, once, the part before it.
class PlayedCapture : public PlayedRecording {
 public:
  /// The first two arguments must outlive this object. Frames are compared with `truth` and with
  /// `beside`, which may be null.
  PlayedCapture(LabelledCapture& capture, const Options& options, FrameTruth truth,
                std::unique_ptr<CaptureLabels> beside);
  ~PlayedCapture() override;

  [[nodiscard]] double frame_s() const override;
  [[nodiscard]] std::optional<Span> next() override;
  [[nodiscard]] Status take(PlayedFrame& frame) override;
  [[nodiscard]] Status go_to(double seek_s) override;
  [[nodiscard]] Status conclude() override { return capture_.conclude(); }
  void measure(const OnLength& on_length) const override;

 private:
  class Counter;

  [[nodiscard]] std::uint32_t number_of(std::int64_t end_ns);

  LabelledCapture& capture_;
  const Options& options_;
  memory::FixedMemory memory_;
  std::optional<scene::SceneFinder> scene_;  ///< Exists if anything is to be found.
  FrameTruth truth_;
  TruthDoubt doubt_{true};
  std::unique_ptr<CaptureLabels> beside_;
  const run::Frame* frame_ = nullptr;
  Span span_{};
  /// The decoder's frame number, which never restarts, minus the frame's number in file names.
  std::optional<std::uint32_t> ahead_;
  bool begins_ = false;                ///< True if the next frame is the first.
  std::vector<std::int64_t> ends_ns_;  ///< Ends of the first frames, by number.
  std::unique_ptr<Counter> counter_;   ///< Set if ends_ns_ did not suffice.
};

}  // namespace terracut::cli
