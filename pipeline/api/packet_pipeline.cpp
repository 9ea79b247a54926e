// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/packet_pipeline.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "calib/api/calibration_table.hpp"
#include "firmware_io/api/points.hpp"
#include "pipeline/api/profile.hpp"
#include "pipeline/api/wanted.hpp"
#include "pipeline/ground/stream_segmenter.hpp"
#include "pipeline/run/packet_pipeline.hpp"
#include "pipeline/scene/scene_finder.hpp"

namespace terracut {

namespace {

ground::SegmenterConfig method_of(const PacketPipeline::Config& config) noexcept {
  ground::SegmenterConfig method = config_of(config.profile);
  method.gives_heights = wants_heights(config);
  return method;
}

}  // namespace

struct PacketPipeline::Engine {
  Engine(const Calibration& calibration, const Config& config,
         const decode::Decoder::Config& decoder)
      : pipeline(calibration.table().unit,
                 calib::ring_profile(calibration.table().unit, mount_of(config.mount)), decoder,
                 ground::turn_maker_of(method_of(config)), memory,
                 run::PacketPipeline::Makes::kPoints),
        room(pipeline.decoder().return_capacity()) {
    if (const scene::Wanted wanted = wanted_of(config); wanted.any()) {
      const decode::Decoder& frames = pipeline.decoder();
      scene.emplace(wanted, calib::ring_profile(calibration.table().unit, mount_of(config.mount)),
                    frames.shape(), frames.return_capacity(), memory);
    }
  }

  memory::FixedMemory memory;
  run::PacketPipeline pipeline;
  std::optional<scene::SceneFinder> scene;  ///< Exists if anything is to be found.
  std::vector<Point> room;
  Frame frame;
};

PacketPipeline::PacketPipeline(std::unique_ptr<Engine> engine) noexcept
    : engine_(std::move(engine)) {}
PacketPipeline::PacketPipeline(PacketPipeline&&) noexcept = default;
PacketPipeline& PacketPipeline::operator=(PacketPipeline&&) noexcept = default;
PacketPipeline::~PacketPipeline() = default;

Expected<PacketPipeline> PacketPipeline::make(const Calibration& calibration,
                                              const Config& config) {
  decode::Decoder::Config decoder;
  decoder.returns_per_cell = 3;  // an HDL-64E S1 at 5 Hz, in the columns of one at 10 Hz
  decoder.reorder_packets = config.reorder_packets;
  return made(
      [&] { return PacketPipeline(std::make_unique<Engine>(calibration, config, decoder)); });
}

void PacketPipeline::push(const Packet& packet) noexcept {
  engine_->pipeline.push({.payload = packet.payload, .stamp_ns = packet.stamp_ns});
}

void PacketPipeline::end_stream() noexcept {
  engine_->pipeline.end_stream();
}

const Frame* PacketPipeline::next() noexcept {
  run::Frame* frame = engine_->pipeline.next();
  if (frame == nullptr) return nullptr;
  engine_->frame = public_frame(frame->record.info, *frame->image, engine_->room);
  engine_->frame.labels = engine_->pipeline.labels();
  engine_->frame.height_above_ground_m = engine_->pipeline.heights_m();
  if (engine_->scene) {
    engine_->scene->find(*frame->image, engine_->pipeline.labels(), engine_->pipeline.heights_m());
    engine_->frame.objects = engine_->scene->objects();
    engine_->frame.object_of_return = engine_->scene->object_of_return();
    engine_->frame.free_way = engine_->scene->free_way();
  }
  return &engine_->frame;
}

}  // namespace terracut
