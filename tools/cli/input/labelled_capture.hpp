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
#include "tools/cli/settings/decoder_choice.hpp"

namespace terracut::cli {

/// Labels a capture on one thread, a frame at a time: source, vehicle's motion, decoder and method
/// by the options, the mount found unless stated, and the report.
class LabelledCapture {
 public:
  /// Finds sensor, calibration and mount, which reads the capture's beginning. Errors of
  /// open_capture(), choose_mount(), ring_profile_of() and RecordedMotion::open().
  [[nodiscard]] static Expected<std::unique_ptr<LabelledCapture>> open(const Options& options,
                                                                       FramesAreFor purpose);
  LabelledCapture(const LabelledCapture&) = delete;
  LabelledCapture& operator=(const LabelledCapture&) = delete;

  /// Returns the next labelled frame, valid until the next call; null at the end, where the capture
  /// breaks off (report().input_warning says where), and when stop_wanted().
  [[nodiscard]] const run::Frame* next();
  /// Returns the labels of that frame, by return index.
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept {
    return pipeline_->labels();
  }
  /// Returns when its returns were measured.
  [[nodiscard]] points::FrameTiming timing(const run::Frame& frame) const noexcept {
    return points::FrameTiming::of(frame.record.info, decoder().beam_turns());
  }

  /// Goes back to the beginning, or to so many seconds after it, where the first frame lacks its
  /// earlier packets. Errors of the sources.
  [[nodiscard]] Status rewind(std::optional<double> start_s = {});
  /// Sets a function that is called with the stamp of each datagram before it is decoded, to keep
  /// pace.
  void before_each(std::function<void(std::int64_t stamp_ns)> wait) { wait_ = std::move(wait); }

  /// Ends the run after the last frame: completes the report and prints warnings. kNothingCameOut
  /// if there was no frame; kMalformed if there was motion for deskewing but it fitted no frame.
  [[nodiscard]] Status conclude();
  [[nodiscard]] Report& report() noexcept { return report_; }
  /// Returns the datagrams given to the decoder.
  [[nodiscard]] std::uint64_t offered() const noexcept { return offered_; }
  /// Accounts for all that was read in all passes; balances once next() has returned null.
  [[nodiscard]] capture::CaptureAccount account() const;
  /// Returns the capture's running time at a stamp near the newest datagram's.
  [[nodiscard]] std::int64_t since_begin_ns(std::int64_t stamp_ns) const noexcept {
    return part_->clock().since_begin_ns(stamp_ns);
  }

  [[nodiscard]] const OpenCapture& capture() const noexcept { return *capture_; }
  [[nodiscard]] const decode::Decoder& decoder() const noexcept { return pipeline_->decoder(); }
  /// Returns the run's mount.
  [[nodiscard]] const mount::Mount& sensor_mount() const noexcept { return sensor_mount_; }
  /// Returns the mount as stated and as found.
  [[nodiscard]] const MountChoice& mount() const noexcept { return *mount_choice_; }

 private:
  explicit LabelledCapture(const Options& options) : options_(options) {}
  Status prepare(FramesAreFor purpose);
  [[nodiscard]] bool decode_one();
  void note_packet(const packet::Datagram& datagram);

  Options options_;
  std::optional<OpenCapture> capture_;
  std::optional<MountChoice> mount_choice_;
  mount::Mount sensor_mount_;
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
  const packet::Datagram* pushed_ = nullptr;  ///< The datagram whose frames are being handed out.
  std::uint64_t offered_ = 0;
  capture::CaptureAccount account_;  ///< Counts of earlier passes that are kept only here.
  bool gives_frames_ = false;        ///< Frames of the last datagram may remain.
  bool ended_ = false;
  bool warned_of_part_ = false;
};

}  // namespace terracut::cli
