// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/publish/frame_buffers.hpp"

#include <utility>

namespace terracut::publish {

FrameBuffers::FrameBuffers(std::size_t count) {
  free_->frames.reserve(count);
  for (std::size_t n = 0; n < count; ++n) {
    free_->frames.push_back(std::make_unique<LabelledFrame>());
  }
}

std::shared_ptr<LabelledFrame> FrameBuffers::take() {
  std::unique_lock lock(free_->mutex);
  free_->came_back.wait(lock, [this] { return !free_->frames.empty(); });
  std::unique_ptr<LabelledFrame> frame = std::move(free_->frames.back());
  free_->frames.pop_back();
  lock.unlock();
  return {frame.release(), [free = free_](LabelledFrame* back) {
            {
              const std::scoped_lock giving_back(free->mutex);
              free->frames.emplace_back(back);
            }
            free->came_back.notify_one();
          }};
}

}  // namespace terracut::publish
