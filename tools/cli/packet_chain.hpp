// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>
#include <type_traits>

#include "calib/ring_profile.hpp"
#include "firmware_io/sensor_decoder.hpp"
#include "options.hpp"
#include "pipeline/ground_method.hpp"
#include "pipeline/segmenter.hpp"
#include "setup_choice.hpp"

namespace terracut::cli {

/// The vehicle's motion, where it is to be taken out of every turn.
struct Deskewing {
  firmware_io::EgoMotion* motion = nullptr;  ///< Null: returns lie where the sensor saw them.
  firmware_io::TurnInstant at = firmware_io::TurnInstant::kEnd;
};

/// Decoder and segmenter, sized for each other: all that needs memory of its own on the way from
/// packets to labels.
///
/// `Labeller`: pipeline::Segmenter, or pipeline::GroundMethod where --method may name another.
template <class Labeller>
struct PacketChainOf {
  firmware_io::SensorDecoder decoder;
  Labeller segmenter;

  /// `columns`: of the range image, 0 for the sensor's default.
  PacketChainOf(const calib::SensorCalibration& calibration, const calib::RingProfile& profile,
                int columns, const CaptureOptions& capture, const MethodOptions& method,
                rt::FixedMemory& memory, int images = 3, const Deskewing& deskewing = {})
      : decoder(calibration, profile.mount, decoder_config(columns, capture, images, deskewing),
                memory),
        segmenter(labeller_config(method), profile, decoder.shape(), decoder.return_capacity(),
                  memory) {}

  /// Decodes a datagram and does ahead what can be segmented of the turn that is arriving; turns
  /// are handed to `on_frame` when they are whole, for segmenter.segment().
  template <class OnFrame>
  std::optional<firmware_io::Reject> decode(const firmware_io::Datagram& datagram,
                                            OnFrame&& on_frame,
                                            pipeline::StageObserver* observer) noexcept {
    const auto rejected = decoder.decode(datagram, on_frame);
    const firmware_io::ArrivingTurn arriving = decoder.arriving();
    if (arriving.image != nullptr) {
      segmenter.advance(*arriving.image, arriving.settled_columns, observer);
    }
    return rejected;
  }

  [[nodiscard]] static firmware_io::SensorDecoder::Config decoder_config(
      int columns, const CaptureOptions& capture, int images = 3, const Deskewing& deskewing = {}) {
    firmware_io::SensorDecoder::Config config;
    config.motion = deskewing.motion;
    config.deskew_at = deskewing.at;
    config.images = images;
    config.columns = columns;
    config.reorder_packets = capture.reorder_packets.value_or(config.reorder_packets);
    config.dual_owner = cell_owner_of(capture.cell_owner);
    if (capture.geometry == "ros") config.hdl64e.geometry = calib::GeometryModel::kRosLike;
    config.ruby128.timestamp = timestamp_of(capture.timestamp);
    return config;
  }

 private:
  [[nodiscard]] static auto labeller_config(const MethodOptions& method) {
    if constexpr (std::is_same_v<Labeller, pipeline::Segmenter>) {
      return segmenter_config_of(method);
    } else {
      return method_config_of(method);
    }
  }
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

using PacketChain = PacketChainOf<pipeline::Segmenter>;

}  // namespace terracut::cli
