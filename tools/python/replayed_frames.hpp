// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "frame_arrays.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tools/cli/input/labelled_capture.hpp"

namespace terracut::python {

/// The frames of a capture in order, labelled as by `terracut replay`. Any thread of the
/// interpreter, one at a time.
class ReplayedFrames {
 public:
  /// `words` is a command line of `terracut replay`.
  explicit ReplayedFrames(const std::vector<std::string>& words);

  /// Returns the next frame; null at the end.
  [[nodiscard]] std::shared_ptr<FrameData> next();
  [[nodiscard]] nlohmann::ordered_json report();

  [[nodiscard]] std::string sensor() const { return capture_->capture().sensor_line; }
  [[nodiscard]] std::string calibration() const { return capture_->capture().calibration_line; }

 private:
  [[nodiscard]] Expected<std::shared_ptr<FrameData>> next_unlocked();

  std::mutex mutex_;
  scene::Wanted wanted_;  ///< Declared before the capture, which it is read with.
  std::unique_ptr<cli::LabelledCapture> capture_;
  memory::FixedMemory memory_;
  std::optional<scene::SceneFinder> scene_;  ///< Exists if anything is to be found.
  FrameBuffers buffers_;
  std::vector<points::LabelledPoint> labelled_;  ///< Points of the current frame.
  bool concluded_ = false;
};

void bind_replay(pybind11::module_& module);

}  // namespace terracut::python
