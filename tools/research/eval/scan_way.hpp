// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/mount/mount.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "rt/error.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tools/lab/encode/recorded_spin.hpp"

namespace terracut::eval {

/// A scan as a range image, with the point of each return.
struct PlacedScan {
  const frame::RangeImage* image = nullptr;
  std::span<const std::uint32_t> point_of_return;  ///< One per return.
  std::int64_t decode_ns = 0;                      ///< Processor time; 0 without packets.
};

/// Places scans directly in the image.
class DirectWay {
 public:
  DirectWay(const frame::ImageShape& shape, const mount::Mount& mount, memory::FixedMemory& memory);

  [[nodiscard]] const frame::ImageShape& shape() const noexcept { return image_.shape(); }
  [[nodiscard]] std::size_t return_capacity() const noexcept { return image_.return_capacity(); }
  /// Places a scan; the result is valid until the next call. Never fails, unlike
  /// PacketWay::place().
  [[nodiscard]] Expected<PlacedScan> place(std::span<const scan::ScanPoint> points,
                                           std::span<const std::int16_t> ring_of_point);

 private:
  frame::RangeImage image_;
  scan::ScanToImage scan_to_image_;
};

/// Places scans through packets: encodes each as the packets of one frame, and decodes these.
class PacketWay {
 public:
  /// `spin` is the spin rate of the recording head.
  PacketWay(const hdl64e::Hdl64eCalibration& calibration, const encode::RecordedSpin& spin,
            const mount::Mount& mount, memory::FixedMemory& memory);

  [[nodiscard]] const frame::ImageShape& shape() const noexcept { return decoder_.shape(); }
  [[nodiscard]] std::size_t return_capacity() const noexcept { return decoder_.return_capacity(); }
  /// Places a scan; the result is valid until the next call. Fails with kMalformed if the decoder
  /// does not make exactly one frame of it.
  [[nodiscard]] Expected<PlacedScan> place(std::span<const scan::ScanPoint> points,
                                           std::span<const std::int16_t> ring_of_point);

 private:
  [[nodiscard]] Status encode(std::span<const scan::ScanPoint> points,
                              std::span<const std::int16_t> ring_of_point);

  hdl64e::Hdl64eCalibration calibration_;
  double spin_hz_;
  decode::Decoder decoder_;
  frame::PointImage points_;
  std::vector<std::vector<std::uint8_t>> packets_;
  std::vector<std::uint32_t> point_of_return_;
};

}  // namespace terracut::eval
