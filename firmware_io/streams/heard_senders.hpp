// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/sensor/device_reader.hpp"
#include "firmware_io/sensor/sensor_probe.hpp"
#include "firmware_io/streams/sender_streams.hpp"
#include "rt/error.hpp"

namespace terracut::streams {

/// Collects who sends to the ports, and how many packets of which model. A sensor is a sender of a
/// steady stream of data packets of a rotating head; one packet is not enough. No flood of other
/// senders can hide a sensor: when the memory is full, a newcomer with data packets replaces the
/// sender that has the fewest; if several have as few, the one that has been silent longest. Time
/// is that of the datagrams' stamps. Allocates; one thread.
class HeardSenders {
 public:
  /// `wanted` is the only model that counts; empty: any that can be decoded.
  explicit HeardSenders(std::optional<sensor::SensorModel> wanted) : wanted_(wanted) {}

  void add(const packet::Datagram& datagram);

  [[nodiscard]] bool wants(sensor::SensorModel model) const {
    return sensor::is_wanted(wanted_, model);
  }
  /// Returns the senders of wanted data packets except strays (drop_strays()); for captures, which
  /// may end at any time.
  [[nodiscard]] std::vector<SensorStream> sensors() const;
  /// Returns the sensors whose head is known to rotate.
  [[nodiscard]] std::vector<SensorStream> rotating() const;
  /// Returns the sensors that send data packets steadily, rotating or not.
  [[nodiscard]] std::vector<SensorStream> steady() const;
  /// True if the sensor is in steady() but not in rotating().
  [[nodiscard]] bool is_steady_but_stands(std::uint32_t address) const;
  /// Returns the time from when rotating() got its first sensor to the newest datagram; 0 without a
  /// sensor.
  [[nodiscard]] std::int64_t known_for_ns() const {
    return first_known_ns_ == 0 ? 0 : newest_ns_ - first_known_ns_;
  }
  /// True if the sensor has sent its own calibration, or needs none.
  [[nodiscard]] bool has_told(const SensorStream& sensor) const;

  [[nodiscard]] const sensor::SensorProbe& probe(std::uint32_t address) const {
    return senders_.at(address).probe;
  }
  [[nodiscard]] const hdl64e::StatusStreamReader& hdl64e_status(std::uint32_t address) const {
    return senders_.at(address).hdl64e_status;
  }
  [[nodiscard]] const sensor::DeviceReader& device(std::uint32_t address) const {
    return senders_.at(address).device;
  }
  /// Returns, for people, what came instead of a rotating sensor: "12 datagrams of no sensor known
  /// here, 100 bytes to port 2368, from 192.168.1.7; HDL-64E, whose head does not rotate, from
  /// 192.168.1.201". Empty if nothing came.
  [[nodiscard]] std::string others() const;

 private:
  /// Most senders kept: more are probably a port scan.
  static constexpr std::size_t kMostSenders = 64;
  static constexpr std::uint64_t kSteady_packets = 50;
  /// The most senders that others() describes; it only counts further ones.
  static constexpr std::size_t kMostNamed = 4;

  /// The datagrams of one address.
  struct Sender {
    explicit Sender(std::optional<sensor::SensorModel> wanted) : probe(wanted) {}

    sensor::SensorProbe probe;
    std::map<sensor::SensorModel, SenderStreams> streams;
    std::string first_unknown;  ///< "1218 bytes to port 2368: ..."; empty: none.
    std::string foreign_hints;  ///< Of the first packet that is known and not decoded.
    hdl64e::StatusStreamReader hdl64e_status;
    sensor::DeviceReader device;
    std::int64_t newest_ns = 0;

    void add(const packet::Datagram& datagram, std::optional<sensor::SensorModel> wanted);
    [[nodiscard]] std::uint64_t data_packets() const;
    [[nodiscard]] std::vector<SensorStream> sensors_of(sensor::SensorModel model) const;
  };
  /// Returns the entry of the datagram's sender, a new one if need be; null if there is no room for
  /// it.
  [[nodiscard]] Sender* sender_of(const packet::Datagram& datagram);

  template <class Predicate>
  [[nodiscard]] std::vector<SensorStream> sensors_that(const Predicate& are) const;
  [[nodiscard]] std::string describe(const Sender& sender) const;

  std::optional<sensor::SensorModel> wanted_;
  std::map<std::uint32_t, Sender> senders_;
  std::uint64_t forgotten_datagrams_ = 0;  ///< Sent by senders replaced or not kept.
  std::int64_t newest_ns_ = 0, first_known_ns_ = 0;
};

/// Who sends in the first second or so of a capture.
struct HeardCapture {
  HeardSenders senders;
  /// Why reading ended before the capture did; empty if it did not.
  std::optional<Error> broke_off;
};
/// Reads the beginning of a capture. Leaves `source` at any position.
[[nodiscard]] HeardCapture hear_beginning(capture::CaptureSource& source,
                                          std::optional<sensor::SensorModel> wanted);

}  // namespace terracut::streams
