// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "pipeline/status/frame_record.hpp"
#include "pipeline/stream/labelled_frame_wire.hpp"

namespace terracut::python {

/// One labelled frame, whose numpy arrays are views of `points` and keep it alive.
struct FrameData {
  frame::FrameInfo info;
  std::optional<status::FrameRecord> record;  ///< None: of a live run.
  std::vector<stream::LabelledPoint> points;
};

/// Frames whose memory is used again once Python has dropped the last array that looks at it. Any
/// thread.
class FrameBuffers {
 public:
  [[nodiscard]] std::shared_ptr<FrameData> take();

 private:
  static constexpr std::size_t kMostSpare = 2;  ///< The one just dropped, and the one in work.
  struct Spare {
    std::mutex mutex;
    std::vector<std::unique_ptr<FrameData>> frames;
  };
  std::shared_ptr<Spare> spare_ = std::make_shared<Spare>();
};

void bind_frame(pybind11::module_& module);

}  // namespace terracut::python
