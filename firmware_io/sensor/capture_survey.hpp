// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calib/sensor/sensor_model.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/sensor/device_reader.hpp"
#include "firmware_io/sensor/hdl64e_survey.hpp"
#include "firmware_io/sensor/ruby128_survey.hpp"
#include "rt/error.hpp"

namespace terracut::sensor {

/// The datagrams of one sender and receiver (addresses, ports and VLAN) in a capture.
struct UdpStream {
  std::uint32_t source_address = 0;  ///< IPv4, host byte order.
  std::uint32_t destination_address = 0;
  std::uint16_t source_port = 0;
  std::uint16_t destination_port = 0;
  std::uint32_t vlan = 0;  ///< See Datagram.
  std::uint64_t packets = 0;
  std::uint64_t payload_bytes = 0;
  std::map<std::size_t, std::uint64_t> payload_sizes;  ///< Packets by payload size.
  std::int64_t first_stamp_ns = 0;                     ///< Capture stamps: earliest and latest.
  std::int64_t last_stamp_ns = 0;

  SensorModel sensor = SensorModel::kUnknown;  ///< The model that most packets come from.
  /// The hint of describe_sensor_hints() or guess_of_unknown() for the first packet.
  std::string sensor_hints;
  std::optional<Hdl64eFacts> hdl64e;    ///< Set if any packet is from an HDL-64E.
  std::optional<Ruby128Facts> ruby128;  ///< Set if any packet is an RS-Ruby128's data packet.
  std::optional<StreamFacts> head;      ///< Set if most packets are from another decoded model.
  std::optional<DeviceReader> device;   ///< Set if any packet is a DIFOP packet.

  /// Returns packets a second by the capture stamps; 0 for fewer than two packets.
  [[nodiscard]] double rate_hz() const noexcept;
};

/// Everything that `terracut info` shows of a capture.
struct CaptureSurvey {
  std::string name;
  int link_type = 0;           ///< libpcap's DLT_ number; of a bag -1.
  std::string link_type_name;  ///< As CaptureSource::link_name().
  capture::CaptureCounters counters;
  std::vector<UdpStream> streams;                ///< The streams, the one with most packets first.
  std::uint64_t packets_of_further_streams = 0;  ///< Packets of streams beyond kMostStreams.
  /// Why reading ended before the file's end; empty if it did not.
  std::optional<Error> broke_off;

  static constexpr std::size_t kMostStreams = 1024;
};

/// Reads the capture from its present position, until `stop_wanted` if given. A capture that breaks
/// off is no failure (see CaptureSurvey::broke_off). For inspection: allocates, takes about a
/// second per gigabyte.
[[nodiscard]] CaptureSurvey survey_capture(capture::CaptureSource& source,
                                           const std::function<bool()>& stop_wanted = {});

}  // namespace terracut::sensor
