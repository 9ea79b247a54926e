// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <optional>

#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/hdl64e/s1_reader.hpp"
#include "firmware_io/hesai/models.hpp"
#include "firmware_io/hesai/packet_reader.hpp"
#include "firmware_io/ouster/head_reader.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/robosense/models.hpp"
#include "firmware_io/robosense/packet_reader.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "firmware_io/velodyne/models.hpp"
#include "firmware_io/velodyne/packet_reader.hpp"

namespace terracut::sensor {

/// Reads the head's azimuths and times from the data packets of any decoded model, without a
/// decoder. One stream, one thread.
class HeadReader {
 public:
  /// Runs check() of the model's trait. The model counts as named by the user (VelodyneConfig). An
  /// RS-Ruby128's packets with a blind sector inside are rejected. An Ouster's columns of a frame
  /// are those of 10 Hz until a frame's end has come.
  [[nodiscard]] std::optional<frame::Reject> read(SensorModel model,
                                                  const packet::Datagram& datagram,
                                                  packet::PacketAzimuths& azimuths) noexcept;

 private:
  hdl64e::S1Reader s1_;
  ruby128::RubyClock ruby_clock_{std::nullopt};
  template <class... Model>
  struct VelodyneReaders {
    std::array<velodyne::PacketReader, sizeof...(Model)> of_models{
        velodyne::PacketReader(Model::kLayout, true)...};
  };
  velodyne::Models::In<VelodyneReaders> velodyne_;
  template <class... Model>
  struct HesaiReaders {
    std::array<hesai::PacketReader, sizeof...(Model)> of_models{
        hesai::PacketReader(Model::kLayout)...};
  };
  hesai::Models::In<HesaiReaders> hesai_;
  template <class... Model>
  struct RoboSenseReaders {
    std::array<robosense::PacketReader, sizeof...(Model)> of_models{
        robosense::PacketReader(Model::kLayout)...};
  };
  robosense::Models::In<RoboSenseReaders> robosense_;
  ouster::HeadReader ouster_;
};

}  // namespace terracut::sensor
