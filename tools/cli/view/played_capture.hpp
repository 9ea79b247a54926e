// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "played_recording.hpp"
#include "tools/cli/input/labelled_capture.hpp"

namespace terracut::cli {

/// A played capture. Frames are numbered as by `replay` without --start; after a seek the numbers
/// are found by decoding the part before it, once.
class PlayedCapture : public PlayedRecording {
 public:
  /// Both arguments must outlive this object.
  PlayedCapture(LabelledCapture& capture, const Options& options);
  ~PlayedCapture() override;

  [[nodiscard]] double frame_s() const override;
  [[nodiscard]] std::optional<Span> next() override;
  void take(publish::LabelledFrame& frame) override;
  [[nodiscard]] Status go_to(double seek_s) override;
  [[nodiscard]] Status conclude() override { return capture_.conclude(); }
  void measure(const OnLength& on_length) const override;

 private:
  class Counter;

  [[nodiscard]] std::uint32_t number_of(std::int64_t end_ns);

  LabelledCapture& capture_;
  const Options& options_;
  const run::Frame* frame_ = nullptr;
  Span span_{};
  /// The decoder's frame number, which never restarts, minus the number in file names.
  std::optional<std::uint32_t> ahead_;
  bool begins_ = false;                ///< True if the next frame is the first.
  std::vector<std::int64_t> ends_ns_;  ///< Ends of the first frames, by number.
  std::unique_ptr<Counter> counter_;   ///< Set if ends_ns_ did not suffice.
};

}  // namespace terracut::cli
