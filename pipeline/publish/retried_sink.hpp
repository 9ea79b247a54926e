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

/// An output whose failure neither ends a run nor keeps it from starting. An inner sink is opened
/// on the output's thread, and opened again after a failure (Reopened). Frames that come while it
/// is closed are left out and counted as NAME_frames_while_closed, sectors likewise.
class RetriedSink final : public FrameSink {
 public:
  using Inner = std::unique_ptr<FrameSink>;
  struct Config {
    std::string name;  ///< The inner sink's name.
    std::size_t queue_frames = 2;
    bool wants_sectors = false;  ///< True if the inner sink does.
    Reopened<Inner>::Config inner;
    /// True for a recording that must be whole: finish() then fails if frames are missing.
    bool is_to_be_whole = false;
  };
  explicit RetriedSink(Config config);

  [[nodiscard]] std::string_view name() const noexcept override { return name_; }
  [[nodiscard]] std::size_t queue_frames() const noexcept override { return queue_frames_; }
  [[nodiscard]] bool wants_sectors() const noexcept override { return wants_sectors_; }
  /// Passes the frame to the inner sink. Never fails.
  [[nodiscard]] Status put(const LabelledFrame& frame) override;
  [[nodiscard]] Status put_sector(const LabelledSector& sector) override;
  [[nodiscard]] Status put_figures(const status::MonitorSnapshot& figures) override;
  /// Fails with kWriteFailed if frames are missing and Config::is_to_be_whole is set.
  [[nodiscard]] Status finish() override;
  [[nodiscard]] std::vector<status::NamedCount> losses() const override;

 private:
  /// Returns the inner sink, or null if it is not open.
  [[nodiscard]] FrameSink* inner();
  /// Returns false if the inner sink is not open, or failed and was given up.
  template <class Put>
  [[nodiscard]] bool passed_on(Put&& put);
  void give_up(const Error& error);

  std::string name_;
  std::size_t queue_frames_;
  Reopened<Inner> inner_;
  bool wants_sectors_, is_to_be_whole_;

  mutable std::mutex mutex_;    ///< Shared by threads without a deadline.
  FrameSink* shown_ = nullptr;  ///< The open sink, for losses(); null if there is none.
  std::uint64_t while_closed_ = 0, sectors_while_closed_ = 0;
  std::vector<status::NamedCount> before_;  ///< Summed losses of sinks that failed earlier.
};

}  // namespace terracut::publish
