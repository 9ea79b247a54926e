// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <string>
#include <utility>

#include "tools/cli/arguments/command_files.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/settings/made_calibration.hpp"
#include "tools/cli/stop_signal.hpp"
#include "tools/lab/encode/scan_drive.hpp"

namespace terracut::cli {
namespace {

/// A larger error of heights causes a warning, because it hides kerbs. Over the 18 scans of the
/// tuning set, heights are off by at most 2 cm if the sensor's motion is restored; if not, by 6 cm
/// on slow drives and 10 cm on fast ones.
constexpr double kTooFarOff_m = 0.08;

std::string motion_line(const std::string& why_as_recorded) {
  return "motion    " + (why_as_recorded.empty()
                             ? "put back, by poses.txt and times.txt beside the scans"
                             : "as recorded: " + why_as_recorded);
}

/// Returns advice on how to correct heights that are too far off.
std::string cure_of_heights(const Options& options, const encode::ScanDriveReport& report) {
  if (options.encode.keep_compensation) {
    return "the scans are compensated for the sensor's motion; leave --keep-compensation away";
  }
  if (!report.why_as_recorded.empty()) {
    return fmt::format(
        "scans are usually compensated for the sensor's motion, which can be put "
        "back by the sequence's poses.txt, times.txt and calib.txt beside velodyne/ "
        "({})",
        report.why_as_recorded);
  }
  if (!report.fitted) return "--calibration may be of another unit; without it one is fitted";
  return "are poses.txt, times.txt and calib.txt those of this sequence? If the scans are not "
         "compensated for the sensor's motion, give --keep-compensation";
}

void print(const Options& options, const encode::ScanDriveReport& report) {
  const encode::EncodeSummary& encoded = report.encoded;
  print_out("{}table     {}, fingerprint {:016x}\n", wrote_drive(options),
            report.fitted ? "fitted to the scans" : report.calibration.origin,
            fingerprint(report.calibration));
  print_out("{}\nframes    {}, the head at {:.2f} Hz\nreturns   {} of {} points ({:.2f} %)\n",
            motion_line(report.why_as_recorded), report.drive.frames, report.spin_hz,
            encoded.encoded, encoded.points,
            encoded.points == 0 ? 0.0
                                : 100.0 * static_cast<double>(encoded.encoded) /
                                      static_cast<double>(encoded.points));
  for (std::size_t i = 0; i < encode::kNotEncodedReasons; ++i) {
    if (encoded.not_encoded[i] == 0) continue;
    print_out("          {} left out: {}\n", encoded.not_encoded[i],
              to_string(static_cast<encode::NotEncoded>(i)));
  }
  print_out("azimuth   off by {:.3f} degrees (median), {:.2f} at most\n",
            encoded.median_azimuth_shift_deg, encoded.max_azimuth_shift_deg);
  print_out("range     off by {:.1f} mm at most\n", 1000 * encoded.max_range_error_m);
  print_out("height    off by {:.1f} cm (rms), {:.1f} cm (p95)\n", 100 * encoded.height.rms_m,
            100 * encoded.height.p95_m);
  if (encoded.height.p95_m > kTooFarOff_m) {
    warn(fmt::format("heights are off by {:.1f} cm (p95), which bends the ground: {}",
                     100 * encoded.height.p95_m, cure_of_heights(options, report)));
  }
}

}  // namespace

ExitCode run_encode(const Options& options) {
  catch_stop_signals();
  encode::ScanDriveOptions drive;
  drive.can_log = options.can_log;
  if (options.encode.keep_compensation) drive.motion = encode::PutMotionBack::kNever;
  if (!options.capture.calibration.empty()) {
    auto calibration = made_calibration(options.capture, packets::Hdl64eEncoderTraits{});
    if (!calibration) return refuse(calibration.error());
    drive.calibration = *std::move(calibration);
  }
  Progress progress("encoding", "scans", 0);
  drive.on_scan = [&](std::size_t done, std::size_t) {
    progress.update(static_cast<double>(done));
    return go_on();
  };
  const auto report = encode::encode_scan_folder(options.scans, options.written, drive);
  if (!report) return refuse_work(report.error());
  print(options, *report);
  return kOk;
}

}  // namespace terracut::cli
