// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "calib/nominal_ruby128.hpp"
#include "calib/ruby128_csv.hpp"
#include "calib/ruby128_geometry.hpp"
#include "firmware_io/drive/firing_order.hpp"
#include "firmware_io/drive/group_azimuths.hpp"
#include "firmware_io/drive/return_mode.hpp"
#include "firmware_io/labelled_return.hpp"
#include "firmware_io/ruby128/firing_azimuth.hpp"
#include "firmware_io/ruby128/packet_check.hpp"
#include "firmware_io/ruby128/packet_sender.hpp"

namespace terracut::firmware_io {

/// The RS-Ruby128 as makers of packets see it (drive/transmitter.hpp): three firings a packet, or
/// in dual return three firings in two packets, A A B and B C C.
struct Ruby128Transmitter {
  using Calibration = calib::Ruby128Calibration;
  using Geometry = calib::Ruby128Geometry;
  using Offsets = Ruby128BeamOffsets;
  using Column = Ruby128Column;
  using Sender = Ruby128PacketSender;

  struct Config {
    ReturnMode returns = ReturnMode::kSingle;
    RubyTimestamp timestamp = RubyTimestamp::kUtcMicroseconds;
    /// 0 lets decoders find out by the stamps themselves which encoding they are in.
    std::uint16_t protocol_version = 0;
    Ruby128Unit unit{};
  };

  static constexpr int kLasers = calib::kRuby128Lasers;
  static constexpr int kColumnsPerPacket = kRubyBlocksPerPacket;
  static constexpr bool kStrongestFirst = false;
  static constexpr double kBeamHalfWidth_rad = 1.25e-3;
  static constexpr std::string_view kCalibrationSuffix = ".calibration.csv";

  [[nodiscard]] static constexpr std::int64_t firing_ns(ReturnMode) noexcept {
    return kRubyBlock_ns;
  }
  [[nodiscard]] static constexpr FiringLimits limits(ReturnMode returns) noexcept {
    // Packets of dual return are joined by their stamps (HeldFiring), so those must be regular.
    constexpr std::int64_t kRegular_ns = kRubyBlock_ns * 3 / 2;
    constexpr std::int64_t kAnyTime_ns = 300'000'000;
    const bool dual = returns == ReturnMode::kDual;
    return {.firings_per_group = 3,
            .least_step_cdeg = dual ? kRubyMinSweep_cdeg : kRubyMinSweep_cdeg / 2,
            .most_step_cdeg = kRubyMaxStep_cdeg,
            .most_step_ns = dual ? kRegular_ns : kAnyTime_ns,
            .usual_step_ns = kRubyBlock_ns,
            .usual_step_cdeg = 20};
  }

  /// In dual return A and B stand in one packet and C beside B in the next, where B keeps its step.
  [[nodiscard]] static constexpr std::int32_t step_ticks(const GroupAzimuths& head_cdeg, int place,
                                                         ReturnMode returns) noexcept {
    const std::int32_t a = head_cdeg[0], b = head_cdeg[1], c = head_cdeg[2];
    if (returns == ReturnMode::kSingle) return ruby_step_ticks({a, b, c});
    return place < 2 ? ruby_step_ticks({a, a, b}) : ruby_step_ticks({b, c, c});
  }
  [[nodiscard]] static constexpr std::int32_t advance_ticks(std::int32_t step_ticks, int channel,
                                                            ReturnMode) noexcept {
    return ruby_advance_ticks(step_ticks, channel);
  }
  [[nodiscard]] static std::int32_t offset_ticks(const Offsets& offsets, std::int32_t step_ticks,
                                                 int channel, ReturnMode) noexcept {
    return offsets.offset_ticks(step_ticks, channel);
  }

  [[nodiscard]] static Offsets offsets(const Calibration& calibration, const Config&) {
    return Offsets(calibration);
  }
  [[nodiscard]] static Geometry geometry(const Calibration& calibration, const Config&) {
    return Geometry(calibration);
  }
  [[nodiscard]] static Expected<Sender> sender(const Calibration& calibration,
                                               const Config& config) {
    return Sender(calibration, config.unit,
                  {.returns = config.returns,
                   .timestamp = config.timestamp,
                   .protocol_version = config.protocol_version});
  }
  [[nodiscard]] static Calibration nominal() { return calib::nominal_ruby128(); }
  [[nodiscard]] static constexpr double metres_per_count(const Calibration&) noexcept {
    return calib::kRuby128MetresPerCount;
  }
  [[nodiscard]] static double widest_offset_rad(const Calibration& calibration) noexcept {
    double widest_rad = 0;
    for (const calib::Ruby128Channel& channel : calibration.channels) {
      widest_rad = std::max(widest_rad, std::abs(channel.azimuth_offset_rad));
    }
    return widest_rad;
  }

  [[nodiscard]] static Status write_calibration(const std::filesystem::path& path,
                                                const Calibration& calibration) {
    return calib::write_ruby128_csv(path, calibration);
  }
  [[nodiscard]] static Expected<Calibration> read_calibration(const std::filesystem::path& path) {
    return calib::read_ruby128_csv(path);
  }
};

}  // namespace terracut::firmware_io
