// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

#include "pipeline/publish/labelled_frame.hpp"

namespace terracut::publish {

/// Recycles frames with the memory of their points once nobody holds them any more. Threads without
/// a deadline.
class FrameBuffers {
 public:
  /// Makes at most `count` frames at a time.
  explicit FrameBuffers(std::size_t count);

  /// Returns a frame that nobody else has, which may still have old points; waits if all are in
  /// use. May outlive this.
  [[nodiscard]] std::shared_ptr<LabelledFrame> take();

 private:
  struct Free {
    std::mutex mutex;
    std::condition_variable came_back;
    std::vector<std::unique_ptr<LabelledFrame>> frames;
  };
  std::shared_ptr<Free> free_ = std::make_shared<Free>();
};

}  // namespace terracut::publish
