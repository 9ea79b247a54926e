// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <array>
#include <functional>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/mount/mount_estimate.hpp"
#include "calib/mount/ring_profile_estimate.hpp"
#include "calib/mount/sensor_setup_file.hpp"
#include "firmware_io/frame/each_return.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/input/open_capture.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

using frame::FrameInfo;
using frame::PlacedReturn;
using frame::RangeImage;

/// Frames the mount is read off: two seconds' worth is plenty and bounds the memory.
constexpr std::uint32_t kMountFrames = 20;

/// Decodes the wanted part of the capture once, from its beginning. `on_frame` answers false when
/// it has seen enough.
Status decode_frames(OpenCapture& capture, const CaptureOptions& options, decode::Decoder& decoder,
                     const std::function<bool(const RangeImage&)>& on_frame) {
  bool more = true;
  std::uint64_t offered = 0;
  const auto hand_out = [&] {
    while (const frame::Frame* frame = decoder.next()) more = more && on_frame(*frame->image);
  };
  if (Status status = capture.source.rewind(); !status) return status;
  CapturePart part(capture.source, options);
  for (const decode::Datagram* datagram; more && (datagram = part.next()) != nullptr; ++offered) {
    decoder.push(*datagram);
    hand_out();
  }
  if (Status status = go_on(); !status) return status;
  decoder.end_stream();
  hand_out();
  if (decoder.frames() > 0) return {};
  return tl::unexpected(nothing_came_out(capture.source, offered, decoder.losses()));
}

/// The mount by the ground itself. A sensor at height 0 without tilt: the decoder's vehicle frame
/// is then the sensor's.
Expected<mount::MountEstimate> estimate(OpenCapture& capture, const Options& options) {
  std::vector<std::array<float, 3>> points;
  std::uint32_t frames = 0;
  const mount::Mount at_the_sensor{.height_m = 0, .roll_rad = 0, .pitch_rad = 0};
  memory::FixedMemory memory;
  decode::Decoder decoder(capture.calibration, at_the_sensor,
                          decoder_config_of(options, capture.sensor.columns, FramesAreFor::kPoints), memory);
  const Status decoded =
      decode_frames(capture, options.capture, decoder, [&](const RangeImage& image) {
        frame::for_each_return(image, [&](const PlacedReturn& placed) {
          if (!ground::is_near_ground_place(placed.point.x_m, placed.point.y_m)) return;
          points.push_back({placed.point.x_m, placed.point.y_m, placed.point.z_m});
        });
        return ++frames < kMountFrames;
      });
  if (!decoded) return tl::unexpected(decoded.error());
  return mount::estimate_mount(points);
}

/// The mean distance of each ring's ground returns, labelled by the method itself.
Expected<mount::RingProfileEstimate> measure_rings(OpenCapture& capture, const Options& options,
                                                   const mount::RingProfile& geometry) {
  memory::FixedMemory memory;
  decode::Decoder decoder(capture.calibration, geometry.mount,
                          decoder_config_of(options, capture.sensor.columns, FramesAreFor::kPoints), memory);
  ground::Segmenter segmenter(method_config_of(options.method).segmenter, geometry, decoder.shape(),
                              decoder.return_capacity(), memory);
  mount::RingProfileEstimate rings(geometry);
  std::vector<mount::RingObservation> observations;
  Progress progress("measuring rings", "frames", 0);
  std::uint32_t frames = 0;
  const Status decoded =
      decode_frames(capture, options.capture, decoder, [&](const RangeImage& image) {
        (void)segmenter.segment(image);
        observations.clear();
        frame::for_each_return(image, [&](const PlacedReturn& placed) {
          const bool is_ground = frame::is_ground(segmenter.labels()[placed.return_index]);
          observations.push_back({placed.row, placed.point.ground_range_m, is_ground});
        });
        rings.add(observations);
        progress.update(++frames);
        return true;
      });
  if (!decoded) return tl::unexpected(decoded.error());
  return rings;
}

/// On level roads, kerbs and cars beside them included, nine returns of ten lie in the plane.
void warn_of_poor_fit(const mount::MountEstimate& estimated) {
  constexpr double kUsualShare = 0.85;
  if (estimated.inlier_share >= kUsualShare) return;
  warn(
      fmt::format("only {:.0f} % of the ground before and behind the vehicle lie in one plane; the "
                  "mount may be wrong: take the capture on a straight, level, open road",
                  100 * estimated.inlier_share));
}

}  // namespace

ExitCode run_calibrate(const Options& options) {
  catch_stop_signals();
  auto capture = open_capture(options.capture);
  if (!capture) return refuse(capture.error());
  auto mount = mount_of(options.mount);
  if (!mount) return refuse(mount.error());
  if (!options.keep_mount) {
    const auto estimated = estimate(*capture, options);
    if (!estimated) return refuse_work(estimated.error());
    mount = estimated->mount;
    warn_of_poor_fit(*estimated);
    fmt::print("mount     from {} returns, {:.0f} % of them within {:.1f} cm (rms) of the plane\n",
               estimated->points_used, 100 * estimated->inlier_share, 100 * estimated->rms_m);
  }
  fmt::print("          height {:.3f} m, roll {:.2f} deg, pitch {:.2f} deg\n", mount->height_m,
             beams::rad_to_deg(mount->roll_rad), beams::rad_to_deg(mount->pitch_rad));

  const mount::RingProfile geometry = calib::ring_profile(capture->calibration, *mount);
  const auto rings = measure_rings(*capture, options, geometry);
  if (!rings) return refuse_work(rings.error());
  fmt::print("rings     {} of {} measured, the others by geometry\n", rings->measured_rings(),
             geometry.rings.size());
  if (rings->measured_rings() == 0) {
    return refuse(
        kNothingCameOut,
        "no ring saw enough ground to be measured, so no setup was written; give a longer "
        "part of the capture, of a level open road");
  }

  warn_of_other_senders(*capture, options.capture);
  mount::SensorSetup setup{*mount, {}};
  for (const mount::Ring& ring : rings->profile().rings) {
    setup.ring_ground_distance_m.push_back(ring.ground_distance_m);
  }
  const ExitCode written = done_or_refused(mount::write_sensor_setup(options.written, setup));
  if (written == kOk) fmt::print("wrote     {}\n", options.written.string());
  return written;
}

}  // namespace terracut::cli
