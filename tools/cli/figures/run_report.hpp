// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/capture/capture_account.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "pipeline/status/figure.hpp"
#include "pipeline/status/frame_record.hpp"
#include "pipeline/status/mount_figures.hpp"
#include "rt/error.hpp"
#include "rt/measure/log_linear_histogram.hpp"
#include "tools/cli/exit_codes.hpp"
#include "tools/cli/figures/frame_entries.hpp"
#include "tools/cli/options.hpp"
#include "tools/lab/quality/quality.hpp"

namespace terracut::cli {

/// Times of all frames: per stage, decoding and the sum of both; of it what came after the frame's
/// end; and by the wall clock.
struct TimeSummary {
  std::array<measure::LogLinearHistogram, stage::kStages> stages;
  measure::LogLinearHistogram decode, total, after_frame, wall;

  void add(const status::FrameRecord& frame) noexcept;
  /// They refer to this.
  [[nodiscard]] std::vector<status::Figure> figures() const;
};

/// What the records of all frames add up to.
struct FrameTotals {
  std::uint64_t frames = 0, complete = 0, returns_in = 0, returns_labelled = 0;
  frame::LossCounters losses;
  std::uint64_t deskewed = 0, remembering = 0, contradicted = 0;
  std::vector<std::int64_t> newest_motion_ns;  ///< Of each frame of a run that has motion.

  void add(const status::FrameRecord& frame, bool has_motion);
};

/// The method that ran: its name, or profile and stages.
[[nodiscard]] std::vector<status::Figure> method_figures(const MethodOptions& options);

/// How many datagrams lie outside of the part of a capture that was asked for.
[[nodiscard]] std::vector<status::Figure> outside_figures(std::uint64_t before_start,
                                                          std::uint64_t behind_end);

/// An entry of frames[] in the report.
[[nodiscard]] nlohmann::ordered_json frame_json(const status::FrameRecord& frame);

/// The report of a run: what the frames' records say, and the same summarised.
struct Report {
  std::string command;  ///< "replay"
  std::string input;
  std::string sensor;       ///< Model, spin rate and return mode; empty for scans.
  std::string calibration;  ///< Origin and fingerprint of the table in use.
  MethodOptions method;

  std::optional<FrameEntries> entries{};  ///< By add(), where the whole report is wanted.
  FrameTotals totals{};                   ///< By add().
  TimeSummary times{};
  quality::Quality scores{};  ///< By score().
  std::uint64_t scored = 0;   ///< Frames with fitting truth.

  /// Everything lost in the run, where that is more than the frames' sum (losses after the last
  /// one).
  std::optional<frame::LossCounters> losses{};
  std::optional<capture::CaptureAccount> datagrams{};  ///< Of a capture.
  frame::BlindAzimuths blind{};  ///< Where the sensor sends nothing, as known at the end.
  status::MountFigures mount{};
  /// Samples of the vehicle's motion there were; of runs whose frames are to be deskewed, from
  /// before the first frame.
  std::optional<std::uint64_t> motion_samples{};
  /// Points of scan files that got no return: null or not finite, labelled 0; and of no ring,
  /// labelled as obstacles.
  struct ScanPoints {
    std::uint64_t no_place = 0, no_ring = 0;
  };
  std::optional<ScanPoints> scan_points{};
  std::string device_clock{};    ///< What is known of the sensor's clock, for people.
  std::string sensor_warning{};  ///< Why clouds may not be one sensor's in its own frame.
  std::string input_warning{};   ///< What of the input is missing: where it broke off.
  bool interrupted = false;      ///< Ended before its work was done: not of all its input.

  void add(const status::FrameRecord& frame);
  void score(std::span<const frame::Label> labels, std::span<const std::uint32_t> truth);

  /// The summary for people, several lines, as printed on stdout.
  [[nodiscard]] std::string text() const;
  /// The whole report for programs, whole or not at all:
  ///
  ///   terracut, command, input, calibration   of what ran on what
  ///   profile, stages; or method, where --method named it
  ///   interrupted     the run was ended before all of its input was read
  ///   sensor_warning  why clouds may not be one sensor's in its own frame
  ///   input_warning   where the input broke off, if it did; of clouds what could not be used
  ///   frames[]        frame (number), first_packet_ns, complete, returns_in, returns_labelled,
  ///                   losses{cause: count}, ms{stage: processor time; decode, total, and
  ///                   after_frame: of it, after the frame's last packet}, segment_wall_ms,
  ///                   min_cut{unknown, coarse, ops}; with a CAN recording deskewed
  ///   summary         frames, complete_frames, returns_in, returns_labelled, losses{cause: count},
  ///                   ms{stage: {count, mean, p50, p90, p99, p99.9, max}}, segment_wall_ms{the
  ///                   same};
  ///                   of a capture datagrams{what became of them: count; read: their sum};
  ///                   with truth iou_g, recall_o, unscored_frames; of scans points_no_place,
  ///                   points_no_ring; mount and blind as of a live run; with a CAN recording
  ///                   motion{samples, deskewed_frames, newest_sample_after_frame_ms{min, median,
  ///                   max}}
  [[nodiscard]] Status write_json(const std::filesystem::path& path);
  /// The same with an empty list of frames.
  [[nodiscard]] nlohmann::ordered_json json() const;

 private:
  [[nodiscard]] std::vector<status::Figure> run_figures() const;
  [[nodiscard]] std::vector<status::Figure> summary_figures() const;
};

/// Prints the report, writes it to `json` too unless that is empty, and returns the exit code.
[[nodiscard]] ExitCode conclude_with(Report& report, const std::filesystem::path& json);

}  // namespace terracut::cli
