// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "tests/support/hand_out.hpp"
#include "tools/lab/packets/hdl64e_packet_encoder.hpp"

namespace terracut::test {

using packets::FiringColumn;

/// One packet as it would be captured.
struct Packet {
  std::array<std::uint8_t, hdl64e::kHdl64ePacketBytes> bytes{};
  std::int64_t stamp_ns = 0;

  [[nodiscard]] packet::Datagram datagram() const {
    return {.payload = bytes, .stamp_ns = stamp_ns};
  }
  void set_u16(std::size_t offset, unsigned value) {
    bytes[offset] = static_cast<std::uint8_t>(value & 0xFF);
    bytes[offset + 1] = static_cast<std::uint8_t>(value >> 8);
  }
  void set_device_stamp_us(std::uint32_t stamp_us) {
    set_u16(1200, stamp_us & 0xFFFF);
    set_u16(1202, stamp_us >> 16);
  }
};

struct DriveSettings {
  std::int64_t first_cdeg = 34'900;              ///< Head azimuth of the first firing.
  std::int64_t last_cdeg = 37'100 + 2 * 36'000;  ///< No firing beyond.
  double step_deg = 0.1728;
  std::int64_t first_stamp_ns = 1'700'000'000'000'000'000;
  std::int64_t column_ns = 48'000;
  double share_of_returns = 0.9;
  unsigned seed = 1;
};

/// Firings of a steadily rotating head with random returns, a multiple of six.
inline std::vector<FiringColumn> random_firings(const DriveSettings& settings) {
  std::mt19937 random(settings.seed);
  std::uniform_real_distribution<double> chance(0, 1);
  std::uniform_int_distribution<int> distance(1, 65'535), byte(0, 255);
  std::vector<FiringColumn> firings;
  for (std::int64_t n = 0;; ++n) {
    const auto azimuth_cdeg =
        settings.first_cdeg +
        static_cast<std::int64_t>(static_cast<double>(n) * settings.step_deg * 100.0);
    if (azimuth_cdeg > settings.last_cdeg && n % 6 == 0) break;
    FiringColumn& firing = firings.emplace_back();
    firing.stamp_ns = settings.first_stamp_ns + n * settings.column_ns;
    firing.unwrapped_azimuth_cdeg = azimuth_cdeg;
    for (auto& beam : firing.by_laser) {
      if (chance(random) < settings.share_of_returns) {
        beam = {static_cast<std::uint16_t>(distance(random)),
                static_cast<std::uint8_t>(byte(random)), 0};
      }
    }
  }
  return firings;
}

inline std::vector<Packet> to_packets(std::span<const FiringColumn> firings) {
  std::vector<Packet> packets;
  for (std::size_t n = 0; n + 6 <= firings.size(); n += 6) {
    const auto six = firings.subspan(n).first<6>();
    hdl64e::wire::Packet buffer = hdl64e::blank_packet();
    Packet& packet = packets.emplace_back();
    packet.stamp_ns = packets::packet_end_ns(six);
    packets::encode_hdl64e_packet(six, packet.stamp_ns, {'T', 35}, buffer);
    std::ranges::copy(hdl64e::payload_of(buffer), packet.bytes.begin());
  }
  return packets;
}

inline std::vector<Packet> random_packets(const DriveSettings& settings = {}) {
  return to_packets(random_firings(settings));
}

/// A frame as the decoder handed it over, copied: its returns in order of arrival.
struct Frame {
  struct Placed {
    frame::Return point;
    std::uint32_t row = 0, column = 0;
    bool overflow = false;
  };
  frame::FrameInfo info;
  std::vector<Placed> returns;
};

inline Frame copy_of(const frame::FrameInfo& info, const frame::RangeImage& image) {
  Frame frame{info, std::vector<Frame::Placed>(image.returns())};
  const auto stride = static_cast<std::uint32_t>(image.shape().stride());
  for (std::size_t cell = 0; cell < image.shape().cells(); ++cell) {
    if (!image.has_return(cell)) continue;
    auto& placed = frame.returns.at(image.return_index()[cell]);
    placed.point = {image.x_m()[cell], image.y_m()[cell], image.z_m()[cell],
                    image.ground_range_m()[cell], image.intensity()[cell]};
    placed.row = static_cast<std::uint32_t>(cell) / stride;
    placed.column = static_cast<std::uint32_t>(cell) % stride;
  }
  for (const auto& spare : image.overflow()) {
    frame.returns.at(spare.return_index) = {spare.point, spare.cell / stride, spare.cell % stride,
                                            true};
  }
  return frame;
}

/// A decoder of the nominal unit that keeps every frame.
class Recorder {
 public:
  using Config = decode::Decoder::Config;
  explicit Recorder(const Config& config = {},
                    const hdl64e::Hdl64eCalibration& calibration = hdl64e::nominal_hdl64e(),
                    const mount::Mount& mount = {})
      : decoder(calibration, mount, config, memory) {}
  /// Of a stream that has ended.
  explicit Recorder(std::span<const Packet> packets, const Config& config = {},
                    const hdl64e::Hdl64eCalibration& calibration = hdl64e::nominal_hdl64e(),
                    const mount::Mount& mount = {})
      : Recorder(config, calibration, mount) {
    decode_all(packets);
    flush();
  }

  /// The callable to hand frames over to.
  [[nodiscard]] auto keep() {
    return [this](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
      frames.push_back(copy_of(info, image));
    };
  }
  std::optional<frame::Reject> decode(const Packet& packet) {
    return test::decode(decoder, packet.datagram(), keep());
  }
  void decode_all(std::span<const Packet> packets) {
    for (const Packet& packet : packets) decode(packet);
  }
  void flush() { test::end_stream(decoder, keep()); }

  [[nodiscard]] std::uint64_t rejected(frame::Reject reason) const {
    return decoder.losses().rejected[static_cast<std::size_t>(reason)];
  }
  [[nodiscard]] std::uint64_t returns() const {
    std::uint64_t sum = 0;
    for (const Frame& frame : frames) sum += frame.returns.size();
    return sum;
  }

  memory::FixedMemory memory;
  decode::Decoder decoder;
  std::vector<Frame> frames;
};

}  // namespace terracut::test
