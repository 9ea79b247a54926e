// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calib/sensor_calibration.hpp"
#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/sensor_model.hpp"
#include "firmware_io/sensor/unit_calibration.hpp"
#include "firmware_io/streams/heard_senders.hpp"
#include "rt/error.hpp"

namespace terracut::streams {

/// Who sends, and what is needed to decode it.
struct SensorOnAir {
  net::Sender sender;
  sensor::SensorModel model{};
  int columns = 0;  ///< For the range image: firings a frame.
  double spin_hz = 0;
  bool dual_return = false;
  calib::SensorCalibration calibration;
};

/// Finds out who sends in the first seconds of a live run, and with which calibration: the file's,
/// or what the sensor itself says, an HDL-64E in its data packets, an RS-Ruby128 at its device
/// port.
///
/// Time is that of the datagrams' stamps. Allocates; one thread.
class FirstSeconds {
 public:
  struct Config {
    std::optional<sensor::SensorModel>
        model;                   ///< The only one wanted; none: each that can be decoded.
    std::optional<int> columns;  ///< None: as the sensor's spin rate suggests.
    sensor::CalibrationChoice calibration;
    std::string place;              ///< For people: where packets come in, "0.0.0.0:2368".
    std::uint16_t device_port = 0;  ///< Where an RS-Ruby128 was heard as well; 0: nowhere.
    /// The sensor that was in use before: of several it is the one.
    std::optional<net::Sender> known{};
  };
  explicit FirstSeconds(Config config) : config_(std::move(config)), senders_(config_.model) {}

  /// Of the data port or of the device port. `foreign`: datagrams that were left out so far because
  /// they came from other senders than the one wanted.
  void add(const packet::Datagram& datagram) { senders_.add(datagram); }
  void note_foreign(std::uint64_t datagrams) noexcept { foreign_ = datagrams; }

  /// It pays to listen at the device port.
  [[nodiscard]] bool wants_device_port() const;
  /// A sensor's head rotates, nobody else sends, or it is the one that was in use before, and its
  /// calibration is known or will not come: within 0.3 s another sensor would have shown, within 6
  /// s a calibration. Where the one that was in use before sends and stands, it is waited for.
  [[nodiscard]] bool is_enough() const;
  /// For people: what is missing.
  [[nodiscard]] std::string waits_for() const;

  /// For people, of the sensors that are not concluded: "HDL-64E at 192.168.1.7". Empty: none.
  [[nodiscard]] std::string other_sensors() const;

  /// The sensor, turning or not. kUnsupported: nobody sends what can be decoded; the message says
  /// what came instead, within `patience_s` where that is given. kInvalidArgument: several sensors
  /// do, of which none was in use before. kNoCalibration: none was given nor sent. The errors of
  /// the calibration file.
  [[nodiscard]] Expected<SensorOnAir> conclude(std::optional<double> patience_s = {}) const;

 private:
  using Sensors = std::vector<HeardSenders::Sensor>;
  /// Of several the one that was in use before, where it is among them.
  [[nodiscard]] Sensors chosen_of(Sensors heard) const;
  [[nodiscard]] std::string wanted_name() const;
  [[nodiscard]] std::string heard_instead() const;
  [[nodiscard]] Error nobody(std::optional<double> patience_s) const;
  [[nodiscard]] Expected<calib::SensorCalibration> from_packets(sensor::SensorModel model,
                                                                std::uint32_t address) const;

  Config config_;
  HeardSenders senders_;
  std::uint64_t foreign_ = 0;
};

}  // namespace terracut::streams
