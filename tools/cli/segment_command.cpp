// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "calib/hdl64e_file.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "firmware_io/scan/scan_reader.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "frame_outputs.hpp"
#include "mount_watch.hpp"
#include "report.hpp"
#include "setup_choice.hpp"
#include "stop_signal.hpp"

namespace terracut::cli {
namespace {

/// Labels one scan after the other; everything that is kept between them.
struct ScanLabeller {
  rt::FixedMemory memory;
  pipeline::ImageShape shape;
  pipeline::RangeImage image;
  pipeline::GroundMethod segmenter;
  firmware_io::ScanToImage scan_to_image;
  firmware_io::RingRecovery rings;
  firmware_io::KittiScan scan;
  StageClock clock;
  std::vector<pipeline::Label> point_labels;
  std::vector<std::uint32_t> return_truth;
  MountWatch mount;
  pipeline::Quality quality;
  std::uint64_t scored = 0;
  std::uint64_t no_place = 0, no_ring = 0;  ///< Points of all scans.

  ScanLabeller(const pipeline::MethodConfig& config, const calib::RingProfile& profile)
      : image(shape, shape.cells(), memory),
        segmenter(config, profile, shape, image.return_capacity(), memory),
        scan_to_image(profile.mount),
        mount(profile.mount) {}

  /// Labels the scan and the rings that were just read.
  void label(FrameRecord& record) {
    const auto placed = scan_to_image.place(scan.points, rings.ring_of_point, image);
    mount.add_turn(image);
    record.cut = segmenter.segment(image, &clock).cut;
    record.times = clock.take();
    scan_to_image.labels_of_points(segmenter.labels(), point_labels);
    record.returns_in = static_cast<std::uint32_t>(scan.points.size() - placed.no_place);
    record.returns_labelled = static_cast<std::uint32_t>(
        std::count_if(point_labels.begin(), point_labels.end(),
                      [](pipeline::Label label) { return label != pipeline::Label::kNone; }));
    record.losses.overflow_full_returns = placed.overflow_full;
    no_place += placed.no_place;
    no_ring += placed.no_ring;
    if (scan.labels.empty()) return;
    quality += pipeline::measure(point_labels, scan.labels);
    ++scored;
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
Expected<calib::Hdl64eCalibration> calibration_of(const SegmentOptions& options,
                                                  firmware_io::ScanReader& reader) {
  if (!options.calibration.empty()) {
    auto calibration = calib::load_hdl64e_calibration(options.calibration);
    if (calibration) reader.use_rings(firmware_io::ring_table(*calibration));
    return calibration;
  }
  const auto fitted = reader.fit_rings();
  if (!fitted) return tl::unexpected(fitted.error());
  say(fmt::format("calibration: fitted to the scans, height residual {:.1f} cm (p95)",
                  100 * fitted->residual.p95_m));
  if (fitted->told_by_nominal_table) {
    say("             no scan has all rings, so they were told apart by a nominal unit's table; "
        "--calibration takes the unit's own");
  }
  calib::Hdl64eCalibration calibration = firmware_io::hdl64e_calibration(fitted->table);
  calibration.origin = "fitted to the scans";
  return calibration;
}

}  // namespace

ExitCode run(const SegmentOptions& options) {
  catch_stop_signals();
  auto reader = firmware_io::ScanReader::open(options.scans);
  if (!reader) return refuse(reader.error());
  const auto calibration = calibration_of(options, *reader);
  if (!calibration) return refuse(calibration.error());
  const auto profile = ring_profile_of(*calibration, options.mount);
  if (!profile) return refuse(profile.error());
  const std::string calibration_line =
      fmt::format("{}, fingerprint {:016x}", calibration->origin, fingerprint(*calibration));

  ScanLabeller labeller(method_config_of(options.method), *profile);
  FrameOutputs outputs(options.output);
  Report report({"segment", options.scans.string(), "", calibration_line, options.method.profile,
                 options.method.stages, options.method.method});
  Progress progress("labelling", "scans", static_cast<double>(reader->size()));
  for (std::size_t i = 0; i < reader->size(); ++i) {
    if (stop_wanted()) {
      report.set_interrupted(true);
      break;
    }
    const firmware_io::ScanFile& file = reader->file(i);
    const Status read = reader->read(i, labeller.scan, labeller.rings);
    if (!read) return refuse(read.error());
    FrameRecord record;
    record.number = file.frame.value_or(static_cast<std::uint32_t>(i));
    labeller.label(record);
    report.add(record);
    Status written = outputs.write_labels(file.name, labeller.point_labels);
    if (written) {
      written = outputs.write_frame(file.name, labeller.image, labeller.segmenter.labels(),
                                    labeller.truth_of_returns());
    }
    if (!written) return refuse(written.error());
    progress.update(static_cast<double>(i + 1));
  }
  if (labeller.scored > 0) report.set_quality(labeller.quality, report.frames() - labeller.scored);
  report.set_mount(labeller.mount.figures());
  report.set_scan_points(labeller.no_place, labeller.no_ring);
  return conclude_with(report, options.output.json);
}

}  // namespace terracut::cli
