// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calib/sensor/sensor_model.hpp"
#include "calib/sensor_calibration.hpp"
#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/sensor/unit_calibration.hpp"
#include "firmware_io/streams/heard_senders.hpp"
#include "rt/error.hpp"

namespace terracut::streams {

/// A sensor that is sending, with what is needed to decode it.
struct SensorOnAir {
  net::Sender sender;
  sensor::SensorModel model{};
  int columns = 0;  ///< Firings per frame, for the range image.
  double spin_hz = 0;
  bool dual_return = false;
  calib::SensorCalibration calibration;
};

/// Finds out who sends in the first seconds of a live run, and its calibration: the file's, or the
/// sensor's own, which an HDL-64E sends in its data packets and an RS-Ruby128 at its device port.
///
/// Time is that of the datagrams' stamps. Allocates; one thread.
class FirstSeconds {
 public:
  struct Config {
    std::optional<sensor::SensorModel>
        model;  ///< The only model wanted; none: any that can be decoded.
    /// Columns of the range image; empty: from the sensor's spin rate.
    std::optional<int> columns;
    sensor::CalibrationChoice calibration;
    std::string place;              ///< Where packets come in, for messages: "0.0.0.0:2368".
    std::uint16_t device_port = 0;  ///< The port at which DIFOP packets were expected; 0: none.
    /// The sensor used before; if several send, this one is chosen.
    std::optional<net::Sender> known{};
  };
  explicit FirstSeconds(Config config) : config_(std::move(config)), senders_(config_.model) {}

  /// add() takes datagrams of the data port and of the device port. note_foreign() takes the number
  /// of datagrams so far that were left out because of their sender.
  void add(const packet::Datagram& datagram) { senders_.add(datagram); }
  void note_foreign(std::uint64_t datagrams) noexcept { foreign_ = datagrams; }

  /// True if the caller should listen at the device port, too: an RS-Ruby128 is wanted and no
  /// calibration is given.
  [[nodiscard]] bool wants_device_port() const;
  /// True if the search can end: a sensor's head rotates, it is the only sender or the one used
  /// before, and its calibration is known or will not come. Another sensor would be heard within
  /// 0.3 s, a calibration within 6 s. If the sensor used before sends but does not rotate, the
  /// search waits for it.
  [[nodiscard]] bool is_enough() const;
  /// Returns, for people, what is still missing.
  [[nodiscard]] std::string waits_for() const;

  /// Names the sensors not chosen, for people: "HDL-64E at 192.168.1.7". Empty if there are none.
  [[nodiscard]] std::string other_sensors() const;

  /// Returns the sensor, whether it rotates or not. Fails with kUnsupported if nobody sends
  /// anything that can be decoded (the message says what came instead, within `patience_s` if
  /// given), kInvalidArgument if several sensors send and none of them was used before,
  /// kNoCalibration if no calibration was given or sent, and with the errors of the calibration
  /// file.
  [[nodiscard]] Expected<SensorOnAir> conclude(std::optional<double> patience_s = {}) const;

 private:
  using Sensors = std::vector<SensorStream>;
  /// Picks the sensor used before if it is among several.
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
