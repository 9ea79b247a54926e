// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <optional>

#include "firmware_io/decode/datagram.hpp"
#include "firmware_io/decode/packet_azimuths.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/hdl32e/hdl32e_sensor.hpp"
#include "firmware_io/hdl64e/s1_reader.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "firmware_io/sensor/sensor_model.hpp"
#include "firmware_io/velodyne/packet_reader.hpp"
#include "firmware_io/vlp16/vlp16_sensor.hpp"
#include "firmware_io/vlp32c/vlp32c_sensor.hpp"
#include "firmware_io/vls128/vls128_sensor.hpp"

namespace terracut::sensor {

/// By VelodyneModel.
inline constexpr std::array<velodyne::PacketLayout, velodyne::kVelodyneModels> kVelodyneLayouts{
    vlp16::Vlp16::kLayout, hdl32e::Hdl32e::kLayout, vlp32c::Vlp32c::kLayout,
    vls128::Vls128::kLayout};

/// Reads from the data packets of any decoded model where the head stood and when, without a
/// decoder. One stream, one thread.
class HeadReader {
 public:
  /// As the check() of the model's trait, the model being a named one (VelodyneConfig). An
  /// RS-Ruby128's packets with a blind sector inside are rejected.
  [[nodiscard]] std::optional<frame::Reject> read(SensorModel model,
                                                  const decode::Datagram& datagram,
                                                  decode::PacketAzimuths& azimuths) noexcept;

 private:
  hdl64e::S1Reader s1_;
  ruby128::RubyTimestampDetector ruby_timestamp_;
  std::array<velodyne::PacketReader, velodyne::kVelodyneModels> velodyne_{
      velodyne::PacketReader(kVelodyneLayouts[0], true),
      velodyne::PacketReader(kVelodyneLayouts[1], true),
      velodyne::PacketReader(kVelodyneLayouts[2], true),
      velodyne::PacketReader(kVelodyneLayouts[3], true)};
};

}  // namespace terracut::sensor
