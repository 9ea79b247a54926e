// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/frame/frame_points.hpp"
#include "pipeline/ground/coarse_stages.hpp"
#include "pipeline/ground/fine_stages.hpp"
#include "pipeline/live/frame_exchange.hpp"

namespace terracut::live {

/// The objects with which two threads turn packets into labels. The receiving thread decodes and
/// does the coarse stages, mostly before the frame has ended; their result stays with the frame's
/// buffer. If the coarse stages were behind when a frame ended, the segmenting thread does them.
struct LivePipeline {
  decode::Decoder decoder;  ///< Used by the receiving thread, as is `coarse`.
  frame::FramePoints receiving_points, segmenting_points;  ///< One for each of the two threads.
  ground::CoarseStages coarse;
  ground::CoarseStages late_coarse;  ///< Used by the segmenting thread, as is `fine`.
  ground::FineStages fine;

  LivePipeline(const calib::SensorCalibration& calibration, const mount::RingProfile& profile,
               const decode::Decoder::Config& decoder_config, const ground::SegmenterConfig& config,
               memory::FixedMemory& memory)
      : decoder(calibration, profile.mount, live(decoder_config), memory),
        receiving_points(decoder.shape(), decoder.make_reader(memory), memory),
        segmenting_points(decoder.shape(), decoder.make_reader(memory), memory),
        coarse(config, profile, decoder.shape(), memory, &receiving_points),
        late_coarse(config, profile, decoder.shape(), memory, &segmenting_points),
        fine(config, profile, decoder.shape(), decoder.return_capacity(), memory,
             &segmenting_points) {
    planes_.reserve(decoder.buffers().size());
    for (std::size_t i = 0; i < decoder.buffers().size(); ++i) {
      planes_.emplace_back(decoder.shape(), memory);
    }
  }

  /// Returns the planes that belong to one of the decoder's buffers. The thread that holds the
  /// buffer also holds these planes.
  [[nodiscard]] stage::CellPlanes& planes_of(const frame::MeasuredReturns& returns) noexcept
      TERRACUT_NONBLOCKING {
    return planes_[static_cast<std::size_t>(&returns - first_buffer_)];
  }

 private:
  [[nodiscard]] static decode::Decoder::Config live(decode::Decoder::Config config) {
    config.buffers = FrameExchange::kBuffers;
    return config;
  }

  const frame::MeasuredReturns* first_buffer_ = decoder.buffers().data();
  std::vector<stage::CellPlanes> planes_;
};

}  // namespace terracut::live
