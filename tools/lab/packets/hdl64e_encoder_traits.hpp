// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "calib/hdl64e/hdl64e_geometry.hpp"
#include "calib/hdl64e/hdl64e_xml.hpp"
#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "tools/lab/packets/group_azimuths.hpp"
#include "tools/lab/packets/hdl64e_packet_sender.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "tools/lab/packets/return_mode.hpp"
#include "tools/lab/tables/hdl64e_xml_writer.hpp"

namespace terracut::packets {

/// The HDL-64E for makers of packets (packets/encoder_traits.hpp): six firings per packet, or in
/// dual return three with two returns each.
struct Hdl64eEncoderTraits {
  using Calibration = hdl64e::Hdl64eCalibration;
  using Geometry = hdl64e::Hdl64eGeometry;
  using Offsets = hdl64e::BeamOffsets;
  using Column = packets::FiringColumn;
  using Sender = Hdl64ePacketSender;

  struct Config {
    ReturnMode returns = ReturnMode::kSingle;
    hdl64e::GeometryModel geometry = hdl64e::GeometryModel::kManual;
  };

  static constexpr int kLasers = hdl64e::kHdl64eLasers;
  static constexpr bool kStrongestFirst = true;
  static constexpr bool kSecondIsLast = true;
  /// Half of the 2 mrad that the manual gives for the whole beam.
  static constexpr double kBeamHalfWidth_rad = 1.0e-3;
  static constexpr std::string_view kCalibrationSuffix = ".calibration.xml";

  [[nodiscard]] static constexpr const hdl64e::FiringTimes& times(ReturnMode returns) noexcept {
    return returns == ReturnMode::kDual ? hdl64e::kFiringTimesDual : hdl64e::kFiringTimesSingle48;
  }
  [[nodiscard]] static constexpr std::int64_t firing_ns(ReturnMode returns) noexcept {
    return times(returns).column_ns;
  }
  [[nodiscard]] static constexpr std::int64_t laser_period_ns(ReturnMode returns) noexcept {
    return firing_ns(returns);
  }
  [[nodiscard]] static constexpr int firings_per_group(ReturnMode returns) noexcept {
    return times(returns).columns_per_packet;
  }
  [[nodiscard]] static constexpr int columns_per_packet(ReturnMode) noexcept {
    return hdl64e::kColumnsPerPacketSingle;
  }

  [[nodiscard]] static constexpr std::int32_t step_ticks(const GroupAzimuths& rotor, int,
                                                         ReturnMode returns) noexcept {
    const auto last = static_cast<std::size_t>(times(returns).columns_per_packet - 1);
    return hdl64e::column_step_ticks(rotor.cdeg[0], rotor.cdeg[last], returns == ReturnMode::kDual);
  }
  [[nodiscard]] static constexpr std::int32_t advance_ticks(std::int32_t step_ticks, int laser,
                                                            ReturnMode returns) noexcept {
    return hdl64e::firing_advance_ticks(step_ticks, laser, returns == ReturnMode::kDual);
  }
  [[nodiscard]] static std::int32_t offset_ticks(const Offsets& offsets, std::int32_t step_ticks,
                                                 int laser, ReturnMode returns) noexcept {
    return offsets.offset_ticks(step_ticks, laser, returns == ReturnMode::kDual);
  }

  [[nodiscard]] static Offsets offsets(const Calibration& calibration) {
    return Offsets(calibration);
  }
  [[nodiscard]] static Geometry geometry(const Calibration& calibration, const Config& config) {
    return Geometry(calibration, config.geometry);
  }
  [[nodiscard]] static Expected<Sender> sender(const Calibration& calibration,
                                               const Config& config) {
    return Sender::create(calibration, config.returns);
  }
  [[nodiscard]] static Calibration nominal() { return hdl64e::nominal_hdl64e(); }
  [[nodiscard]] static double metres_per_count(const Calibration& calibration) noexcept {
    return calibration.distance_resolution_m;
  }
  [[nodiscard]] static double widest_offset_rad(const Calibration& calibration) noexcept {
    double widest_rad = 0;
    for (const hdl64e::Hdl64eLaser& laser : calibration.lasers) {
      widest_rad = std::max(widest_rad, std::abs(laser.rot_correction_rad));
    }
    return widest_rad;
  }

  [[nodiscard]] static Status write_calibration(const std::filesystem::path& path,
                                                const Calibration& calibration) {
    return hdl64e::write_hdl64e_xml(path, calibration);
  }
  [[nodiscard]] static Expected<Calibration> read_calibration(const std::filesystem::path& path) {
    return hdl64e::read_hdl64e_xml(path);
  }
};

}  // namespace terracut::packets
