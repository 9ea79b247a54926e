// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "pipeline/run/cloud_pipeline.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "played_recording.hpp"
#include "tools/cli/input/cloud_input.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// A folder of clouds, or one cloud, played at ten a second, because files have no stamps.
class PlayedClouds : public PlayedRecording {
 public:
  /// Finds the lasers' rows and the mount. Fails with the errors of CloudReader::open(), rows_of(),
  /// choose_mount() and ring_profile_of().
  [[nodiscard]] static Expected<std::unique_ptr<PlayedClouds>> open(
      const std::filesystem::path& clouds, const Options& options);

  [[nodiscard]] const std::string& sensor_line() const noexcept { return sensor_line_; }
  [[nodiscard]] int rows() const noexcept { return pipeline_->image().shape().rows; }
  [[nodiscard]] const mount::Mount& sensor_mount() const noexcept { return mount_; }

  [[nodiscard]] double frame_s() const override;
  /// Returns the next cloud, labelled. Leaves out clouds that cannot be labelled, with a warning.
  [[nodiscard]] std::optional<Span> next() override;
  void take(publish::LabelledFrame& frame) override;
  [[nodiscard]] Status go_to(double seek_s) override;
  [[nodiscard]] Status conclude() override;
  void measure(const OnLength& on_length) const override;

 private:
  explicit PlayedClouds(CloudReader reader) : reader_(std::move(reader)) {}
  [[nodiscard]] Status label(std::size_t index);

  CloudReader reader_;
  std::string sensor_line_;
  mount::Mount mount_;
  std::unique_ptr<run::CloudPipeline> pipeline_;
  memory::FixedMemory memory_;
  std::optional<scene::SceneFinder> scene_;  ///< Exists if anything is to be found.
  status::FrameRecord record_;
  std::size_t next_ = 0;
  std::string trouble_;  ///< The reason why the newest cloud could not be labelled.
};

}  // namespace terracut::cli
