// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/run/cloud_pipeline.hpp"
#include "pipeline/scene/scene_finder.hpp"
#include "played_recording.hpp"
#include "tools/cli/input/cloud_input.hpp"
#include "tools/cli/input/frame_truth.hpp"
#include "tools/cli/options.hpp"
#include "truth_doubt.hpp"

namespace terracut::cli {

/// A folder of clouds, or one cloud, played at ten a second, because files have no stamps.
class PlayedClouds : public PlayedRecording {
 public:
  /// Finds the lasers' rows and the mount. Clouds are compared with `truth`, or else with that of
  /// their own folder, and with the labels by `beside`, if that is not null. Fails with the errors
  /// of CloudReader::open(), rows_of(), choose_mount() and ring_profile_of().
  [[nodiscard]] static Expected<std::unique_ptr<PlayedClouds>> open(
      const std::filesystem::path& clouds, const Options& options, FrameTruth truth,
      const MethodOptions* beside);

  [[nodiscard]] const std::string& sensor_line() const noexcept { return sensor_line_; }
  [[nodiscard]] int rows() const noexcept { return pipeline_->image().shape().rows; }
  [[nodiscard]] const mount::Mount& sensor_mount() const noexcept { return mount_; }
  [[nodiscard]] bool has_truth() const noexcept { return truth_.exists() || reader_.has_labels(); }

  [[nodiscard]] double frame_s() const override;
  /// Returns the next cloud, labelled. Leaves out clouds that cannot be labelled, with a warning.
  [[nodiscard]] std::optional<Span> next() override;
  [[nodiscard]] Status take(PlayedFrame& frame) override;
  [[nodiscard]] Status go_to(double seek_s) override;
  [[nodiscard]] Status conclude() override;
  void measure(const OnLength& on_length) const override;

 private:
  PlayedClouds(CloudReader reader, FrameTruth truth)
      : reader_(std::move(reader)), truth_(std::move(truth)), doubt_(truth_.exists()) {}
  [[nodiscard]] Status label(std::size_t index);
  void read_truth(std::size_t index, std::size_t points);

  CloudReader reader_;
  FrameTruth truth_;
  std::vector<std::uint32_t> point_truth_;  ///< Of the newest cloud; empty without truth.
  Status truth_read_;
  TruthDoubt doubt_;  ///< Truth that nobody asked for is not refused.
  std::string sensor_line_;
  mount::Mount mount_;
  std::unique_ptr<run::CloudPipeline> pipeline_;
  memory::FixedMemory memory_;
  std::unique_ptr<ground::FrameMethod> beside_;  ///< Null without a second method.
  std::optional<scene::SceneFinder> scene_;      ///< Exists if anything is to be found.
  status::FrameRecord record_;
  std::size_t next_ = 0;
  std::string trouble_;  ///< The reason why the newest cloud could not be labelled.
};

}  // namespace terracut::cli
