// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "calib/hdl64e/hdl64e_file.hpp"
#include "firmware_io/scan/scan_reader.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/figures/mount_watch.hpp"
#include "tools/cli/figures/report.hpp"
#include "tools/cli/input/frame_outputs.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

/// Labels one scan after the other; everything that is kept between them.
struct ScanLabeller {
  memory::FixedMemory memory;
  frame::ImageShape shape;
  frame::RangeImage image;
  ground::GroundMethod segmenter;
  scan::ScanToImage scan_to_image;
  scan::RingRecovery rings;
  scan::KittiScan scan;
  run::StageClock clock;
  std::vector<frame::Label> point_labels;
  std::vector<std::uint32_t> return_truth;
  MountWatch mount;
  Report::ScanPoints points;  ///< Of all scans.

  ScanLabeller(const ground::MethodConfig& config, const mount::RingProfile& profile)
      : image(shape, shape.cells(), memory),
        segmenter(config, profile, shape, image.return_capacity(), memory),
        scan_to_image(profile.mount),
        mount(profile.mount) {}

  /// Labels the scan and the rings that were just read.
  void label(status::FrameRecord& record) {
    const auto placed = scan_to_image.place(scan.points, rings.ring_of_point, image);
    mount.add_frame(image);
    record.segmentation = segmenter.segment(image, &clock);
    record.stages = clock.take();
    scan_to_image.labels_of_points(segmenter.labels(), point_labels);
    record.segmentation.count(point_labels);
    record.info.returns = static_cast<std::uint32_t>(scan.points.size() - placed.no_place);
    record.info.losses.overflow_full_returns = placed.overflow_full;
    points.no_place += placed.no_place;
    points.no_ring += placed.no_ring;
  }

  /// The scan's truth in the order of the image's returns; empty without labels.
  std::span<const std::uint32_t> truth_of_returns() {
    return_truth.clear();
    if (scan.labels.empty()) return return_truth;
    for (const std::uint32_t point : scan_to_image.point_of_return()) {
      return_truth.push_back(scan.labels[point]);
    }
    return return_truth;
  }
};

/// The unit's table, which the reader then tells rings by: the file's, else fitted to the scans.
Expected<hdl64e::Hdl64eCalibration> calibration_of(const Options& options,
                                                   scan::ScanReader& reader) {
  if (!options.capture.calibration.empty()) {
    auto calibration = hdl64e::load_hdl64e_calibration(options.capture.calibration);
    if (calibration) reader.use_rings(scan::ring_table(*calibration));
    return calibration;
  }
  const auto fitted = reader.fit_rings();
  if (!fitted) return tl::unexpected(fitted.error());
  say(fmt::format("calibration: fitted to the scans, height residual {:.1f} cm (p95)",
                  100 * fitted->residual.p95_m));
  if (fitted->from_nominal_table) {
    say("             no scan has all rings, so they were told apart by a nominal unit's table; "
        "--calibration takes the unit's own");
  }
  hdl64e::Hdl64eCalibration calibration = scan::hdl64e_calibration(fitted->table);
  calibration.origin = "fitted to the scans";
  return calibration;
}

}  // namespace

ExitCode run_segment(const Options& options) {
  catch_stop_signals();
  auto reader = scan::ScanReader::open(options.scans);
  if (!reader) return refuse(reader.error());
  const auto calibration = calibration_of(options, *reader);
  if (!calibration) return refuse(calibration.error());
  const auto profile = ring_profile_of(*calibration, options.mount);
  if (!profile) return refuse(profile.error());
  const std::string calibration_line =
      fmt::format("{}, fingerprint {:016x}", calibration->origin, fingerprint(*calibration));

  ScanLabeller labeller(method_config_of(options.method), *profile);
  FrameOutputs outputs(options.output);
  Report report{"segment", options.scans.string(), "", calibration_line, options.method};
  Progress progress("labelling", "scans", static_cast<double>(reader->size()));
  for (std::size_t i = 0; i < reader->size(); ++i) {
    if (stop_wanted()) {
      report.interrupted = true;
      break;
    }
    const scan::ScanFile& file = reader->file(i);
    const Status read = reader->read(i, labeller.scan, labeller.rings);
    if (!read) return refuse(read.error());
    status::FrameRecord record;
    record.info.complete = true;
    record.info.number = file.frame.value_or(static_cast<std::uint32_t>(i));
    labeller.label(record);
    report.add(record);
    if (!labeller.scan.labels.empty()) report.score(labeller.point_labels, labeller.scan.labels);
    Status written = outputs.write_labels(file.name, labeller.point_labels);
    if (written) {
      written = outputs.write_frame(file.name, labeller.image, labeller.segmenter.labels(),
                                    labeller.truth_of_returns());
    }
    if (!written) return refuse(written.error());
    progress.update(static_cast<double>(i + 1));
  }
  report.mount = labeller.mount.figures();
  report.scan_points = labeller.points;
  return conclude_with(report, options.output.json);
}

}  // namespace terracut::cli
