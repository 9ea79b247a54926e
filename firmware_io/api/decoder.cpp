// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/decoder.hpp"

#include <utility>
#include <vector>

#include "calib/api/calibration_table.hpp"
#include "firmware_io/api/points.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut {

struct Decoder::Engine {
  Engine(const Calibration& calibration, const Mount& mount, const decode::Decoder::Config& config)
      : decoder(calibration.table().unit, mount_of(mount), config, memory),
        points(decoder.point_image(memory)),
        room(decoder.return_capacity()) {}

  memory::FixedMemory memory;
  decode::Decoder decoder;
  frame::PointImage points;
  std::vector<Point> room;
  Frame frame;
};

Decoder::Decoder(std::unique_ptr<Engine> engine) noexcept : engine_(std::move(engine)) {}
Decoder::Decoder(Decoder&&) noexcept = default;
Decoder& Decoder::operator=(Decoder&&) noexcept = default;
Decoder::~Decoder() = default;

Expected<Decoder> Decoder::make(const Calibration& calibration, const Mount& mount,
                                const Config& config) {
  decode::Decoder::Config of_engine;
  of_engine.returns_per_cell = 3;  // an HDL-64E S1 at 5 Hz, in the columns of one at 10 Hz
  of_engine.reorder_packets = config.reorder_packets;
  return made([&] { return Decoder(std::make_unique<Engine>(calibration, mount, of_engine)); });
}

void Decoder::push(const Packet& packet) noexcept {
  engine_->decoder.push({.payload = packet.payload, .stamp_ns = packet.stamp_ns});
}

void Decoder::end_stream() noexcept {
  engine_->decoder.end_stream();
}

const Frame* Decoder::next() noexcept {
  const frame::Frame* frame = engine_->decoder.next();
  if (frame == nullptr) return nullptr;
  engine_->frame = public_frame(frame->info, engine_->points.make(*frame->returns), engine_->room);
  return &engine_->frame;
}

std::uint64_t Decoder::packets_decoded() const noexcept {
  return engine_->decoder.packets_decoded();
}

std::uint64_t Decoder::packets_rejected() const noexcept {
  return engine_->decoder.losses().rejected_total();
}

}  // namespace terracut
