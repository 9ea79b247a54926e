// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <vector>

#include "frame_exchange.hpp"
#include "pipeline/coarse_stages.hpp"
#include "pipeline/fine_stages.hpp"
#include "tools/cli/packet_chain.hpp"

namespace terracut::cli {

/// The way from packets to labels on two threads. The receiving one does the coarse stages as
/// well, most of them before the turn has ended; what they make of a turn goes with its image. Of a
/// turn that ended before they were far enough, the segmenting one does them.
struct LiveChain {
  firmware_io::SensorDecoder decoder;  ///< Receiving thread, as coarse.
  pipeline::CoarseStages coarse;
  pipeline::CoarseStages late_coarse;  ///< Segmenting thread, as fine.
  pipeline::FineStages fine;

  LiveChain(const calib::SensorCalibration& calibration, const calib::RingProfile& profile,
            int columns, const CaptureOptions& capture, const MethodOptions& method,
            const Deskewing& deskewing, rt::FixedMemory& memory)
      : decoder(calibration, profile.mount, decoder_config(columns, capture, deskewing), memory),
        coarse(segmenter_config_of(method), profile, decoder.shape(), memory),
        late_coarse(segmenter_config_of(method), profile, decoder.shape(), memory),
        fine(segmenter_config_of(method), profile, decoder.shape(), decoder.return_capacity(),
             memory) {
    planes_.reserve(decoder.images().size());
    for (std::size_t i = 0; i < decoder.images().size(); ++i) {
      planes_.emplace_back(decoder.shape(), memory);
    }
  }

  /// Of one of the decoder's images; whoever has the image has them.
  [[nodiscard]] pipeline::CellPlanes& planes_of(const pipeline::RangeImage& image) noexcept
      TERRACUT_NONBLOCKING {
    return planes_[static_cast<std::size_t>(&image - first_image_)];
  }

 private:
  /// Packets of a sensor that is connected by one cable do not come late, so none is waited for
  /// unless that is asked for.
  [[nodiscard]] static firmware_io::SensorDecoder::Config decoder_config(
      int columns, const CaptureOptions& capture, const Deskewing& deskewing) {
    auto config = PacketChain::decoder_config(columns, capture, FrameExchange::kImages, deskewing);
    config.reorder_packets = capture.reorder_packets.value_or(0);
    return config;
  }

  const pipeline::RangeImage* first_image_ = decoder.images().data();
  std::vector<pipeline::CellPlanes> planes_;
};

}  // namespace terracut::cli
