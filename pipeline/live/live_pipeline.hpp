// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/frame/frame_points.hpp"
#include "pipeline/ground/coarse_stages.hpp"
#include "pipeline/ground/fine_stages.hpp"
#include "pipeline/live/frame_exchange.hpp"

namespace terracut::live {

/// Returns an object that computes points for one thread if frames keep their returns as measured,
/// else null. Takes memory.
[[nodiscard]] inline std::unique_ptr<frame::FramePoints> points_made_of(
    const decode::Decoder& decoder, memory::FixedMemory& memory) {
  auto reader = decoder.make_reader(memory);
  if (reader == nullptr) return nullptr;
  return std::make_unique<frame::FramePoints>(decoder.shape(), std::move(reader), memory);
}

/// The objects with which two threads turn packets into labels. The receiving thread decodes and
/// does the coarse stages, mostly before the frame has ended; their result stays with the frame's
/// image. If the coarse stages were behind when a frame ended, the segmenting thread does them.
struct LivePipeline {
  decode::Decoder decoder;  ///< Used by the receiving thread, as is `coarse`.
  /// Points for each of the two threads if frames keep returns as measured; else null.
  std::unique_ptr<frame::FramePoints> receiving_points, segmenting_points;
  ground::CoarseStages coarse;
  ground::CoarseStages late_coarse;  ///< Used by the segmenting thread, as is `fine`.
  ground::FineStages fine;

  LivePipeline(const calib::SensorCalibration& calibration, const mount::RingProfile& profile,
               const decode::Decoder::Config& decoder_config, const ground::SegmenterConfig& config,
               memory::FixedMemory& memory)
      : decoder(calibration, profile.mount, live(decoder_config), memory),
        receiving_points(points_made_of(decoder, memory)),
        segmenting_points(points_made_of(decoder, memory)),
        coarse(config, profile, decoder.shape(), memory, receiving_points.get()),
        late_coarse(config, profile, decoder.shape(), memory, segmenting_points.get()),
        fine(config, profile, decoder.shape(), decoder.return_capacity(), memory,
             segmenting_points.get()) {
    planes_.reserve(decoder.images().size());
    for (std::size_t i = 0; i < decoder.images().size(); ++i) {
      planes_.emplace_back(decoder.shape(), memory);
    }
  }

  /// Returns the planes that belong to one of the decoder's images. The thread that holds the image
  /// also holds these planes.
  [[nodiscard]] stage::CellPlanes& planes_of(const frame::RangeImage& image) noexcept
      TERRACUT_NONBLOCKING {
    return planes_[static_cast<std::size_t>(&image - first_image_)];
  }

 private:
  [[nodiscard]] static decode::Decoder::Config live(decode::Decoder::Config config) {
    config.images = FrameExchange::kImages;
    return config;
  }

  const frame::RangeImage* first_image_ = decoder.images().data();
  std::vector<stage::CellPlanes> planes_;
};

}  // namespace terracut::live
