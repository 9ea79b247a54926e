// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/publish/frame_sink.hpp"
#include "pipeline/publish/reopened.hpp"

namespace terracut::publish {

/// An output that neither ends a run nor keeps it from starting: its inner sink is opened on its
/// own thread, and opened again after a failure (Reopened). Frames in between are left out and
/// counted as NAME_frames_while_closed.
class RetriedSink final : public FrameSink {
 public:
  using Inner = std::unique_ptr<FrameSink>;
  struct Config {
    std::string name;  ///< The inner sink's, as is the next.
    std::size_t queue_frames = 2;
    Reopened<Inner>::Config inner;
    /// For a recording: missing frames are an error in the end.
    bool is_to_be_whole = false;
  };
  explicit RetriedSink(Config config);

  [[nodiscard]] std::string_view name() const noexcept override { return name_; }
  [[nodiscard]] std::size_t queue_frames() const noexcept override { return queue_frames_; }
  /// Never returns an error.
  [[nodiscard]] Status put(const LabelledFrame& frame) override;
  [[nodiscard]] Status put_figures(const status::MonitorSnapshot& figures) override;
  /// Errors: kWriteFailed if frames are missing and Config::is_to_be_whole.
  [[nodiscard]] Status finish() override;
  [[nodiscard]] std::vector<status::NamedCount> losses() const override;

 private:
  /// Returns null if it is not open.
  [[nodiscard]] FrameSink* inner();
  void give_up(const Error& error);

  std::string name_;
  std::size_t queue_frames_;
  Reopened<Inner> inner_;
  bool is_to_be_whole_;

  mutable std::mutex mutex_;    ///< Shared by threads without a deadline.
  FrameSink* shown_ = nullptr;  ///< The sink that losses() may ask.
  std::uint64_t while_closed_ = 0;
  std::vector<status::NamedCount> before_;  ///< Losses of sinks that failed earlier.
};

}  // namespace terracut::publish
