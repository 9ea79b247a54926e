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

/// The frames of a recording, whatever it is made of, for work that looks at them in advance.
class RecordedFrames {
 public:
  RecordedFrames() = default;
  RecordedFrames(const RecordedFrames&) = delete;
  RecordedFrames& operator=(const RecordedFrames&) = delete;
  virtual ~RecordedFrames() = default;

  using OnFrame = std::function<Status(const frame::RangeImage&)>;

  /// Shows at most so many frames, as a sensor on `mount` sees them. An error of `on_frame` ends
  /// it and is handed on; so is go_on()'s. kNothingCameOut where there is no frame.
  [[nodiscard]] virtual Status each_frame(const mount::Mount& mount, std::size_t most,
                                          const OnFrame& on_frame) = 0;
  [[nodiscard]] virtual mount::RingProfile ring_profile(const mount::Mount& mount) const = 0;

  /// Shows `finder` the near ground of at most so many frames. The errors of each_frame().
  [[nodiscard]] virtual Status look_for_mount(std::size_t most, mount::MountFinder& finder);
};

/// Of a capture, the first frames between --start and --duration, without the vehicle's motion. The
/// capture itself is left where it stands.
class CaptureFrames : public RecordedFrames {
 public:
  /// Both must outlive this.
  CaptureFrames(const OpenCapture& capture, const Options& options)
      : capture_(capture), options_(options) {}

  [[nodiscard]] Status each_frame(const mount::Mount& mount, std::size_t most,
                                  const OnFrame& on_frame) override;
  [[nodiscard]] mount::RingProfile ring_profile(const mount::Mount& mount) const override;
  /// First by the objects that label the capture, so that it takes no more memory than the run
  /// does: frames of points, which show a sensor that does not stand, take three times that of
  /// frames as measured.
  [[nodiscard]] Status look_for_mount(std::size_t most, mount::MountFinder& finder) override;

  /// Of the last pass.
  [[nodiscard]] const capture::PcapCounters& counters() const noexcept { return counters_; }
  /// Where it broke off; empty: it did not.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_; }

 private:
  [[nodiscard]] Status look_for_standing_mount(std::size_t most, mount::MountFinder& finder);
  /// Pushes the capture's datagrams into `frames`, a Decoder or what is made like it, until `take`
  /// had so many of those that come out.
  template <class Frames, class Take>
  Status pass(Frames& frames, std::size_t most, Take take);

  const OpenCapture& capture_;
  const Options& options_;
  capture::PcapCounters counters_;
  std::string fault_;
};

/// Of clouds, evenly taken ones. Those that cannot be read, and those of a covered sensor, which
/// have no place, are passed over.
class CloudFrames : public RecordedFrames {
 public:
  /// Both must outlive this.
  CloudFrames(CloudReader& clouds, const cloud::SensorRows& rows) : clouds_(clouds), rows_(rows) {}

  [[nodiscard]] Status each_frame(const mount::Mount& mount, std::size_t most,
                                  const OnFrame& on_frame) override;
  [[nodiscard]] mount::RingProfile ring_profile(const mount::Mount& mount) const override;

 private:
  CloudReader& clouds_;
  const cloud::SensorRows& rows_;
};

}  // namespace terracut::cli
