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
#include "pipeline/visibility/sight_figures.hpp"
#include "rt/error.hpp"
#include "rt/measure/log_linear_histogram.hpp"
#include "tools/cli/exit_codes.hpp"
#include "tools/cli/figures/frame_entries.hpp"
#include "tools/cli/options.hpp"
#include "tools/lab/quality/quality.hpp"

namespace terracut::cli {

/// Times over all frames: of each stage, of decoding, of their sum, and of the part after the end
/// of the frame.
struct TimeSummary {
  std::array<measure::LogLinearHistogram, stage::kStages> stages;
  measure::LogLinearHistogram decode, total, after_frame;

  void add(const status::FrameRecord& frame) noexcept;
  /// Returns the figures, which refer to this object.
  [[nodiscard]] std::vector<status::Figure> figures() const;
};

/// The sums over the records of all frames.
struct FrameTotals {
  std::uint64_t frames = 0, complete = 0, returns_in = 0, returns_labelled = 0, returns_below = 0;
  frame::LossCounters losses;
  std::uint64_t deskewed = 0;
  std::vector<std::int64_t> newest_motion_ns;  ///< One for each frame of a run with motion.

  void add(const status::FrameRecord& frame, bool has_motion);
};

/// Returns figures that tell which method ran: its name, or profile and stages.
[[nodiscard]] std::vector<status::Figure> method_figures(const MethodOptions& options);

/// Returns figures for the report: how many datagrams lie before and behind the requested part of a
/// capture.
[[nodiscard]] std::vector<status::Figure> outside_figures(std::uint64_t before_start,
                                                          std::uint64_t behind_end);

/// Returns a frame's entry in the report's frames[].
[[nodiscard]] nlohmann::ordered_json frame_json(const status::FrameRecord& frame);

/// The report of a run: the frames' records and a summary.
struct Report {
  std::string command;  ///< The command that ran, such as "replay".
  std::string input;
  std::string sensor;       ///< Model, spin rate and return mode; empty for scans.
  std::string calibration;  ///< Origin and fingerprint of the calibration table in use.
  MethodOptions method;

  std::optional<FrameEntries> entries{};  ///< Filled by add() if the whole report is wanted.
  FrameTotals totals{};                   ///< Filled by add().
  TimeSummary times{};
  quality::Quality scores{};  ///< Filled by score().
  std::uint64_t scored = 0;   ///< Number of frames that had fitting truth.

  /// All losses of the run; set if losses after the last frame make them more than the frames' sum.
  std::optional<frame::LossCounters> losses{};
  std::optional<capture::CaptureAccount> datagrams{};  ///< For a capture.
  frame::BlindAzimuths blind{};  ///< Where the sensor sends nothing, as known at the end.
  status::MountFigures mount{};
  visibility::SightFigures sight{};
  /// Samples of the vehicle's motion; set before the first frame in runs that deskew.
  std::optional<std::uint64_t> motion_samples{};
  /// Points of scan files: those without a return (null or not finite), labelled 0, and those
  /// without a ring, labelled as obstacles.
  struct ScanPoints {
    std::uint64_t no_place = 0, no_ring = 0;
  };
  std::optional<ScanPoints> scan_points{};
  std::string device_clock{};    ///< State of the sensor's clock, for people.
  std::string sensor_warning{};  ///< Why clouds may be of several sensors or another frame.
  std::string input_warning{};   ///< Where the input broke off.
  bool interrupted = false;      ///< True if the run ended before all input was processed.

  void add(const status::FrameRecord& frame);
  void score(std::span<const frame::Label> labels, std::span<const std::uint32_t> truth);

  /// Returns the summary for people, several lines, as printed on stdout.
  [[nodiscard]] std::string text() const;
  /// Writes the report for programs, whole or not at all:
  ///
  ///   terracut, command, input, calibration   of what ran on what
  ///   profile, stages; or method, where --method named it
  ///   interrupted     the run was ended before all of its input was read
  ///   sensor_warning  why clouds may not be one sensor's in its own frame
  ///   input_warning   where the input broke off, if it did; of clouds what could not be used
  ///   frames[]        frame (number), first_packet_ns, complete, returns_in, returns_labelled,
  ///   returns_below,
  ///                   losses{cause: count}, ms{stage: processor time; decode, total, and
  ///                   after_frame: of it, after the closing packet},
  ///                   min_cut{unknown, coarse, ops}; with a CAN recording deskewed
  ///   summary         frames, complete_frames, returns_in, returns_labelled, losses{cause: count},
  ///                   ms{stage: {count, mean, p50, p90, p99, p99.9, max}};
  ///                   of a capture datagrams{what became of them: count; read: their sum};
  ///                   with truth iou_g, recall_o, unscored_frames; of scans points_no_place,
  ///                   points_no_ring; mount, blind and sight as of a live run; with a CAN recording
  ///                   motion{samples, deskewed_frames, newest_sample_after_frame_ms{min, median,
  ///                   max}}
  [[nodiscard]] Status write_json(const std::filesystem::path& path);
  /// Returns the report for programs, with an empty list of frames.
  [[nodiscard]] nlohmann::ordered_json json() const;

 private:
  [[nodiscard]] std::vector<status::Figure> run_figures() const;
  [[nodiscard]] std::vector<status::Figure> summary_figures() const;
};

/// Prints the report, writes it to `json` unless that is empty, and returns the exit code.
[[nodiscard]] ExitCode conclude_with(Report& report, const std::filesystem::path& json);

}  // namespace terracut::cli
