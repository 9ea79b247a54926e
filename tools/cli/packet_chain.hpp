// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "calib/ring_profile.hpp"
#include "firmware_io/hdl64e/hdl64e_decoder.hpp"
#include "options.hpp"
#include "pipeline/segmenter.hpp"
#include "setup_choice.hpp"

namespace terracut::cli {

/// Decoder and segmenter, sized for each other: all that needs memory of its own on the way from
/// packets to labels.
struct PacketChain {
  firmware_io::Hdl64eDecoder decoder;
  pipeline::Segmenter segmenter;

  PacketChain(const calib::Hdl64eCalibration& calibration, const calib::RingProfile& profile,
              const CaptureOptions& capture, const MethodOptions& method, rt::FixedMemory& memory)
      : decoder(calibration, profile.mount, decoder_config(capture), memory),
        segmenter(segmenter_config_of(method), profile, decoder.shape(),
                  decoder.shape().cells() *
                      static_cast<std::size_t>(decoder_config(capture).returns_per_cell),
                  memory) {}

  [[nodiscard]] static firmware_io::Hdl64eDecoder::Config decoder_config(
      const CaptureOptions& capture) {
    firmware_io::Hdl64eDecoder::Config config;
    if (capture.geometry == "ros") config.sensor.geometry = calib::GeometryModel::kRosLike;
    return config;
  }
};

}  // namespace terracut::cli
