// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "input.hpp"
#include "packet_account.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tests/support/hand_out.hpp"

namespace terracut::fuzz {

/// One decoder per input, small enough to run thousands of inputs a second, and what must hold
/// whatever it is fed: every return of a packet that was accepted is in a frame or counted as lost,
/// and every packet that was not is counted under its reason.
template <class Decoder, class Calibration>
class DecoderRun {
 public:
  /// `returns_in(payload)`: how many returns an accepted payload carries.
  using ReturnsIn = std::uint64_t (*)(std::span<const std::uint8_t> payload);

  /// No return can lie beyond `farthest_m`.
  DecoderRun(const Calibration& calibration, ReturnsIn returns_in, float farthest_m)
      : returns_in_(returns_in),
        farthest_m_(farthest_m),
        decoder_(calibration, {}, config(&motion_), memory_) {}

  [[nodiscard]] auto keep() {
    return [this](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
      require(info.number == frames_++);
      require(info.returns > 0 && info.returns == image.returns());
      require(image.returns() <= image.return_capacity());
      std::uint64_t in_cells = image.overflow().size();
      for (std::size_t cell = 0; cell < image.shape().cells(); ++cell) {
        if (!image.has_return(cell)) continue;
        ++in_cells;
        const auto stride = static_cast<std::size_t>(image.shape().stride());
        require(cell % stride < static_cast<std::size_t>(image.shape().columns));
        require(image.ground_range_m()[cell] >= 0.0F && image.ground_range_m()[cell] < farthest_m_);
        require(std::abs(image.z_m()[cell]) < farthest_m_);
      }
      require(in_cells == info.returns);
      handed_returns_ += info.returns;
    };
  }

  void feed(std::span<const std::uint8_t> payload) {
    account_.feed(
        decoder_,
        [&] {
          return test::decode(decoder_, packet::Datagram{.payload = payload, .stamp_ns = stamp_ns_},
                              keep());
        },
        [&] { return returns_in_(payload); });
  }
  /// The vehicle turns on the spot, which leaves distances as they are; at times nobody knows.
  void advance(std::int64_t ns) {
    stamp_ns_ += ns;
    motion_.add({stamp_ns_, 0, 1});
  }
  void flush() {
    account_.flush(decoder_, [&] { test::end_stream(decoder_, keep()); });
  }

  void check() const {
    const frame::LossCounters losses = decoder_.losses();
    account_.require_all_returns(handed_returns_ + losses.overflow_full_returns +
                                 losses.late_returns);
    require(decoder_.frames() == frames_);
  }

 private:
  static typename Decoder::Config config(vehicle::EgoMotion* motion) {
    typename Decoder::Config config;
    config.motion = motion;
    config.columns = 64;
    config.returns_per_cell = 3;
    return config;
  }
  ReturnsIn returns_in_;
  float farthest_m_;
  memory::FixedMemory memory_;
  vehicle::EgoMotion motion_{{.waiting = 16, .kept = 16}, memory_};
  Decoder decoder_;
  std::int64_t stamp_ns_ = 1'000'000'000;
  PacketAccount account_;
  std::uint64_t handed_returns_ = 0;
  std::uint32_t frames_ = 0;
};

}  // namespace terracut::fuzz
