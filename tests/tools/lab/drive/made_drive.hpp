// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <type_traits>

#include "tools/lab/drive/drive_files.hpp"
#include "tools/lab/packets/encoder_traits.hpp"

/// Drives that were made, as whoever reads them finds them.
namespace terracut::test {

/// The table beside a drive, or the built-in one.
template <class EncoderTraits>
Expected<typename EncoderTraits::Calibration> table_beside(const std::filesystem::path& pcap) {
  if constexpr (EncoderTraits::kCalibrationSuffix.empty()) {
    return EncoderTraits::nominal();
  } else {
    return EncoderTraits::read_calibration(drive::calibration_path_of<EncoderTraits>(pcap));
  }
}

template <class EncoderTraits>
inline constexpr bool kIsRoboSense = std::is_same_v<EncoderTraits, packets::Ruby128EncoderTraits>;
template <class Model>
inline constexpr bool kIsRoboSense<packets::RoboSenseEncoderTraits<Model>> = true;

template <class EncoderTraits>
constexpr std::uint16_t data_port() {
  if (packets::kHasNumberedColumns<EncoderTraits>) return ouster::kDataPort;
  return kIsRoboSense<EncoderTraits> ? ruby128::kRubyDataPort : hdl64e::kHdl64eDataPort;
}

}  // namespace terracut::test
