// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "changed_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "calib/mount/mount.hpp"
#include "firmware_io/cloud/cloud_file.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "firmware_io/scan/scan_folder.hpp"
#include "pipeline/pictures/bird_eye_picture.hpp"
#include "pipeline/pictures/caption.hpp"
#include "rt/files/plain_file.hpp"
#include "tools/cli/arguments/arguments.hpp"
#include "tools/cli/files/frame_folder_of.hpp"
#include "tools/cli/fleet/manifest.hpp"
#include "tools/cli/fleet/relabel_job.hpp"
#include "tools/cli/input/open_capture.hpp"
#include "tools/cli/input/recorded_motion.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/settings/setup_choice.hpp"

namespace terracut::cli {
namespace {

namespace fs = std::filesystem;
using pictures::Colour;

constexpr Colour kToObstacleColour{255, 86, 70}, kToGroundColour{70, 205, 255},
    kOtherChangeColour{255, 221, 0}, kGroundBefore{66, 60, 48}, kObstacleBefore{84, 92, 112};

using Visit = std::function<Status(const FrameChange&, const frame::RangeImage&)>;
/// The wanted frames of one drive, by name.
using Wanted = std::map<std::string, const FrameChange*>;

/// Visits the frames of a capture until all wanted ones have come.
Status visit_capture(const Options& options, Wanted wanted, const Visit& visit) {
  auto capture = open_capture(options.capture);
  if (!capture) return tl::unexpected(capture.error());
  const auto mount = mount_of(options.mount);
  if (!mount) return tl::unexpected(mount.error());
  memory::FixedMemory memory;
  std::optional<RecordedMotion> motion;
  if (!options.can_recording.empty()) {
    auto opened = RecordedMotion::open(options, memory);
    if (!opened) return tl::unexpected(opened.error());
    motion.emplace(*std::move(opened));
  }
  decode::Decoder decoder(
      capture->calibration, *mount,
      decoder_config_of(options, capture->sensor.columns, motion ? &motion->motion() : nullptr),
      memory);
  frame::PointImage points = decoder.point_image(memory);
  const auto take_frames = [&]() -> Status {
    while (const frame::Frame* const frame = decoder.next()) {
      const auto its = wanted.find(fmt::format("{:06}", frame->info.number));
      if (its == wanted.end()) continue;
      const frame::RangeImage& image = points.make(*frame->returns, frame->motions);
      if (Status visited = visit(*its->second, image); !visited) return visited;
      wanted.erase(its);
    }
    return {};
  };
  CapturePart part(capture->source, options.capture);
  Status taken;
  while (const packet::Datagram* const datagram = wanted.empty() ? nullptr : part.next()) {
    if (motion) motion->hear_until(datagram->stamp_ns);
    decoder.push(*datagram);
    if (taken = take_frames(); !taken) return taken;
  }
  part.warn_of_oddities();
  decoder.end_stream();
  return take_frames();
}

/// Visits clouds as images of one row with one cell a point, so that the n-th return is the n-th
/// point. Such images can only be drawn from above.
Status visit_clouds(const Options& options, const Wanted& wanted, const Visit& visit) {
  const auto folder = scan::list_scan_folder(options.scans, cloud::kCloudFiles);
  if (!folder) return tl::unexpected(folder.error());
  const auto mount = mount_of(options.mount);
  if (!mount) return tl::unexpected(mount.error());
  const auto T = mount::T_vehicle_lidar(*mount);
  cloud::Cloud cloud;
  for (const scan::ScanFile& file : folder->scans) {
    const auto its = wanted.find(file.name);
    if (its == wanted.end()) continue;
    if (Status read = cloud::read_cloud(file.points, cloud); !read) return read;
    memory::FixedMemory memory;
    const auto points = static_cast<std::uint32_t>(cloud.points.size());
    frame::RangeImage image({.rows = 1, .columns = static_cast<int>(points)}, 0, memory);
    for (std::uint32_t i = 0; i < points; ++i) {
      const scan::ScanPoint& point = cloud.points[i];
      const auto at = mount::apply(T, point.x_m, point.y_m, point.z_m);
      const bool is_place = scan::is_place(point);
      image.place(0, static_cast<int>(i),
                  {.x_m = static_cast<float>(at[0]),
                   .y_m = static_cast<float>(at[1]),
                   .z_m = is_place ? static_cast<float>(at[2]) : frame::kNoHeight_m});
    }
    if (Status visited = visit(*its->second, image); !visited) return visited;
  }
  return {};
}

/// Returns a picture of the changes.
Expected<pictures::Picture> picture_of(const FrameChange& change, const frame::RangeImage& image,
                                       const fs::path& before, const fs::path& after) {
  std::vector<std::uint32_t> ids_before, ids_after;
  const std::string name = change.frame + ".label";
  Status read = scan::read_label_file(before / name, image.returns(), ids_before);
  if (read) read = scan::read_label_file(after / name, image.returns(), ids_after);
  if (!read) return tl::unexpected(read.error());
  std::vector<Colour> colours;
  std::vector<std::uint8_t> levels;
  for (std::size_t i = 0; i < ids_before.size(); ++i) {
    const LabelChange what = change_between(ids_before[i], ids_after[i]);
    levels.push_back(what == LabelChange::kNone ? 0 : 1);
    switch (what) {
      case LabelChange::kToObstacle:
        colours.push_back(kToObstacleColour);
        break;
      case LabelChange::kToGround:
        colours.push_back(kToGroundColour);
        break;
      case LabelChange::kOther:
        colours.push_back(kOtherChangeColour);
        break;
      case LabelChange::kNone:
        colours.push_back(is_obstacle_id(ids_before[i]) ? kObstacleBefore : kGroundBefore);
        break;
    }
  }
  const std::vector<pictures::LegendEntry> legend{{"now obstacle", {kToObstacleColour}},
                                                  {"now ground", {kToGroundColour}},
                                                  {"changed else", {kOtherChangeColour}},
                                                  {"obstacle as before", {kObstacleBefore}},
                                                  {"ground as before", {kGroundBefore}}};
  const std::string title =
      fmt::format("{} frame {} from above, forward is up: {} of {} returns changed", change.drive,
                  change.frame, change.changes.changed(), change.changes.returns);
  return with_caption(bird_eye_picture(pictures::ColouredFrame{image, colours, levels}), title,
                      legend);
}

/// Returns the options of the run that labelled a drive.
Expected<Options> options_of(const Labelling& labelling, const FleetDrive& drive) {
  const fs::path settings = labelling.state / kJobSettings;
  if (const auto file = files::open_plain_file(settings); !file) {
    return tl::unexpected(file.error());
  }
  const auto words = words_for(drive, settings);
  if (!words) return tl::unexpected(words.error());
  auto arguments = parse_arguments(*words);
  if (!arguments) return tl::unexpected(arguments.error());
  return std::move(arguments->options);
}

}  // namespace

Status draw_changes(const Labelling& before, const Labelling& after,
                    std::span<const FrameChange> frames, const OutputOptions& output) {
  if (after.state.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "--png: only of a folder of `terracut relabel` it is known where the recordings "
                "are that pictures are drawn from");
  }
  const auto job = read_job(after.state);
  if (!job) return tl::unexpected(job.error());
  const auto manifest = read_manifest(job->manifest);
  if (!manifest) return tl::unexpected(manifest.error());
  output::FrameFolder place = frame_folder_of(output, output.png, ".png");
  for (const FleetDrive& drive : manifest->drives) {
    Wanted wanted;
    for (const FrameChange& frame : frames) {
      if (frame.drive == drive.name) wanted[frame.frame] = &frame;
    }
    if (wanted.empty()) continue;
    const auto options = options_of(after, drive);
    if (!options) return tl::unexpected(options.error());
    std::string name = drive.name;
    std::ranges::replace(name, '/', '_');
    const Visit draw = [&](const FrameChange& frame, const frame::RangeImage& image) -> Status {
      const auto picture =
          picture_of(frame, image, before.drives.at(drive.name), after.drives.at(drive.name));
      if (!picture) return tl::unexpected(picture.error());
      return place.place(fmt::format("{}.{}.changes.png", name, frame.frame))
          .and_then([&](const fs::path& path) { return picture->write_png(path); });
    };
    const Status drawn = drive.capture.empty() ? visit_clouds(*options, wanted, draw)
                                               : visit_capture(*options, wanted, draw);
    if (!drawn) return drawn;
  }
  return {};
}

}  // namespace terracut::cli
