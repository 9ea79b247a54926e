// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/head_reader.hpp"

#include "calib/ouster/ouster_calibration.hpp"
#include "firmware_io/hdl64e/packet_check.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/ruby128/packet_check.hpp"

namespace terracut::sensor {

std::optional<frame::Reject> HeadReader::read(SensorModel model, const packet::Datagram& datagram,
                                              packet::PacketAzimuths& azimuths) noexcept {
  if (model == SensorModel::kRuby128) {
    const auto reason = ruby128::check_ruby128_packet(datagram.payload, azimuths);
    const auto* packet = ruby128::packet_in(datagram.payload);
    if (reason || packet == nullptr) return reason;
    ruby_clock_.read(packet->stamp, azimuths);
    return std::nullopt;
  }
  for (velodyne::PacketReader& reader : velodyne_.of_models) {
    if (reader.model() == model) return reader.read(datagram.payload, azimuths);
  }
  for (hesai::PacketReader& reader : hesai_.of_models) {
    if (reader.model() == model) return reader.read(datagram.payload, azimuths);
  }
  for (robosense::PacketReader& reader : robosense_.of_models) {
    if (reader.model() == model) return reader.read(datagram.payload, azimuths);
  }
  if (is_ouster(model)) {
    return ouster_.read(datagram.payload, ouster::rows_of(model), azimuths);
  }
  const auto* packet = hdl64e::packet_in(datagram.payload);
  if (model == SensorModel::kHdl64eS1 && packet != nullptr) {
    return s1_.read(*packet, datagram.stamp_ns, azimuths);
  }
  return hdl64e::check_hdl64e_packet(datagram.payload, azimuths);
}

}  // namespace terracut::sensor
