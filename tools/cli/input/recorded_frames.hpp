// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "calib/mount/mount_finder.hpp"
#include "calib/mount/ring_profile.hpp"
#include "cloud_input.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "open_capture.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// The frames of a recording, for work that looks at frames before the run.
class RecordedFrames {
 public:
  RecordedFrames() = default;
  RecordedFrames(const RecordedFrames&) = delete;
  RecordedFrames& operator=(const RecordedFrames&) = delete;
  virtual ~RecordedFrames() = default;

  using OnFrame = std::function<Status(const frame::RangeImage&)>;

  /// Calls `on_frame` for at most `most` frames, decoded with `mount`. Stops at the first error of
  /// `on_frame` or go_on() and returns it. Fails with kNothingCameOut if there is no frame.
  [[nodiscard]] virtual Status each_frame(const mount::Mount& mount, std::size_t most,
                                          const OnFrame& on_frame) = 0;
  [[nodiscard]] virtual mount::RingProfile ring_profile(const mount::Mount& mount) const = 0;

  /// Gives `finder` the near ground of at most `most` frames. Fails as each_frame() does.
  [[nodiscard]] virtual Status look_for_mount(std::size_t most, mount::MountFinder& finder);
};

/// The first frames of a capture between --start and --duration, without the vehicle's motion.
/// Reading them leaves the position of the capture unchanged.
class CaptureFrames : public RecordedFrames {
 public:
  /// Both arguments must outlive this object.
  CaptureFrames(const OpenCapture& capture, const Options& options)
      : capture_(capture), options_(options) {}

  [[nodiscard]] Status each_frame(const mount::Mount& mount, std::size_t most,
                                  const OnFrame& on_frame) override;
  [[nodiscard]] mount::RingProfile ring_profile(const mount::Mount& mount) const override;
  /// Tries first with the objects that label the capture, so that it takes no more memory than the
  /// run. Only a sensor that is not upright needs images of points.
  [[nodiscard]] Status look_for_mount(std::size_t most, mount::MountFinder& finder) override;

  /// Returns the counters of the last pass.
  [[nodiscard]] const capture::CaptureCounters& counters() const noexcept { return counters_; }
  /// Returns where the capture broke off; empty if it did not.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }

 private:
  [[nodiscard]] Status look_for_standing_mount(std::size_t most, mount::MountFinder& finder);
  /// Pushes the capture's datagrams into `frames`, such as a Decoder, until `take` has had `most`
  /// frames.
  template <class Frames, class Take>
  Status pass(Frames& frames, std::size_t most, Take take);

  const OpenCapture& capture_;
  const Options& options_;
  capture::CaptureCounters counters_;
  std::string fault_;
};

/// Evenly spaced clouds of a folder. Leaves out clouds that cannot be read, and clouds without a
/// valid position, as of a covered sensor.
class CloudFrames : public RecordedFrames {
 public:
  /// Both arguments must outlive this object.
  CloudFrames(CloudReader& clouds, const cloud::SensorRows& rows) : clouds_(clouds), rows_(rows) {}

  [[nodiscard]] Status each_frame(const mount::Mount& mount, std::size_t most,
                                  const OnFrame& on_frame) override;
  [[nodiscard]] mount::RingProfile ring_profile(const mount::Mount& mount) const override;

 private:
  CloudReader& clouds_;
  const cloud::SensorRows& rows_;
};

}  // namespace terracut::cli
