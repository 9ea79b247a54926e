// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/measure/run_queue_wait.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace terracut::measure {
namespace {

using Text = std::array<char, 96>;  // three numbers of at most 20 digits: "ran waited timeslices"

}  // namespace

RunQueueWait RunQueueWait::of_this_thread() {
  RunQueueWait wait;
  // "thread-self" is resolved when the file is opened: so the file stays that of this thread.
  auto file = ProcFile::open("/proc/thread-self/schedstat");
  if (!file) return wait;
  Text text{};
  // A kernel that does not count waits shows only zeros. On other kernels a running thread has had
  // at least one timeslice (the third number).
  if (nth_number(file->read(text), 2) > 0) wait.file_ = std::move(*file);
  return wait;
}

std::int64_t RunQueueWait::read_ns() const noexcept TERRACUT_NONBLOCKING {
  if (!file_) return 0;
  Text text;
  return std::max<std::int64_t>(nth_number(file_->read(text), 1), 0);
}

}  // namespace terracut::measure
