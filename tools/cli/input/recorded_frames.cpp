// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "recorded_frames.hpp"

#include <memory>

#include "firmware_io/cloud/cloud_to_image.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "pipeline/ground/mount_search.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "pipeline/run/packet_pipeline.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {

namespace {

const decode::Decoder& decoder_of(const decode::Decoder& decoder) {
  return decoder;
}
const decode::Decoder& decoder_of(const run::PacketPipeline& pipeline) {
  return pipeline.decoder();
}

}  // namespace

Status RecordedFrames::look_for_mount(std::size_t most, mount::MountFinder& finder) {
  ground::MountSearch search;
  const Status shown = each_frame(mount::kAtTheSensor, most, [&](const frame::RangeImage& image) {
    search.add_frame(image);
    return Status{};
  });
  finder = search.finder();
  return shown;
}

template <class Frames, class Take>
Status CaptureFrames::pass(Frames& frames, std::size_t most, Take take) {
  Status going;
  std::size_t shown = 0;
  const auto hand_out = [&] {
    while (auto* const frame = frames.next()) {
      if (!going || shown == most) continue;
      going = take(*frame);
      ++shown;
    }
  };
  auto source = open_again(capture_, options_.capture);
  if (!source) return tl::unexpected(source.error());
  CapturePart part(*source, options_.capture);
  std::uint64_t offered = 0;
  while (going && shown < most) {
    const packet::Datagram* datagram = part.next();
    if (datagram == nullptr) break;
    frames.push(*datagram);
    ++offered;
    hand_out();
  }
  counters_ = source->counters();
  fault_ = part.fault();
  if (going) going = go_on();
  if (going && shown < most) {
    frames.end_stream();
    hand_out();
  }
  if (!going) return going;
  if (shown == 0) {
    return tl::unexpected(nothing_came_out(*source, part, offered, decoder_of(frames)));
  }
  return {};
}

Status CaptureFrames::each_frame(const mount::Mount& mount, std::size_t most,
                                 const OnFrame& on_frame) {
  memory::FixedMemory memory;
  decode::Decoder decoder(capture_.calibration, mount,
                          decoder_config_of(options_, capture_.sensor.columns), memory);
  frame::PointImage points = decoder.point_image(memory);
  return pass(decoder, most,
              [&](const frame::Frame& frame) { return on_frame(points.make(*frame.returns)); });
}

Status CaptureFrames::look_for_mount(std::size_t most, mount::MountFinder& finder) {
  const Status looked = look_for_standing_mount(most, finder);
  if (!looked || finder.certain()) return looked;
  return RecordedFrames::look_for_mount(most, finder);
}

Status CaptureFrames::look_for_standing_mount(std::size_t most, mount::MountFinder& finder) {
  memory::FixedMemory memory;
  run::PacketPipeline pipeline(capture_.calibration, ring_profile(mount::kAtTheSensor),
                               decoder_config_of(options_, capture_.sensor.columns),
                               turn_method_of(options_.method), memory,
                               run::PacketPipeline::Makes::kLabels);
  const auto ground = std::make_unique<ground::NearGround>();
  pipeline.watch_near_ground(ground.get());
  return pass(pipeline, most, [&](const run::Frame&) {
    finder.add_frame(ground->in_use());
    return Status{};
  });
}

mount::RingProfile CaptureFrames::ring_profile(const mount::Mount& mount) const {
  return calib::ring_profile(capture_.calibration, mount);
}

Status CloudFrames::each_frame(const mount::Mount& mount, std::size_t most,
                               const OnFrame& on_frame) {
  memory::FixedMemory memory;
  cloud::CloudToImage to_image(rows_, mount, memory);
  const std::size_t step = (clouds_.size() + most - 1) / most;
  std::size_t shown = 0;
  Status last_fault;
  for (std::size_t i = 0; i < clouds_.size(); i += step) {
    if (Status going = go_on(); !going) return going;
    const auto cloud = clouds_.read(i);
    if (!cloud) {
      last_fault = tl::unexpected(cloud.error());
      continue;
    }
    if (Status placed = to_image.place(*cloud); !placed) {
      placed.error().message = clouds_.place(i) + ": " + placed.error().message;
      last_fault = placed;
      continue;
    }
    ++shown;
    if (!cloud::has_places(cloud->points)) continue;
    if (Status going = on_frame(to_image.image()); !going) return going;
  }
  return shown > 0 ? Status{} : last_fault;
}

mount::RingProfile CloudFrames::ring_profile(const mount::Mount& mount) const {
  return scan::ring_profile(rows_.rings.table, mount);
}

}  // namespace terracut::cli
