// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>

#include "calib/ring_profile.hpp"
#include "firmware_io/sensor_decoder.hpp"
#include "options.hpp"
#include "pipeline/segmenter.hpp"
#include "setup_choice.hpp"

namespace terracut::cli {

/// Decoder and segmenter, sized for each other: all that needs memory of its own on the way from
/// packets to labels.
struct PacketChain {
  firmware_io::SensorDecoder decoder;
  pipeline::Segmenter segmenter;

  /// `columns`: of the range image, 0 for the sensor's default.
  PacketChain(const calib::SensorCalibration& calibration, const calib::RingProfile& profile,
              int columns, const CaptureOptions& capture, const MethodOptions& method,
              rt::FixedMemory& memory, int images = 3)
      : decoder(calibration, profile.mount, decoder_config(columns, capture, images), memory),
        segmenter(segmenter_config_of(method), profile, decoder.shape(), decoder.return_capacity(),
                  memory) {}

  [[nodiscard]] static firmware_io::SensorDecoder::Config decoder_config(
      int columns, const CaptureOptions& capture, int images = 3) {
    firmware_io::SensorDecoder::Config config;
    config.images = images;
    config.columns = columns;
    config.dual_owner = cell_owner_of(capture.cell_owner);
    if (capture.geometry == "ros") config.hdl64e.geometry = calib::GeometryModel::kRosLike;
    config.ruby128.timestamp = timestamp_of(capture.timestamp);
    return config;
  }

 private:
  [[nodiscard]] static pipeline::CellOwner cell_owner_of(const std::string& name) {
    if (name == "last") return pipeline::CellOwner::kFarthest;
    if (name == "first") return pipeline::CellOwner::kNearest;
    if (name == "both") return pipeline::CellOwner::kFirstArrived;
    return pipeline::CellOwner::kStrongest;
  }
  [[nodiscard]] static std::optional<firmware_io::RubyTimestamp> timestamp_of(
      const std::string& name) {
    if (name == "calendar") return firmware_io::RubyTimestamp::kCalendar;
    if (name == "us") return firmware_io::RubyTimestamp::kUtcMicroseconds;
    if (name == "ns") return firmware_io::RubyTimestamp::kUtcNanoseconds;
    return std::nullopt;
  }
};

}  // namespace terracut::cli
