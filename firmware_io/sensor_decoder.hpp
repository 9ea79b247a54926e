// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "calib/mount.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/hdl64e/hdl64e_decoder.hpp"
#include "firmware_io/ruby128/ruby128_decoder.hpp"

namespace terracut::firmware_io {

/// The decoder of whichever sensor a calibration belongs to, for programs that learn only at run
/// time which it is: Decoder's interface, with one switch a packet. Same contracts as Decoder.
class SensorDecoder {
 public:
  struct Config {
    /// Firings per turn, as Decoder::Config::columns; 0: the sensor's default.
    int columns = 0;
    int images = 3;
    int reorder_packets = 2;
    pipeline::CellOwner dual_owner = pipeline::CellOwner::kStrongest;
    EgoMotion* motion = nullptr;  ///< As Decoder::Config::motion.
    TurnInstant deskew_at = TurnInstant::kEnd;
    Hdl64eSensor::Config hdl64e;
    Ruby128Sensor::Config ruby128;
  };

 private:
  template <class SomeDecoder, class SensorConfig>
  [[nodiscard]] static typename SomeDecoder::Config of_sensor(const Config& config,
                                                              const SensorConfig& sensor) {
    typename SomeDecoder::Config result;
    if (config.columns != 0) result.columns = config.columns;
    result.images = config.images;
    result.reorder_packets = config.reorder_packets;
    result.dual_owner = config.dual_owner;
    result.motion = config.motion;
    result.deskew_at = config.deskew_at;
    result.sensor = sensor;
    return result;
  }

  /// std::visit without its exception: after the constructor there is always a decoder.
  template <class Function>
  decltype(auto) visit(Function&& function) noexcept {
    if (auto* hdl64e = std::get_if<Hdl64eDecoder>(&decoder_)) return function(*hdl64e);
    return function(*std::get_if<Ruby128Decoder>(&decoder_));
  }
  template <class Function>
  decltype(auto) visit(Function&& function) const noexcept {
    if (const auto* hdl64e = std::get_if<Hdl64eDecoder>(&decoder_)) return function(*hdl64e);
    return function(*std::get_if<Ruby128Decoder>(&decoder_));
  }

 public:
  SensorDecoder(const calib::SensorCalibration& calibration, const calib::Mount& mount,
                const Config& config, rt::FixedMemory& memory) {
    if (const auto* hdl64e = std::get_if<calib::Hdl64eCalibration>(&calibration)) {
      decoder_.emplace<Hdl64eDecoder>(*hdl64e, mount,
                                      of_sensor<Hdl64eDecoder>(config, config.hdl64e), memory);
    } else if (const auto* ruby128 = std::get_if<calib::Ruby128Calibration>(&calibration)) {
      decoder_.emplace<Ruby128Decoder>(*ruby128, mount,
                                       of_sensor<Ruby128Decoder>(config, config.ruby128), memory);
    }
  }

  template <class OnFrame>
  std::optional<Reject> decode(const Datagram& datagram, OnFrame&& on_frame) noexcept {
    return visit([&](auto& decoder) { return decoder.decode(datagram, on_frame); });
  }
  template <class OnFrame>
  void flush(OnFrame&& on_frame) noexcept {
    visit([&](auto& decoder) { decoder.flush(on_frame); });
  }

  [[nodiscard]] ArrivingTurn arriving() noexcept {
    return visit([](auto& decoder) { return decoder.arriving(); });
  }

  [[nodiscard]] LossCounters losses() const noexcept {
    return visit([](const auto& decoder) { return decoder.losses(); });
  }
  [[nodiscard]] std::uint64_t packets_decoded() const noexcept {
    return visit([](const auto& decoder) { return decoder.packets_decoded(); });
  }
  [[nodiscard]] std::size_t packets_kept() const noexcept {
    return visit([](const auto& decoder) { return decoder.packets_kept(); });
  }
  [[nodiscard]] std::uint64_t columns_decoded() const noexcept {
    return visit([](const auto& decoder) { return decoder.columns_decoded(); });
  }
  [[nodiscard]] std::uint32_t frames() const noexcept {
    return visit([](const auto& decoder) { return decoder.frames(); });
  }
  [[nodiscard]] const pipeline::ImageShape& shape() const noexcept {
    return visit(
        [](const auto& decoder) -> const pipeline::ImageShape& { return decoder.shape(); });
  }
  /// The most returns a turn may have (RangeImage::return_capacity()).
  [[nodiscard]] std::size_t return_capacity() const noexcept {
    return visit([](const auto& decoder) { return decoder.return_capacity(); });
  }
  [[nodiscard]] std::span<pipeline::RangeImage> images() noexcept {
    return visit([](auto& decoder) { return decoder.images(); });
  }
  [[nodiscard]] bool dual_return() const noexcept {
    return visit([](const auto& decoder) { return decoder.dual_return(); });
  }
  [[nodiscard]] BlindAzimuths blind() const noexcept {
    return visit([](const auto& decoder) { return decoder.blind(); });
  }
  /// The decoder itself where it is the RS-Ruby128's, else null.
  [[nodiscard]] const Ruby128Decoder* ruby128() const noexcept {
    return std::get_if<Ruby128Decoder>(&decoder_);
  }

 private:
  std::variant<std::monostate, Hdl64eDecoder, Ruby128Decoder> decoder_;
};

}  // namespace terracut::firmware_io
