// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scan_way.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "firmware_io/hdl64e/packet_encoder.hpp"
#include "firmware_io/scan/scan_encoder.hpp"
#include "rt/thread_cpu_clock.hpp"

namespace terracut::evaluation {

using firmware_io::EncodedFiring;
using firmware_io::FiringColumn;

DirectWay::DirectWay(const calib::Hdl64eCalibration&, const calib::Mount& mount,
                     rt::FixedMemory& memory)
    : image_(pipeline::ImageShape{}, pipeline::ImageShape{}.cells(), memory),
      scan_to_image_(mount) {}

Expected<PlacedScan> DirectWay::place(std::span<const firmware_io::ScanPoint> points,
                                      std::span<const std::int16_t> ring_of_point) {
  scan_to_image_.place(points, ring_of_point, image_);
  return PlacedScan{&image_, scan_to_image_.point_of_return(), 0};
}

PacketWay::PacketWay(const calib::Hdl64eCalibration& calibration, const calib::Mount& mount,
                     rt::FixedMemory& memory)
    : calibration_(calibration), decoder_(calibration, mount, {}, memory) {}

Status PacketWay::encode(std::span<const firmware_io::ScanPoint> points,
                         std::span<const std::int16_t> ring_of_point) {
  constexpr auto kColumns = static_cast<std::size_t>(firmware_io::kColumnsPerPacketSingle);
  packets_.clear();
  point_of_return_.clear();
  std::vector<FiringColumn> columns;
  const auto send = [&] {
    firmware_io::Hdl64ePacketBuffer packet;
    const std::span<const FiringColumn, kColumns> whole(columns.data(), kColumns);
    firmware_io::encode_hdl64e_packet(whole, firmware_io::packet_end_ns(whole), {}, packet);
    const auto bytes = packet.payload();
    packets_.emplace_back(bytes.begin(), bytes.end());
    columns.clear();
  };
  // Returns are numbered in order of arrival: firing after firing, laser after laser.
  const auto take = [&](const EncodedFiring& firing) -> Status {
    for (const EncodedFiring::Source& source : firing.sources) {
      if (source.turn == 0) point_of_return_.push_back(source.point);
    }
    columns.push_back(firing.column);
    if (columns.size() == kColumns) send();
    return {};
  };
  constexpr std::int64_t kBegin_ns = 1'600'000'000'000'000'000;
  firmware_io::ScanEncoder encoder(calibration_, kBegin_ns, take);
  if (const Status added = encoder.add_turn(points, ring_of_point, {}); !added) return added;
  const auto summary = encoder.finish();
  return summary ? Status{} : tl::unexpected(summary.error());
}

Expected<PlacedScan> PacketWay::place(std::span<const firmware_io::ScanPoint> points,
                                      std::span<const std::int16_t> ring_of_point) {
  if (const Status encoded = encode(points, ring_of_point); !encoded) {
    return tl::unexpected(encoded.error());
  }
  PlacedScan placed{nullptr, point_of_return_, 0};
  const auto on_frame = [&](const firmware_io::FrameInfo& info,
                            const pipeline::RangeImage& image) noexcept {
    if (info.returns == point_of_return_.size()) placed.image = &image;
  };
  const std::int64_t begun_ns = rt::thread_cpu_ns();
  for (const auto& packet : packets_) (void)decoder_.decode({.payload = packet}, on_frame);
  decoder_.flush(on_frame);
  placed.decode_ns = rt::thread_cpu_ns() - begun_ns;
  if (placed.image == nullptr) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{} points were encoded, but the decoder made no frame of as many "
                            "returns",
                            point_of_return_.size()));
  }
  return placed;
}

}  // namespace terracut::evaluation
