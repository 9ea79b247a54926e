// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sequences of packets of Ouster's formats through a live run's whole chain; what the input bends
// of them: packet_sequence.hpp; what must hold: live_chain_run.hpp.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "any_ouster.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "packet_sequence.hpp"

namespace {

using namespace terracut;

template <int kRows, ouster::Profile kProfile>
struct Ouster {
  using Decoder = decode::Decoder;
  using Calibration = ouster::OusterCalibration;
  static constexpr ouster::PacketFormat kFormat{.profile = kProfile, .rows = kRows};
  struct Column {
    struct Beam {
      std::uint16_t raw;
      std::uint8_t intensity;
    };
    std::array<Beam, kRows> by_laser;
    std::int64_t stamp_ns, unwrapped_azimuth_cdeg;
  };
  using Bytes = std::array<std::uint8_t, kFormat.packet_bytes()>;
  static constexpr int kColumns = kFormat.columns;
  static constexpr std::size_t kReturnsAColumn = 6;
  static constexpr int kColumnsPerFrame = 1024;

  static Calibration calibration() {
    Calibration unit = ouster::nominal_ouster(ouster::model_of_rows(kRows));
    unit.format = kFormat;
    return unit;
  }
  static std::int64_t firing_ns(bool) { return 97'656; }
  static Bytes encode(const std::array<Column, kColumns>& columns, std::int64_t first_reading,
                      bool dual, int encoding) {
    (void)first_reading, (void)dual;  // the profile says how many returns a firing has
    Bytes bytes{};
    bytes[0] = kFormat.is_legacy() ? bytes[0] : 1;
    const std::int64_t azimuth_cdeg = beams::wrap_cdeg(columns[0].unwrapped_azimuth_cdeg);
    const auto first = static_cast<int>(azimuth_cdeg * kColumnsPerFrame / beams::kRevolution_cdeg) /
                       kColumns * kColumns;
    for (int column = 0; column < kColumns; ++column) {
      const Column& from = columns[static_cast<std::size_t>(column)];
      put(bytes, kFormat.column_at(column), static_cast<std::uint64_t>(from.stamp_ns), 8);
      put(bytes, kFormat.column_at(column) + 8, static_cast<std::uint64_t>(first + column), 2);
      // One encoding has a column that is not valid.
      bytes[kFormat.status_at(column)] = encoding == 2 && column == 5 ? 0 : 1;
      for (std::size_t laser = 0; laser < from.by_laser.size(); ++laser) {
        const std::size_t at = kFormat.channels_at(column) + laser * row().channel_bytes;
        put(bytes, at, from.by_laser[laser].raw & kRangeMask, 2);
        bytes[at + row().reflectivity_at] = from.by_laser[laser].intensity;
        if (row().second_at != 0) put(bytes, at + row().second_at, laser % 3, 2);
      }
    }
    return bytes;
  }
  static std::uint64_t returns_in(std::span<const std::uint8_t> payload) {
    if (payload.size() != kFormat.packet_bytes()) return 0;
    std::uint64_t returns = 0;
    for (int column = 0; column < kColumns; ++column) {
      if (!kFormat.head(payload.data(), column).is_valid) continue;
      const std::uint8_t* at = payload.data() + kFormat.channels_at(column);
      for (int laser = 0; laser < kRows; ++laser, at += row().channel_bytes) {
        returns += range_at(at) != 0;
        if (row().second_at != 0) returns += range_at(at + row().second_at) != 0;
      }
    }
    return returns;
  }

 private:
  static constexpr std::uint32_t kRangeMask = (1U << row_of(kProfile).range_bits) - 1;
  static constexpr const ouster::ProfileRow& row() { return row_of(kProfile); }
  static std::uint32_t range_at(const std::uint8_t* at) {
    return ouster::little_endian<std::uint32_t>(at) & kRangeMask;
  }
  static void put(Bytes& bytes, std::size_t at, std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i, value >>= 8) {
      bytes[at + static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(value & 0xFF);
    }
  }
};

template <int kRows>
void run_with(fuzz::Input& input) {
  using enum ouster::Profile;
  const auto run_of =
      [&]<ouster::Profile kProfile>(std::integral_constant<ouster::Profile, kProfile>) {
        fuzz::PacketSequence<Ouster<kRows, kProfile>>(input).run();
      };
  switch (fuzz::any_profile(input)) {
    case kLegacy:
      return run_of(std::integral_constant<ouster::Profile, kLegacy>{});
    case kSingle:
      return run_of(std::integral_constant<ouster::Profile, kSingle>{});
    case kDual:
      return run_of(std::integral_constant<ouster::Profile, kDual>{});
    case kLowRate:
      return run_of(std::integral_constant<ouster::Profile, kLowRate>{});
    case kLowRateDual:
      return run_of(std::integral_constant<ouster::Profile, kLowRateDual>{});
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  // 32 rows reach all that depends on their number, in a fraction of the time.
  run_with<32>(input);
  return 0;
}
