// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "calib/mount/mount.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/hdl64e/hdl64e_decoder.hpp"
#include "firmware_io/ruby128/ruby128_decoder.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::sensor {

/// The decoder of whichever sensor a calibration belongs to, for programs that learn only at run
/// time which it is: Decoder's interface, with one switch a packet. Same contracts as Decoder.
class SensorDecoder {
 public:
  struct Config {
    /// Firings per frame, as Decoder::Config::columns; 0: the sensor's default.
    int columns = 0;
    int images = 3;
    int reorder_packets = 2;
    frame::CellOwner dual_owner = frame::CellOwner::kStrongest;
    vehicle::EgoMotion* motion = nullptr;  ///< As Decoder::Config::motion.
    frame::FrameInstant deskew_at = frame::FrameInstant::kEnd;
    hdl64e::Hdl64eSensor::Config hdl64e;
    ruby128::Ruby128Sensor::Config ruby128;
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
    if (auto* hdl64e = std::get_if<hdl64e::Hdl64eDecoder>(&decoder_)) return function(*hdl64e);
    return function(*std::get_if<ruby128::Ruby128Decoder>(&decoder_));
  }
  template <class Function>
  decltype(auto) visit(Function&& function) const noexcept {
    if (const auto* hdl64e = std::get_if<hdl64e::Hdl64eDecoder>(&decoder_))
      return function(*hdl64e);
    return function(*std::get_if<ruby128::Ruby128Decoder>(&decoder_));
  }

 public:
  SensorDecoder(const calib::SensorCalibration& calibration, const mount::Mount& mount,
                const Config& config, memory::FixedMemory& memory) {
    if (const auto* hdl64e = std::get_if<hdl64e::Hdl64eCalibration>(&calibration)) {
      decoder_.emplace<hdl64e::Hdl64eDecoder>(
          *hdl64e, mount, of_sensor<hdl64e::Hdl64eDecoder>(config, config.hdl64e), memory);
    } else if (const auto* ruby128 = std::get_if<ruby128::Ruby128Calibration>(&calibration)) {
      decoder_.emplace<ruby128::Ruby128Decoder>(
          *ruby128, mount, of_sensor<ruby128::Ruby128Decoder>(config, config.ruby128), memory);
    }
  }

  void push(const decode::Datagram& datagram) noexcept TERRACUT_NONBLOCKING {
    visit([&](auto& decoder) { decoder.push(datagram); });
  }
  void end_stream() noexcept TERRACUT_NONBLOCKING {
    visit([](auto& decoder) { decoder.end_stream(); });
  }
  [[nodiscard]] frame::Frame* next(frame::RangeImage* in_exchange = nullptr) noexcept
      TERRACUT_NONBLOCKING {
    return visit([&](auto& decoder) { return decoder.next(in_exchange); });
  }
  [[nodiscard]] std::optional<frame::Reject> rejected() const noexcept {
    return visit([](const auto& decoder) { return decoder.rejected(); });
  }

  [[nodiscard]] frame::ArrivingFrame arriving() noexcept {
    return visit([](auto& decoder) { return decoder.arriving(); });
  }

  [[nodiscard]] frame::LossCounters losses() const noexcept {
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
  [[nodiscard]] const frame::ImageShape& shape() const noexcept {
    return visit([](const auto& decoder) -> const frame::ImageShape& { return decoder.shape(); });
  }
  /// The most returns a frame may have (RangeImage::return_capacity()).
  [[nodiscard]] std::size_t return_capacity() const noexcept {
    return visit([](const auto& decoder) { return decoder.return_capacity(); });
  }
  [[nodiscard]] std::span<frame::RangeImage> images() noexcept {
    return visit([](auto& decoder) { return decoder.images(); });
  }
  [[nodiscard]] bool dual_return() const noexcept {
    return visit([](const auto& decoder) { return decoder.dual_return(); });
  }
  [[nodiscard]] frame::BlindAzimuths blind() const noexcept {
    return visit([](const auto& decoder) { return decoder.blind(); });
  }
  /// The decoder itself where it is the RS-Ruby128's, else null.
  [[nodiscard]] const ruby128::Ruby128Decoder* ruby128() const noexcept {
    return std::get_if<ruby128::Ruby128Decoder>(&decoder_);
  }

 private:
  std::variant<std::monostate, hdl64e::Hdl64eDecoder, ruby128::Ruby128Decoder> decoder_;
};

}  // namespace terracut::sensor
