// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scan_way.hpp"

#include <fmt/format.h>

#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/lab/encode/scan_encoder.hpp"
#include "tools/lab/packets/hdl64e_packet_encoder.hpp"

namespace terracut::eval {

using encode::EncodedFiring;
using packets::FiringColumn;

namespace {

decode::Decoder::Config with_columns(int columns) {
  decode::Decoder::Config config;
  config.columns = columns;
  return config;
}

}  // namespace

DirectWay::DirectWay(const frame::ImageShape& shape, const mount::Mount& mount,
                     memory::FixedMemory& memory)
    : image_(shape, shape.cells(), memory), scan_to_image_(mount) {}

Expected<PlacedScan> DirectWay::place(std::span<const scan::ScanPoint> points,
                                      std::span<const std::int16_t> ring_of_point) {
  scan_to_image_.place(points, ring_of_point, image_);
  return PlacedScan{&image_, scan_to_image_.point_of_return(), 0};
}

PacketWay::PacketWay(const hdl64e::Hdl64eCalibration& calibration, const encode::RecordedSpin& spin,
                     const mount::Mount& mount, memory::FixedMemory& memory)
    : calibration_(calibration),
      spin_hz_(spin.spin_hz()),
      decoder_(calibration, mount, with_columns(spin.firings()), memory),
      points_(decoder_.point_image(memory)) {}

Status PacketWay::encode(std::span<const scan::ScanPoint> points,
                         std::span<const std::int16_t> ring_of_point) {
  constexpr auto kColumns = static_cast<std::size_t>(hdl64e::kColumnsPerPacketSingle);
  packets_.clear();
  point_of_return_.clear();
  std::vector<FiringColumn> columns;
  const auto send = [&] {
    hdl64e::wire::Packet packet = hdl64e::blank_packet();
    const std::span<const FiringColumn, kColumns> whole(columns.data(), kColumns);
    packets::encode_hdl64e_packet(whole, packets::packet_end_ns(whole), {}, packet);
    const auto bytes = hdl64e::payload_of(packet);
    packets_.emplace_back(bytes.begin(), bytes.end());
    columns.clear();
  };
  // Returns are numbered in order of arrival: by firing, then by laser.
  const auto take = [&](const EncodedFiring& firing) -> Status {
    for (const EncodedFiring::Source& source : firing.sources) {
      if (source.frame == 0) point_of_return_.push_back(source.point);
    }
    columns.push_back(firing.column);
    if (columns.size() == kColumns) send();
    return {};
  };
  constexpr std::int64_t kBegin_ns = 1'600'000'000'000'000'000;
  encode::ScanEncoder encoder(
      calibration_, {.frames = 1, .spin_hz = spin_hz_, .first_stamp_ns = kBegin_ns}, take);
  if (const Status added = encoder.add_frame(points, ring_of_point, {}); !added) return added;
  const auto summary = encoder.finish();
  return summary ? Status{} : tl::unexpected(summary.error());
}

Expected<PlacedScan> PacketWay::place(std::span<const scan::ScanPoint> points,
                                      std::span<const std::int16_t> ring_of_point) {
  if (const Status encoded = encode(points, ring_of_point); !encoded) {
    return tl::unexpected(encoded.error());
  }
  PlacedScan placed{nullptr, point_of_return_, 0};
  const auto take_frames = [&] {
    while (const frame::Frame* frame = decoder_.next()) {
      if (frame->info.returns != point_of_return_.size()) continue;
      placed.image = &points_.make(*frame->returns);
    }
  };
  const std::int64_t begun_ns = measure::thread_cpu_ns();
  for (const auto& packet : packets_) {
    decoder_.push({.payload = packet});
    take_frames();
  }
  decoder_.end_stream();
  take_frames();
  placed.decode_ns = measure::thread_cpu_ns() - begun_ns;
  if (placed.image == nullptr) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{} points were encoded, but the decoder made no frame of as many "
                            "returns",
                            point_of_return_.size()));
  }
  return placed;
}

}  // namespace terracut::eval
