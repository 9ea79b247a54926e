// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "firmware_io/cloud/sensor_rows.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "pipeline/run/stage_clock.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/figures/mount_watch.hpp"
#include "tools/cli/figures/report.hpp"
#include "tools/cli/input/cloud_input.hpp"
#include "tools/cli/input/frame_outputs.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/input/recorded_frames.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

/// Labels one cloud after the other; everything that is kept between them.
struct CloudLabeller {
  memory::FixedMemory memory;
  cloud::RowFinder finder;
  frame::RangeImage image;
  ground::GroundMethod segmenter;
  scan::ScanToImage scan_to_image;
  scan::RingRecovery rings;
  std::vector<std::uint32_t> truth;
  run::StageClock clock;
  std::vector<frame::Label> point_labels;
  std::vector<std::uint32_t> return_truth;
  MountWatch mount;
  Report::ScanPoints points;  ///< Of all scans.

  CloudLabeller(const ground::MethodConfig& config, const cloud::SensorRows& rows,
                const mount::RingProfile& profile, const MountChoice& choice)
      : finder(rows),
        image(rows.shape(), rows.shape().cells(), memory),
        segmenter(config, profile, rows.shape(), image.return_capacity(), memory),
        scan_to_image(profile.mount),
        mount(profile.mount, choice) {}

  Status label(const cloud::CloudView& cloud, status::FrameRecord& record) {
    if (Status found = finder.find(cloud, rings); !found) return found;
    const auto placed = scan_to_image.place(cloud.points, rings.ring_of_point, image);
    mount.add_frame(image);
    record.segmentation = segmenter.segment(image, &clock);
    record.stages = clock.take();
    scan_to_image.labels_of_points(segmenter.labels(), point_labels);
    record.segmentation.count(point_labels);
    // Points that are no return have kNone, which is counted as neither.
    const auto no_place = static_cast<std::uint32_t>(placed.no_place);
    record.segmentation.returns -= no_place;
    record.segmentation.obstacles -= no_place;
    record.info.returns = static_cast<std::uint32_t>(cloud.points.size() - placed.no_place);
    record.info.losses.overflow_full_returns = placed.overflow_full;
    points.no_place += placed.no_place;
    points.no_ring += placed.no_ring;
    return {};
  }

  /// The cloud's truth in the order of the image's returns; empty without labels.
  std::span<const std::uint32_t> truth_of_returns() {
    return_truth.clear();
    if (truth.empty()) return return_truth;
    for (const std::uint32_t point : scan_to_image.point_of_return()) {
      return_truth.push_back(truth[point]);
    }
    return return_truth;
  }
};

}  // namespace

ExitCode run_segment(const Options& options) {
  catch_stop_signals();
  auto opened = CloudReader::open(options.scans);
  if (!opened) return refuse(opened.error());
  CloudReader& reader = *opened;
  const auto rows = rows_of(reader, options.capture.calibration);
  if (!rows) return refuse(rows.error());
  CloudFrames frames(reader, *rows);
  const auto mount = choose_mount(options.mount, frames);
  if (!mount) return refuse_work(mount.error());
  const auto profile = ring_profile_of(rows->rings.table, mount->options);
  if (!profile) return refuse(profile.error());
  const std::string sensor_line = fmt::format(
      "{} rows by {}", rows->rings.table.size(),
      options.capture.calibration.empty() ? description_of(rows->source) : "the calibration given");

  CloudLabeller labeller(method_config_of(options.method), *rows, *profile, *mount);
  FrameOutputs outputs(options.output);
  const Status outputs_open = outputs.open(
      {.sensor = sensor_line, .rows = labeller.image.shape().rows, .mount = profile->mount});
  if (!outputs_open) return refuse(outputs_open.error());
  Report report{"segment", options.scans.string(), "", sensor_line, options.method};
  Progress progress("labelling", "scans", static_cast<double>(reader.size()));
  for (std::size_t i = 0; i < reader.size(); ++i) {
    if (stop_wanted()) {
      report.interrupted = true;
      break;
    }
    const scan::ScanFile& file = reader.file(i);
    const auto cloud = reader.read(i);
    if (!cloud) return refuse(cloud.error());
    if (const Status read = reader.read_labels(i, cloud->points.size(), labeller.truth); !read) {
      return refuse(read.error());
    }
    status::FrameRecord record;
    record.info.complete = true;
    record.info.number = file.frame.value_or(static_cast<std::uint32_t>(i));
    Status labelled = labeller.label(*cloud, record);
    if (!labelled) {
      labelled.error().message = file.points.string() + ": " + labelled.error().message;
      return refuse(labelled.error());
    }
    report.add(record);
    if (!labeller.truth.empty()) report.score(labeller.point_labels, labeller.truth);
    Status written = outputs.write_labels(file.name, labeller.point_labels);
    if (written) {
      written = outputs.write_frame(file.name, labeller.image, labeller.segmenter.labels(),
                                    labeller.truth_of_returns());
    }
    if (written) {
      written = outputs.publish(record, labeller.image, labeller.segmenter.labels());
    }
    if (written) {
      written = outputs.write_returns(
          {record.info.number, 0, labeller.image, labeller.segmenter.planes().height_m,
           labeller.segmenter.labels(), labeller.scan_to_image.point_of_return()});
    }
    if (!written) return refuse(written.error());
    progress.update(static_cast<double>(i + 1));
  }
  if (const Status finished = outputs.finish(); !finished) return refuse(finished.error());
  report.mount = labeller.mount.figures();
  report.scan_points = labeller.points;
  return conclude_with(report, options.output.json);
}

}  // namespace terracut::cli
