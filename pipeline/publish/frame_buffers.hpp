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

/// Recycles frames, with the memory of their points, once no output holds them. For threads without
/// a deadline.
class FrameBuffers {
 public:
  /// At most `count` frames exist at a time.
  explicit FrameBuffers(std::size_t count);

  /// Returns a frame that nobody else holds, which may still have old points; waits if all frames
  /// are in use. The returned frame may outlive this object.
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
