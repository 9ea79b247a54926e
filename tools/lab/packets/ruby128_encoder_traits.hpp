// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "calib/beams/straight_geometry.hpp"
#include "calib/ruby128/nominal_ruby128.hpp"
#include "calib/ruby128/ruby128_csv.hpp"
#include "firmware_io/ruby128/firing_azimuth.hpp"
#include "tools/lab/packets/group_azimuths.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "tools/lab/packets/return_mode.hpp"
#include "tools/lab/packets/ruby128_packet_sender.hpp"

namespace terracut::packets {

/// The RS-Ruby128 for makers of packets (packets/encoder_traits.hpp): three firings per packet, or
/// in dual return three firings in two packets, A A B and B C C.
struct Ruby128EncoderTraits {
  using Calibration = ruby128::Ruby128Calibration;
  using Geometry = beams::StraightGeometry;
  using Offsets = ruby128::Ruby128BeamOffsets;
  using Column = packets::Ruby128Column;
  using Sender = Ruby128PacketSender;

  struct Config {
    ReturnMode returns = ReturnMode::kSingle;
    ruby128::RubyTimestamp timestamp = ruby128::RubyTimestamp::kUtcMicroseconds;
    /// With 0, decoders find out the stamps' encoding.
    std::uint16_t protocol_version = 0;
    Ruby128Unit unit{};
  };

  static constexpr int kLasers = ruby128::kRuby128Lasers;
  static constexpr bool kStrongestFirst = false;
  static constexpr bool kSecondIsLast = true;
  static constexpr double kBeamHalfWidth_rad = 1.25e-3;
  static constexpr std::string_view kCalibrationSuffix = ".calibration.csv";

  [[nodiscard]] static constexpr std::int64_t firing_ns(ReturnMode) noexcept {
    return ruby128::kRubyBlock_ns;
  }
  [[nodiscard]] static constexpr std::int64_t laser_period_ns(ReturnMode returns) noexcept {
    return firing_ns(returns);
  }
  [[nodiscard]] static constexpr int firings_per_group(ReturnMode) noexcept { return 3; }
  [[nodiscard]] static constexpr int columns_per_packet(ReturnMode) noexcept {
    return ruby128::kRubyBlocksPerPacket;
  }

  /// In dual return two packets hold the firings A A B and B C C; both returns of B have the step
  /// of the first packet.
  [[nodiscard]] static constexpr std::int32_t step_ticks(const GroupAzimuths& rotor, int place,
                                                         ReturnMode returns) noexcept {
    const std::int32_t a = rotor.cdeg[0], b = rotor.cdeg[1], c = rotor.cdeg[2];
    if (returns == ReturnMode::kSingle) return ruby128::ruby_step_ticks({a, b, c});
    return place < 2 ? ruby128::ruby_step_ticks({a, a, b}) : ruby128::ruby_step_ticks({b, c, c});
  }
  [[nodiscard]] static constexpr std::int32_t advance_ticks(std::int32_t step_ticks, int channel,
                                                            ReturnMode) noexcept {
    return ruby128::ruby_advance_ticks(step_ticks, channel);
  }
  [[nodiscard]] static std::int32_t offset_ticks(const Offsets& offsets, std::int32_t step_ticks,
                                                 int channel, ReturnMode) noexcept {
    return offsets.offset_ticks(step_ticks, channel);
  }

  [[nodiscard]] static Offsets offsets(const Calibration& calibration) {
    return Offsets(calibration);
  }
  [[nodiscard]] static Geometry geometry(const Calibration& calibration, const Config&) {
    return {calibration.channels, ruby128::kRuby128MetresPerCount, ruby128::kRuby128LensAhead_m};
  }
  [[nodiscard]] static Expected<Sender> sender(const Calibration& calibration,
                                               const Config& config) {
    return Sender(calibration, config.unit,
                  {.returns = config.returns,
                   .timestamp = config.timestamp,
                   .protocol_version = config.protocol_version});
  }
  [[nodiscard]] static Calibration nominal() { return ruby128::nominal_ruby128(); }
  [[nodiscard]] static constexpr double metres_per_count(const Calibration&) noexcept {
    return ruby128::kRuby128MetresPerCount;
  }
  [[nodiscard]] static double widest_offset_rad(const Calibration& calibration) noexcept {
    double widest_rad = 0;
    for (const ruby128::Ruby128Channel& channel : calibration.channels) {
      widest_rad = std::max(widest_rad, std::abs(channel.azimuth_offset_rad));
    }
    return widest_rad;
  }

  [[nodiscard]] static Status write_calibration(const std::filesystem::path& path,
                                                const Calibration& calibration) {
    return ruby128::write_ruby128_csv(path, calibration);
  }
  [[nodiscard]] static Expected<Calibration> read_calibration(const std::filesystem::path& path) {
    return ruby128::read_ruby128_csv(path);
  }
};

}  // namespace terracut::packets
