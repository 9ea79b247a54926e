// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "pipeline/status/figure.hpp"
#include "pipeline/status/frame_record.hpp"
#include "pipeline/status/mount_figures.hpp"
#include "rt/error.hpp"
#include "rt/measure/log_linear_histogram.hpp"
#include "tools/cli/exit_codes.hpp"
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

/// The report of a run: what the frames' records say, and the same summarised.
class Report {
 public:
  struct Run {
    std::string command;  ///< "replay"
    std::string input;
    std::string sensor;       ///< Model, spin rate and return mode; empty for scans.
    std::string calibration;  ///< Origin and fingerprint of the table in use.
    std::string profile, stages;
    std::string method;  ///< Named by --method: instead of profile and stages.
  };

  explicit Report(Run run) : run_(std::move(run)) {}

  void add(const status::FrameRecord& frame);
  /// `unscored`: frames for which no fitting truth was found.
  void set_quality(const quality::Quality& quality, std::uint64_t unscored = 0) {
    quality_ = quality;
    unscored_ = unscored;
  }
  /// Everything lost in the run, where that is more than the frames' sum (losses after the last
  /// one).
  void set_losses(const frame::LossCounters& losses) { losses_ = losses; }
  /// Where the sensor sends nothing, as known at the end of the run.
  void set_blind(const frame::BlindAzimuths& blind) { blind_ = blind; }
  /// Samples of the vehicle's motion there were; set where frames were to be deskewed.
  void set_motion_samples(std::uint64_t samples) { motion_samples_ = samples; }
  /// Points of scan files that got no return: null or not finite, labelled 0; and of no ring,
  /// labelled as obstacles.
  void set_scan_points(std::uint64_t no_place, std::uint64_t no_ring) {
    scan_points_ = {no_place, no_ring};
  }
  void set_mount(const status::MountFigures& mount) { mount_ = mount; }
  /// What is known of the sensor's clock, for people.
  void set_device_clock(std::string text) { device_clock_ = std::move(text); }
  /// The run was ended before its work was done: what it reports is not of all its input.
  void set_interrupted(bool interrupted) { interrupted_ = interrupted; }
  [[nodiscard]] bool interrupted() const noexcept { return interrupted_; }
  /// The input broke off, and where.
  void set_input_warning(std::string warning) { input_warning_ = std::move(warning); }

  [[nodiscard]] std::size_t frames() const noexcept { return records_.size(); }
  [[nodiscard]] frame::LossCounters losses() const;

  /// The summary for people, several lines, as printed on stdout.
  [[nodiscard]] std::string text() const;
  /// The whole report for programs, whole or not at all:
  ///
  ///   terracut, command, input, calibration   of what ran on what
  ///   profile, stages; or method, where --method named it
  ///   interrupted     the run was ended before all of its input was read
  ///   input_warning   where the input broke off, if it did
  ///   frames[]        frame (number), first_packet_ns, complete, returns_in, returns_labelled,
  ///                   losses{cause: count}, ms{stage: processor time; decode, total, and
  ///                   after_frame: of it, after the frame's last packet}, segment_wall_ms,
  ///                   min_cut{unknown, coarse, ops}; with a CAN recording deskewed
  ///   summary         frames, complete_frames, returns_in, returns_labelled, losses{cause: count},
  ///                   ms{stage: {count, mean, p50, p90, p99, p99.9, max}}, segment_wall_ms{the
  ///                   same};
  ///                   with truth iou_g, recall_o, unscored_frames; of scans points_no_place,
  ///                   points_no_ring; mount and blind as of a live run; with a CAN recording
  ///                   motion{samples, deskewed_frames, newest_sample_after_frame_ms{min, median,
  ///                   max}}
  [[nodiscard]] Status write_json(const std::filesystem::path& path) const;

 private:
  [[nodiscard]] std::vector<status::Figure> run_figures() const;
  [[nodiscard]] std::vector<status::Figure> summary_figures() const;

  Run run_;
  std::vector<status::FrameRecord> records_;
  TimeSummary times_;
  std::optional<frame::LossCounters> losses_;
  std::optional<quality::Quality> quality_;
  std::uint64_t unscored_ = 0;
  struct ScanPoints {
    std::uint64_t no_place, no_ring;
  };
  std::optional<ScanPoints> scan_points_;
  status::MountFigures mount_;
  frame::BlindAzimuths blind_;
  std::optional<std::uint64_t> motion_samples_;
  std::string device_clock_;
  std::string input_warning_;
  bool interrupted_ = false;
};

/// Prints the report, writes it to `json` too unless that is empty, and returns the exit code.
[[nodiscard]] ExitCode conclude_with(const Report& report, const std::filesystem::path& json);

}  // namespace terracut::cli
