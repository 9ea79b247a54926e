// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <optional>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/hdl64e/s1_reader.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/sensor_model.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "firmware_io/velodyne/hdl32e.hpp"
#include "firmware_io/velodyne/packet_reader.hpp"
#include "firmware_io/velodyne/vlp16.hpp"
#include "firmware_io/velodyne/vlp32c.hpp"
#include "firmware_io/velodyne/vls128.hpp"

namespace terracut::sensor {

/// Layouts by VelodyneModel.
inline constexpr std::array<velodyne::PacketLayout, velodyne::kVelodyneModels> kVelodyneLayouts{
    velodyne::Vlp16::kLayout, velodyne::Hdl32e::kLayout, velodyne::Vlp32c::kLayout,
    velodyne::Vls128::kLayout};

/// Reads head azimuths and stamps from the data packets of any decoded model, without a decoder.
/// One stream, one thread.
class HeadReader {
 public:
  /// Does the check() of the model's trait, for a named model (VelodyneConfig). An RS-Ruby128's
  /// packets with a blind sector inside are rejected.
  [[nodiscard]] std::optional<frame::Reject> read(SensorModel model,
                                                  const packet::Datagram& datagram,
                                                  packet::PacketAzimuths& azimuths) noexcept;

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
