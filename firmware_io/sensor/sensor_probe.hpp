// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/sensor/head_reader.hpp"

namespace terracut::sensor {

/// Finds out from the first packets of a stream which sensor sends them and how it rotates, so that
/// a decoder can be made. Not for the receive thread: allocates.
class SensorProbe {
 public:
  /// `named` is the model that the user has named, if any (recognise_sensor_as()).
  explicit SensorProbe(std::optional<SensorModel> named = {}) : named_(named) {}

  void add(const packet::Datagram& datagram);

  /// Returns the number of datagrams by model, device information and unknown ones included.
  [[nodiscard]] const std::map<SensorModel, std::uint64_t>& votes() const noexcept {
    return votes_;
  }
  [[nodiscard]] std::uint64_t packets_of(SensorModel model) const;
  /// True if enough data packets of a rotating head of `model` came for the answers below.
  [[nodiscard]] bool knows(SensorModel model) const;

  /// Returns the frames per second of a decoded model, by its own stamps and azimuths; 0 while
  /// unknown.
  [[nodiscard]] double spin_hz(SensorModel model) const;
  [[nodiscard]] bool dual_return(SensorModel model) const;
  /// Returns the columns of the model's range image: the firings per frame, at the nominal 5, 10,
  /// 15 or 20 Hz if the head rotates at about that, else at its own rate. Outside 5 to 20 Hz, and
  /// while the rate is unknown, returns the model's default. Of an Ouster, returns the columns that
  /// its packets number.
  [[nodiscard]] int columns(SensorModel model) const;

  /// Returns the number of data packets in which the model's head rotates backwards, which no real
  /// head does.
  [[nodiscard]] std::uint64_t backward_packets(SensorModel model) const;

  /// Returns the models seen that cannot be decoded, as a phrase: "12 packets of a Velodyne VLP-16
  /// Hi-Res". Empty if there are none.
  [[nodiscard]] std::string foreign_models() const;

 private:
  /// Counts and azimuths of one model's packets.
  struct Head {
    std::uint64_t packets = 0, dual_packets = 0;
    std::uint64_t slow_steps = 0;  ///< Steps from packet to packet of the HDL-64E's 57.6 us cycle.
    std::int64_t rotated_cdeg = 0, time_us = 0;
    std::optional<packet::PacketAzimuths> last;

    void add(const packet::PacketAzimuths& azimuths);
  };
  [[nodiscard]] const Head* head_of(SensorModel model) const;

  std::optional<SensorModel> named_;
  std::map<SensorModel, std::uint64_t> votes_;
  std::map<SensorModel, Head> azimuths_;  ///< Decoded models only.
  std::map<SensorModel, std::uint64_t> backward_packets_;
  std::uint8_t other_product_ = 0;  ///< Product number of the newest unknown Velodyne.
  HeadReader reader_;
};

}  // namespace terracut::sensor
