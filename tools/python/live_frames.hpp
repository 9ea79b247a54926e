// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "frame_arrays.hpp"
#include "pipeline/terracut/live_run.hpp"
#include "rt/error.hpp"

namespace terracut::python {

/// A live sensor's frames, or their sectors, for a loop in Python. The run has threads of its own,
/// which never hold the interpreter's lock; if the loop is too slow, the oldest waiting ones are
/// dropped and counted.
class LiveFrames {
 public:
  /// `words` is a command line of `terracut live`. Returns once the sensor is heard; Ctrl-C ends
  /// the wait.
  LiveFrames(const std::vector<std::string>& words, bool sectors);
  ~LiveFrames();

  /// Waits for the next frame and returns it; null when the run is over.
  [[nodiscard]] std::shared_ptr<FrameData> next();
  void stop();

  [[nodiscard]] pybind11::dict figures();
  [[nodiscard]] std::string refusals();

 private:
  static constexpr std::size_t kMostFrames = 4, kMostSectors = 256;  ///< That wait.

  [[nodiscard]] Status open(const std::vector<std::string>& words);
  [[nodiscard]] bool is_over() const;
  /// Copies what frames and sectors have in common.
  template <class Labelled>
  [[nodiscard]] std::shared_ptr<FrameData> copied(const Labelled& from, std::uint32_t number);
  void keep(const Frame& frame);
  void keep(const Sector& sector);
  void keep(std::shared_ptr<FrameData> data);
  void keep_figures();

  std::optional<LiveRun> run_;
  std::optional<double> duration_s_;
  std::chrono::steady_clock::time_point begun_;
  bool gives_sectors_;
  bool gives_objects_ = false, gives_free_way_ = false;
  FrameBuffers buffers_;
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<FrameData>> waiting_;  ///< Guarded by mutex_, with the following.
  LiveRun::Figures figures_;
  std::string refusals_;
  std::uint64_t left_out_ = 0;
  bool ended_ = false;
  std::thread thread_;
};

void bind_live(pybind11::module_& module);

}  // namespace terracut::python
