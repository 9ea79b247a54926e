// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

#include "firmware_io/cloud/row_doubt.hpp"
#include "firmware_io/cloud/sensor_rows.hpp"
#include "pipeline/run/cloud_pipeline.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/figures/run_report.hpp"
#include "tools/cli/input/cloud_input.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/input/mount_watch.hpp"
#include "tools/cli/input/recorded_frames.hpp"
#include "tools/cli/output/frame_outputs.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

/// Collects the files of a folder that could not be used: reports each at once, and all again at
/// the end.
class UnusedFiles {
 public:
  void add(const Error& fault) {
    warn(fault.message);
    if (count_++ == 0) first_ = fault.message;
  }
  [[nodiscard]] bool any() const { return count_ > 0; }
  [[nodiscard]] std::string text(std::size_t clouds) const {
    return fmt::format("{} of {} clouds, or their truth, could not be used: {}{}", count_, clouds,
                       first_, count_ > 1 ? ", and others" : "");
  }

 private:
  std::size_t count_ = 0;
  std::string first_;
};

/// Warns if the mount found is higher than 4.5 m, where few sensors are: clouds in feet show 4.6
/// for a car's 1.4 m.
std::string doubt_of_height(const MountOptions& stated, const MountChoice& mount) {
  constexpr double kRarelyHigher_m = 4.5;
  if (stated.height_m || !mount.found || mount.found->mount.height_m < kRarelyHigher_m) return {};
  return fmt::format("the sensor stands {:.1f} m above the ground: are the points feet?",
                     mount.found->mount.height_m);
}

}  // namespace

ExitCode run_segment(const Options& options) {
  catch_stop_signals();
  auto opened = CloudReader::open(options.scans, options.capture.topic);
  if (!opened) return refuse(opened.error());
  CloudReader& reader = *opened;
  const auto rows = rows_of(reader, options.capture.calibration);
  if (!rows) return refuse(rows.error());
  CloudFrames frames(reader, *rows);
  const MountOptions stated = reader.stated(options.mount);
  const auto mount = choose_mount(stated, frames);
  if (!mount) return refuse_work(mount.error());
  const auto profile = ring_profile_of(rows->rings.table, mount->options);
  if (!profile) return refuse(profile.error());
  const std::string high = doubt_of_height(stated, *mount);
  if (!high.empty()) warn(options.scans.string() + ": " + high);
  const std::string sensor_line = fmt::format(
      "{} rows by {}", rows->rings.table.size(),
      options.capture.calibration.empty() ? description_of(rows->source) : "the calibration given");

  run::CloudPipeline pipeline(*rows, *profile, method_of(options.method));
  MountWatch watch(profile->mount, *mount);
  Report::ScanPoints points;  // over all scans
  std::vector<std::uint32_t> truth;
  FrameOutputs outputs(options.output);
  if (options.method.scene.any()) {
    outputs.find_scene(options.method.scene, *profile, pipeline.image().shape(),
                       pipeline.image().return_capacity());
  }
  const Status outputs_open =
      outputs.open({.sensor = sensor_line,
                    .rows = pipeline.image().shape().rows,
                    .mount = profile->mount,
                    .has_road = method_config_of(options.method).segmenter.road.enabled,
                    .found = options.method.scene});
  if (!outputs_open) return refuse(outputs_open.error());
  Report report{"segment", options.scans.string(), "", sensor_line, options.method};
  if (!options.output.json.empty()) report.entries.emplace(options.output.json);
  report.sensor_warning = cloud::doubt_of(*rows);
  if (report.sensor_warning.empty()) report.sensor_warning = high;
  UnusedFiles unused;
  Progress progress("labelling", "scans", static_cast<double>(reader.size()));
  for (std::size_t i = 0; i < reader.size(); ++i) {
    if (stop_wanted()) {
      report.interrupted = true;
      break;
    }
    const auto cloud = reader.read(i);
    if (!cloud) {
      unused.add(cloud.error());
      continue;
    }
    if (const Status read = reader.read_labels(i, cloud->points.size(), truth); !read) {
      unused.add(read.error());
      truth.clear();
    }
    status::FrameRecord record;
    record.info.complete = true;
    record.info.number = reader.number(i);
    Status labelled = pipeline.label(*cloud, record);
    if (!labelled) {
      labelled.error().message.insert(0, reader.place(i) + ": ");
      unused.add(labelled.error());
      continue;
    }
    watch.add_frame(pipeline.image());
    points.no_place += pipeline.placed().no_place;
    points.no_ring += pipeline.placed().no_ring;
    report.add(record);
    if (!truth.empty()) report.score(pipeline.point_labels(), truth);
    outputs.look(pipeline.image(), pipeline.image(), pipeline.labels(), pipeline.heights_m());
    Status written = outputs.write_labels(reader.name(i), pipeline.point_labels(),
                                          pipeline.numbers_of_points(outputs.object_of_return()));
    if (written) {
      written = outputs.write_frame(reader.name(i), pipeline.image(), pipeline.labels(),
                                    pipeline.heights_m(), pipeline.truth_of_returns(truth));
    }
    if (written) {
      // Makes up stamps, which files do not have: players of recordings expect increasing stamps.
      constexpr std::int64_t kFramePeriod_ns = 100'000'000;
      record.info.first_packet_ns =
          reader.stamp_ns().value_or(record.info.number * kFramePeriod_ns);
      record.info.last_packet_ns = record.info.first_packet_ns;
      written = outputs.publish(record, pipeline.image(), pipeline.labels(), pipeline.heights_m());
    }
    if (!written) return refuse(written.error());
    progress.update(static_cast<double>(i + 1));
  }
  if (const Status finished = outputs.finish(); !finished) return refuse(finished.error());
  report.mount = watch.figures();
  report.scan_points = points;
  if (unused.any()) report.input_warning = unused.text(reader.size());
  const ExitCode concluded = conclude_with(report, options.output.json);
  return concluded == kOk && unused.any() ? refuse(kInputRefused, report.input_warning) : concluded;
}

}  // namespace terracut::cli
