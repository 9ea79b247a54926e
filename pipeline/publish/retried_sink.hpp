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

/// An output that ends no run and keeps none from starting: what it writes to is opened on its own
/// thread, and again after it could not be, or failed (Reopened). Frames meanwhile are left out,
/// and counted as NAME_frames_while_closed.
class RetriedSink final : public FrameSink {
 public:
  using Inner = std::unique_ptr<FrameSink>;
  struct Config {
    std::string name;  ///< As in FrameSink, of what is opened.
    std::size_t queue_frames = 2;
    Reopened<Inner>::Config inner;
    /// Frames that are missing in it are an error in the end: it is a recording.
    bool is_to_be_whole = false;
  };
  explicit RetriedSink(Config config);

  [[nodiscard]] std::string_view name() const noexcept override { return name_; }
  [[nodiscard]] std::size_t queue_frames() const noexcept override { return queue_frames_; }
  /// No error ever.
  [[nodiscard]] Status put(const LabelledFrame& frame) override;
  [[nodiscard]] Status put_figures(const status::MonitorSnapshot& figures) override;
  /// kWriteFailed as Config::is_to_be_whole says.
  [[nodiscard]] Status finish() override;
  [[nodiscard]] std::vector<status::NamedCount> losses() const override;

 private:
  /// Null where there is none.
  [[nodiscard]] FrameSink* inner();
  void give_up(const Error& error);

  std::string name_;
  std::size_t queue_frames_;
  Reopened<Inner> inner_;
  bool is_to_be_whole_;

  mutable std::mutex mutex_;    ///< Between threads without a deadline.
  FrameSink* shown_ = nullptr;  ///< What losses() may ask.
  std::uint64_t while_closed_ = 0;
  std::vector<status::NamedCount> before_;  ///< Losses of those that failed.
};

}  // namespace terracut::publish
