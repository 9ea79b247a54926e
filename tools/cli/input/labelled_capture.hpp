// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "firmware_io/capture/capture_account.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "mount_choice.hpp"
#include "open_capture.hpp"
#include "pipeline/points/labelled_points.hpp"
#include "pipeline/run/packet_pipeline.hpp"
#include "recorded_motion.hpp"
#include "rt/error.hpp"
#include "tools/cli/figures/run_report.hpp"
#include "tools/cli/input/device_clock.hpp"
#include "tools/cli/input/mount_watch.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Labels a capture on one thread, frame by frame. Made from the options, it holds the source, the
/// vehicle's motion, decoder and method, the mount (found unless stated), and the report.
class LabelledCapture {
 public:
  using Makes = run::PacketPipeline::Makes;

  /// Opens the capture and reads its beginning to find sensor, calibration and mount. `makes` says
  /// what frames are to come with. Fails with
  /// the errors of open_capture(), choose_mount(), ring_profile_of() and RecordedMotion::open().
  [[nodiscard]] static Expected<std::unique_ptr<LabelledCapture>> open(const Options& options,
                                                                       Makes makes);
  LabelledCapture(const LabelledCapture&) = delete;
  LabelledCapture& operator=(const LabelledCapture&) = delete;

  /// Returns the next labelled frame, valid until the next call. Returns null at the end, when
  /// stop_wanted(), and where the capture breaks off (report().input_warning then says so).
  [[nodiscard]] const run::Frame* next();
  /// Returns the labels of the frame returned last, by return index.
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept {
    return pipeline_->labels();
  }
  /// Returns the heights of these returns above the ground, metres; empty unless asked for.
  [[nodiscard]] std::span<const float> heights_m() const noexcept { return pipeline_->heights_m(); }
  /// Returns the measuring times of the returns of `frame`.
  [[nodiscard]] points::FrameTiming timing(const run::Frame& frame) const noexcept {
    return points::FrameTiming::of(frame.record.info, decoder().beam_turns());
  }

  /// Goes back to the beginning, or to `start_s` seconds after it, where the first frame is cut off
  /// at its beginning. Fails with the errors of the sources.
  [[nodiscard]] Status rewind(std::optional<double> start_s = {});
  /// Sets a function that is called with the stamp of each datagram before it is decoded; it may
  /// wait.
  void before_each(std::function<void(std::int64_t stamp_ns)> wait) { wait_ = std::move(wait); }

  /// Ends the run after the last frame: completes the report and prints warnings. Fails with
  /// kNothingCameOut if there was no frame, kMalformed if the motion for deskewing fitted no frame.
  [[nodiscard]] Status conclude();
  [[nodiscard]] Report& report() noexcept { return report_; }
  /// Returns the number of datagrams given to the decoder.
  [[nodiscard]] std::uint64_t offered() const noexcept { return offered_; }
  /// Returns the number of datagrams read in all passes by what became of them; complete once
  /// next() has returned null.
  [[nodiscard]] capture::CaptureAccount account() const;
  /// Returns the running time of the capture for a stamp near that of the newest datagram.
  [[nodiscard]] std::int64_t since_begin_ns(std::int64_t stamp_ns) const noexcept {
    return part_->clock().since_begin_ns(stamp_ns);
  }

  [[nodiscard]] const OpenCapture& capture() const noexcept { return *capture_; }
  [[nodiscard]] const decode::Decoder& decoder() const noexcept { return pipeline_->decoder(); }
  /// Returns how the sensor's lasers meet the ground, by the mount in use.
  [[nodiscard]] const mount::RingProfile& profile() const noexcept { return profile_; }
  /// Returns the mount in use.
  [[nodiscard]] const mount::Mount& sensor_mount() const noexcept { return profile_.mount; }
  /// Returns which figures of the mount were stated and which were found.
  [[nodiscard]] const MountChoice& mount() const noexcept { return *mount_choice_; }

 private:
  explicit LabelledCapture(const Options& options) : options_(options) {}
  Status prepare(Makes makes);
  /// True if the mount is watched by the near ground of this frame.
  [[nodiscard]] static bool is_watched(std::uint32_t frame) noexcept;
  [[nodiscard]] bool decode_one();
  void note_packet(const packet::Datagram& datagram);

  Options options_;
  std::optional<OpenCapture> capture_;
  std::optional<MountChoice> mount_choice_;
  mount::RingProfile profile_;
  memory::FixedMemory motion_memory_, memory_;
  std::optional<RecordedMotion> motion_;
  std::optional<run::PacketPipeline> pipeline_;
  std::optional<CapturePart> part_;
  hdl64e::StatusStreamReader status_;
  std::optional<DeviceClock> clock_of_device_;
  std::unique_ptr<ground::NearGround> near_ground_ = std::make_unique<ground::NearGround>();
  std::optional<MountWatch> mount_;
  Report report_;
  std::function<void(std::int64_t)> wait_;
  /// The datagram that completed the frames being handed out.
  const packet::Datagram* pushed_ = nullptr;
  std::uint64_t offered_ = 0;
  capture::CaptureAccount account_;  ///< The counts of earlier passes.
  bool gives_frames_ = false;        ///< True if the last datagram may give more frames.
  bool ended_ = false;
  bool warned_of_part_ = false;
};

}  // namespace terracut::cli
