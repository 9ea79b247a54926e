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

/// A capture's way to labels on one thread, a frame at a time, for whoever asks for the next:
/// source, the vehicle's motion, decoder and method as the options say, the mount found where it is
/// not stated, and the report of what came of it.
class LabelledCapture {
 public:
  /// Finds sensor, calibration and mount, which reads the capture's beginning. The errors of
  /// open_capture(), choose_mount(), ring_profile_of() and RecordedMotion::open().
  [[nodiscard]] static Expected<std::unique_ptr<LabelledCapture>> open(const Options& options,
                                                                       FramesAreFor purpose);
  LabelledCapture(const LabelledCapture&) = delete;
  LabelledCapture& operator=(const LabelledCapture&) = delete;

  /// The next frame, labelled, valid until the next call; null at the end, where the capture breaks
  /// off (report().input_warning says where), and when stop_wanted().
  [[nodiscard]] const run::Frame* next();
  /// Of that frame, one a return, by return index.
  [[nodiscard]] std::span<const frame::Label> labels() const noexcept {
    return pipeline_->labels();
  }
  /// When its returns were measured.
  [[nodiscard]] points::FrameTiming timing(const run::Frame& frame) const noexcept {
    return points::FrameTiming::of(frame.record.info, decoder().beam_turns());
  }

  /// From the beginning again, or from so many seconds behind it, where the first frame lacks what
  /// was before. The errors of the sources.
  [[nodiscard]] Status rewind(std::optional<double> start_s = {});
  /// Called with the stamp of each datagram before it is decoded, to keep its pace.
  void before_each(std::function<void(std::int64_t stamp_ns)> wait) { wait_ = std::move(wait); }

  /// After the last frame: what is known at the end of the run goes into the report, warnings are
  /// said. kNothingCameOut where there was no frame; kMalformed where there was motion to deskew
  /// by, and no frame it was good for.
  [[nodiscard]] Status conclude();
  [[nodiscard]] Report& report() noexcept { return report_; }
  /// Datagrams given to the decoder.
  [[nodiscard]] std::uint64_t offered() const noexcept { return offered_; }
  /// Of what was read so far, in all passes; it balances when next() has returned null.
  [[nodiscard]] capture::CaptureAccount account() const;
  /// How long the capture has been running at a stamp near the newest datagram's.
  [[nodiscard]] std::int64_t since_begin_ns(std::int64_t stamp_ns) const noexcept {
    return part_->clock().since_begin_ns(stamp_ns);
  }

  [[nodiscard]] const OpenCapture& capture() const noexcept { return *capture_; }
  [[nodiscard]] const decode::Decoder& decoder() const noexcept { return pipeline_->decoder(); }
  /// The run's.
  [[nodiscard]] const mount::Mount& sensor_mount() const noexcept { return sensor_mount_; }
  /// As stated, and as found.
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
  const packet::Datagram* pushed_ = nullptr;  ///< Whose frames are being handed out.
  std::uint64_t offered_ = 0;
  capture::CaptureAccount account_;  ///< What nobody else counts, of the passes before this one.
  bool gives_frames_ = false;        ///< Something was pushed, whose frames are not all out.
  bool ended_ = false;
  bool warned_of_part_ = false;
};

}  // namespace terracut::cli
