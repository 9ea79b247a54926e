// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <optional>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/mount/mount_finder.hpp"
#include "calib/mount/ring_profile_estimate.hpp"
#include "calib/mount/sensor_setup_file.hpp"
#include "firmware_io/frame/each_return.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/input/cloud_input.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/input/open_capture.hpp"
#include "tools/cli/input/recorded_frames.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

/// The most frames used to find the mount, and to measure the rings.
constexpr std::size_t kMountFrames = 100, kRingFrames = 100'000;

/// Measures the mean distance of each ring's ground returns, using the method's own labels.
Expected<mount::RingProfileEstimate> measure_rings(RecordedFrames& frames, const Options& options,
                                                   const mount::RingProfile& geometry) {
  memory::FixedMemory memory;
  std::optional<ground::Segmenter> segmenter;
  mount::RingProfileEstimate rings(geometry);
  std::vector<mount::RingObservation> observations;
  Progress progress("measuring rings", "frames", 0);
  std::uint32_t measured = 0;
  const Status shown =
      frames.each_frame(geometry.mount, kRingFrames, [&](const frame::RangeImage& image) {
        if (!segmenter) {
          segmenter.emplace(method_config_of(options.method).segmenter, geometry, image.shape(),
                            image.return_capacity(), memory);
        }
        (void)segmenter->segment(image);
        observations.clear();
        frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
          const bool is_ground = frame::is_ground(segmenter->labels()[placed.return_index]);
          observations.push_back({placed.row, placed.point.ground_range_m, is_ground});
        });
        rings.add(observations);
        progress.update(++measured);
        return Status{};
      });
  if (!shown) return tl::unexpected(shown.error());
  return rings;
}

/// Returns the mount that the frames show, except for figures that the user stated. With
/// --keep-mount, returns the stated mount.
Expected<mount::Mount> measured_mount(RecordedFrames& frames, const Options& options) {
  MountOptions stated = options.mount;
  if (!options.keep_mount) {
    stated.setup.clear();  // measured anew, so not read from the setup's file
    mount::MountFinder finder;
    if (const Status shown = frames.look_for_mount(kMountFrames, finder); !shown) {
      return tl::unexpected(shown.error());
    }
    const auto found = finder.found();
    const auto choice = found.and_then([&](const mount::FoundMount& seen) -> Expected<MountChoice> {
      MountChoice filled = filled_in(stated, seen);
      if (!filled.found->is_certain()) return tl::unexpected(mount::uncertain(*filled.found));
      return filled;
    });
    if (!choice) {
      return fail(choice.error().code,
                  fmt::format("the mount is not found: {}; record on level, open ground, or give "
                              "the mount and --keep-mount",
                              choice.error().message));
    }
    print_out("mount     {}\n", to_string(*choice->found));
    stated = choice->options;
  }
  const auto mount = mount_of(stated);
  if (mount && options.keep_mount) {
    print_out("mount     height {:.3f} m, roll {:.2f} deg, pitch {:.2f} deg, as stated\n",
              mount->height_m, beams::rad_to_deg(mount->roll_rad),
              beams::rad_to_deg(mount->pitch_rad));
  }
  return mount;
}

ExitCode calibrate(RecordedFrames& frames, const Options& options) {
  const auto mount = measured_mount(frames, options);
  if (!mount) return refuse_work(mount.error());
  const mount::RingProfile geometry = frames.ring_profile(*mount);
  const auto rings = measure_rings(frames, options, geometry);
  if (!rings) return refuse_work(rings.error());
  print_out("rings     {} of {} measured, the others by geometry\n", rings->measured_rings(),
            geometry.rings.size());
  if (rings->measured_rings() == 0) {
    return refuse(
        kNothingCameOut,
        "no ring saw enough ground to be measured, so no setup was written; give a longer "
        "part of the recording, of a level open road");
  }
  mount::SensorSetup setup{*mount, {}};
  for (const mount::Ring& ring : rings->profile().rings) {
    setup.ring_ground_distance_m.push_back(ring.ground_distance_m);
  }
  const ExitCode written = done_or_refused(mount::write_sensor_setup(options.written, setup));
  if (written == kOk) print_out("wrote     {}\n", options.written.string());
  return written;
}

ExitCode calibrate_clouds(const Options& options) {
  if (options.capture.start_s > 0 || options.capture.duration_s) {
    return refuse(kUsage, "--start and --duration are of captures; name the clouds to be used");
  }
  auto clouds = CloudReader::open(options.capture.file, options.capture.topic);
  if (!clouds) return refuse(clouds.error());
  const auto rows = rows_of(*clouds, options.capture.calibration);
  if (!rows) return refuse(rows.error());
  CloudFrames frames(*clouds, *rows);
  return calibrate(frames, options);
}

}  // namespace

ExitCode run_calibrate(const Options& options) {
  catch_stop_signals();
  const auto is_clouds = holds_clouds(options.capture);
  if (!is_clouds) return refuse(is_clouds.error());
  if (*is_clouds) return calibrate_clouds(options);
  auto capture = open_capture(options.capture);
  if (!capture) return refuse(capture.error());
  say_what_is_read(*capture);
  CaptureFrames frames(*capture, options);
  const ExitCode done = calibrate(frames, options);
  if (!frames.fault().empty()) warn(frames.fault());
  if (done == kOk) warn_of_other_senders(*capture, frames.counters(), options.capture);
  return done;
}

}  // namespace terracut::cli
