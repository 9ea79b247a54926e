// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <memory>

#include "terracut/calibration.hpp"
#include "terracut/decoder.hpp"
#include "terracut/error.hpp"
#include "terracut/frame.hpp"
#include "terracut/segmenter.hpp"

namespace terracut {

/// Turns packets into labelled frames on the caller's thread. Memory is fixed: push() and next()
/// allocate nothing, lock nothing and throw nothing. next() takes as long as the frame needs
/// (LiveRun keeps deadlines). For one thread.
///
///   pipeline.push(packet);
///   while (const Frame* frame = pipeline.next()) use(frame->points, frame->labels);
class PacketPipeline {
 public:
  struct Config {
    Mount mount;
    Profile profile = Profile::kTerracut;
    int reorder_packets = 2;  ///< See Decoder::Config::reorder_packets.
    bool heights = false;     ///< Frames come with height_above_ground_m.
    bool objects = false;     ///< Frames come with their objects, and with heights.
    bool free_way = false;    ///< Frames come with their free way, and with heights.
  };

  /// Fails with kInvalidArgument for a setting out of range, kCapacityExceeded without memory.
  [[nodiscard]] static Expected<PacketPipeline> make(const Calibration& calibration,
                                                     const Config& config);
  PacketPipeline(PacketPipeline&&) noexcept;
  PacketPipeline& operator=(PacketPipeline&&) noexcept;
  ~PacketPipeline();

  /// Adds a packet; see Decoder.
  void push(const Packet& packet) noexcept;
  void end_stream() noexcept;
  /// Returns the next labelled frame, or null. After each push(), call next() until it returns
  /// null; a frame is valid until the next call.
  [[nodiscard]] const Frame* next() noexcept;

 private:
  struct Engine;
  explicit PacketPipeline(std::unique_ptr<Engine> engine) noexcept;
  std::unique_ptr<Engine> engine_;
};

}  // namespace terracut
