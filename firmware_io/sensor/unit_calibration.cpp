// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sensor/unit_calibration.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "calib/hdl64e/hdl64e_file.hpp"
#include "calib/hdl64e/hdl64e_stream_table.hpp"
#include "calib/hesai/hesai_csv.hpp"
#include "calib/ouster/ouster_metadata.hpp"
#include "calib/robosense/unit_table.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"
#include "calib/ruby128/ruby128_csv.hpp"
#include "firmware_io/hdl64e/packet_check.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/sensor/device_reader.hpp"

namespace terracut::sensor {
namespace {

using capture::CaptureSource;

// --- HDL-64E: the table in the status stream ---

/// A table takes 4160 packets, and S2 units must send it twice; the other packets allow for losses.
constexpr std::uint64_t kPacketsToSearch = 30'000;

/// The result of the search for a table in the packets.
struct StreamSearch {
  std::optional<hdl64e::Hdl64eCalibration> found;
  std::string table_error;  ///< Set for a whole table without a plausible calibration.
  std::string broke_off;    ///< Why the capture could not be read further.
  std::uint64_t data_packets = 0;
  std::size_t holes = 0;
};

StreamSearch search_status_stream(CaptureSource& source) {
  StreamSearch search;
  hdl64e::StatusStreamReader status;
  packet::PacketAzimuths azimuths;
  while (search.data_packets < kPacketsToSearch && !status.has_table()) {
    const auto next = source.next();
    if (!next) search.broke_off = next.error().message;
    if (!next || !*next) break;
    const auto reject = hdl64e::check_hdl64e_packet((*next)->payload, azimuths);
    // A sensor whose head stands still sends its table, too.
    if (reject && *reject != frame::Reject::kStationary) continue;
    const auto* packet = hdl64e::packet_in((*next)->payload);
    if (packet == nullptr) continue;
    ++search.data_packets;
    status.add(packet->status_type, packet->status_value, packet->stamp_us.value());
  }
  search.holes = status.holes();
  if (!status.has_table()) return search;
  auto table = hdl64e::parse_stream_table(status.table());
  if (table) {
    search.found = *std::move(table);
  } else {
    search.table_error = table.error().message;
  }
  return search;
}

Error no_calibration(const CaptureSource& source, const StreamSearch& search) {
  const std::string missing =
      !search.table_error.empty()
          ? fmt::format("the table in them is not usable: {}", search.table_error)
          : fmt::format(
                "{} of the table's {} bytes are missing after {} packets (a whole table takes "
                "4160 packets, 1.2 s)",
                search.holes, hdl64e::kStreamTableBytes, search.data_packets);
  return {
      ErrorCode::kNoCalibration,
      fmt::format("{}: no calibration: none was given, and the packets do not hold one: {}{}. Give "
                  "the unit's db.xml or yaml with --calibration FILE",
                  source.name(), missing, search.broke_off.empty() ? "" : "; " + search.broke_off)};
}

Expected<calib::SensorCalibration> from_packets_of_hdl64e(CaptureSource& source) {
  StreamSearch search = search_status_stream(source);
  if (!search.found) return tl::unexpected(no_calibration(source, search));
  return *std::move(search.found);
}

// --- RoboSense: the angles in DIFOP ---

/// A DIFOP packet comes about once a second, after up to 12000 data packets.
constexpr std::uint64_t kDatagramsToSearch = 60'000;

Expected<calib::SensorCalibration> from_packets_of_robosense(CaptureSource& source,
                                                             SensorModel model) {
  DeviceReader device;
  for (std::uint64_t i = 0; i < kDatagramsToSearch && !device.has_calibration(model); ++i) {
    const auto next = source.next();
    if (!next || !*next) break;
    device.add((*next)->payload);
  }
  const auto& found = device.calibration(model);
  if (found) return found;
  return fail(ErrorCode::kNoCalibration,
              fmt::format("{}: no calibration: none was given, and the packets do not hold one: "
                          "{}. {}",
                          source.name(), found.error().message, what_to_give(model)));
}

}  // namespace

std::string what_to_give(SensorModel model) {
  return fmt::format("Give the unit's angle.csv with --calibration FILE{}",
                     model == SensorModel::kRuby128
                         ? ", or consent to the model's table, which is off by some hundredths of "
                           "a degree, with --nominal-calibration"
                         : "");
}

tl::unexpected<Error> fail_for_s1(const std::string& place) {
  return fail(
      ErrorCode::kNoCalibration,
      fmt::format("{}: no calibration: none was given, and an HDL-64E S1 does not send one. "
                  "Give the unit's db.xml or yaml with --calibration FILE",
                  place));
}

tl::unexpected<Error> fail_for_ouster(const std::string& place) {
  return fail(
      ErrorCode::kNoCalibration,
      fmt::format("{}: no metadata: none was given, and an Ouster's packets hold neither its "
                  "angles nor its mode. Give the .json file recorded with it, or its answer "
                  "to http://SENSOR/api/v1/sensor/metadata, with --calibration FILE",
                  place));
}

Expected<calib::SensorCalibration> unit_calibration(const CalibrationChoice& choice,
                                                    SensorModel model,
                                                    const FromPackets& from_packets) {
  const bool ruby128 = model == SensorModel::kRuby128;
  if (choice.unit) return *choice.unit;
  if (is_ouster(model) && !choice.file.empty()) {
    return ouster::read_ouster_metadata(choice.file, model);
  }
  if (is_hesai(model)) {
    if (choice.file.empty()) return beams::built_in_table(model);
    return hesai::read_hesai_csv(choice.file, model);
  }
  if (has_factory_table(model)) {
    if (choice.file.empty()) return beams::built_in_table(model);
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: the table of a {} is built in; leave --calibration away",
                            choice.file.string(), to_string(model)));
  }
  if (!choice.file.empty()) {
    if (ruby128) return ruby128::read_ruby128_csv(choice.file);
    if (is_robosense(model)) return robosense::read_unit_csv(choice.file, model);
    return hdl64e::load_hdl64e_calibration(choice.file);
  }
  auto calibration = from_packets();
  if (!calibration && ruby128 && choice.allows_nominal) return ruby128::nominal_ruby128();
  return calibration;
}

Expected<calib::SensorCalibration> unit_calibration(const CalibrationChoice& choice,
                                                    SensorModel model, CaptureSource& source) {
  return unit_calibration(choice, model, [&]() -> Expected<calib::SensorCalibration> {
    if (is_robosense(model)) return from_packets_of_robosense(source, model);
    if (model == SensorModel::kHdl64eS1) return fail_for_s1(source.name());
    if (is_ouster(model)) return fail_for_ouster(source.name());
    return from_packets_of_hdl64e(source);
  });
}

}  // namespace terracut::sensor
