// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "calib/beams/angle.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"

/// Computes the azimuths of the RS-Ruby128's beams when its channels fire, in whole numbers (see
/// firmware_io/packet/beam_azimuth.hpp).
///
/// A block carries one azimuth for 128 channels: the head's at the block's first firing. Channels
/// fire in groups of four, both halves of 64 in parallel; meanwhile the head rotates on by almost a
/// column:
///
///   head at the firing of channel c = azimuth of its block + advance(c)
///   beam of channel c               = head at its firing   + azimuth offset(c)
///
/// both clockwise from straight ahead. The step from firing to firing is taken from the packet's
/// own azimuths, so nothing depends on a nominal spin rate. Allocation-free, noexcept; any thread.
namespace terracut::ruby128 {

// --- Times (docs/reference/sensors.md; a public decoder of the maker) ---

/// Time between two firings of all channels.
inline constexpr std::int32_t kRubyBlock_ns = 55'550;
/// Time from one group of channels to the next.
inline constexpr std::int32_t kRubyGroup_ns = 3'236;
inline constexpr int kRubyGroups = 16;
/// Channels in a group, for each half of the channels.
inline constexpr int kRubyChannelsPerGroup = 4;

/// Returns the group in which a channel, [0, 128), fires.
[[nodiscard]] constexpr int ruby_group(int channel) noexcept {
  return channel / kRubyChannelsPerGroup % kRubyGroups;
}
/// Returns the time from the first firing of a block to that of `channel`.
[[nodiscard]] constexpr std::int32_t ruby_channel_ns(int channel) noexcept {
  return kRubyGroup_ns * ruby_group(channel);
}
static_assert(ruby_channel_ns(63) == 48'540 && ruby_channel_ns(64) == 0);

// --- Blocks of a packet ---

/// To which firings the three blocks of a packet belong. In dual return the two returns of a firing
/// are adjacent blocks, so every second pair is split between packets: A A B, then B C C.
enum class RubyBlocks : std::uint8_t { kSingle, kPairFirst, kPairLast };

/// Finds the order of blocks from the azimuths of a rotating head. Three equal azimuths give
/// kPairFirst, but such a head stands still.
[[nodiscard]] constexpr RubyBlocks ruby_blocks(
    const std::array<std::int32_t, kRubyBlocksPerPacket>& azimuth_cdeg) noexcept {
  if (azimuth_cdeg[0] == azimuth_cdeg[1]) return RubyBlocks::kPairFirst;
  return azimuth_cdeg[1] == azimuth_cdeg[2] ? RubyBlocks::kPairLast : RubyBlocks::kSingle;
}

/// Returns the number of firings from a packet's first block to the next packet's. A firing whose
/// second return is in the next packet counts with that packet.
[[nodiscard]] constexpr int ruby_firings(RubyBlocks blocks) noexcept {
  switch (blocks) {
    case RubyBlocks::kPairFirst:
      return 1;
    case RubyBlocks::kPairLast:
      return 2;
    case RubyBlocks::kSingle:
      break;
  }
  return 3;
}

/// Returns how far the head rotates from firing to firing, ticks, from the packet's azimuths.
/// Exact.
[[nodiscard]] constexpr std::int32_t ruby_step_ticks(
    const std::array<std::int32_t, kRubyBlocksPerPacket>& azimuth_cdeg) noexcept {
  const std::int32_t firings_apart = ruby_blocks(azimuth_cdeg) == RubyBlocks::kSingle ? 2 : 1;
  return beams::step_cdeg(azimuth_cdeg[0], azimuth_cdeg[2]) *
         (packet::kTicksPerCdeg / firings_apart);
}

/// Remembers a firing whose second return is in the next packet. Both returns of one pulse must
/// point the same way, so the second return gets the step of the first.
class HeldFiring {
 public:
  /// Returns the step for the first block of a packet whose own step is `step_ticks`. `stamp_us` is
  /// the packet's device stamp; `has_sector` says that a blind sector lies in the packet
  /// (PacketAzimuths), which delays the next stamp. Call this once for every packet, in order of
  /// arrival.
  [[nodiscard]] constexpr std::int32_t join(
      const std::array<std::int32_t, kRubyBlocksPerPacket>& azimuth_cdeg, std::int32_t step_ticks,
      std::int64_t stamp_us, bool has_sector) noexcept {
    const RubyBlocks blocks = ruby_blocks(azimuth_cdeg);
    const std::int64_t since_us = stamp_us - stamp_us_;
    const bool is_next = since_us >= 0 && (since_us <= kLongest_us || had_sector_);
    const bool joins =
        held_ && blocks == RubyBlocks::kPairLast && azimuth_cdeg[0] == azimuth_cdeg_ && is_next;
    const std::int32_t first_step_ticks = joins ? step_ticks_ : step_ticks;
    held_ = blocks == RubyBlocks::kPairFirst;
    azimuth_cdeg_ = azimuth_cdeg[2];
    step_ticks_ = step_ticks;
    stamp_us_ = stamp_us;
    had_sector_ = has_sector;
    return first_step_ticks;
  }
  constexpr void reset() noexcept { held_ = false; }

 private:
  /// Longest time between the stamps of packets that share a firing: two firings, plus rounding of
  /// stamps to microseconds and jitter.
  static constexpr std::int64_t kLongest_us = 2 * kRubyBlock_ns / 1000 + 10;

  bool held_ = false, had_sector_ = false;
  std::int32_t azimuth_cdeg_ = 0, step_ticks_ = 0;
  std::int64_t stamp_us_ = 0;
};

// --- Beams ---

/// A firing share is the part of the firing period after which a channel fires, in units of 1 /
/// 2^20.
inline constexpr int kRubyShareBits = 20;

/// Returns how far the head has rotated, in ticks, from its block's azimuth when `channel` fires.
[[nodiscard]] constexpr std::int32_t ruby_advance_ticks(std::int32_t step_ticks,
                                                        int channel) noexcept {
  const std::int64_t share =
      (std::int64_t{ruby_channel_ns(channel)} << kRubyShareBits) / kRubyBlock_ns;
  return static_cast<std::int32_t>((step_ticks * share) >> kRubyShareBits);
}

/// Returns a channel's azimuth offset rounded to ticks, as all azimuths in whole numbers use it.
[[nodiscard]] inline std::int32_t azimuth_offset_ticks(const Ruby128Channel& channel) noexcept {
  return static_cast<std::int32_t>(std::lround(channel.azimuth_offset_rad / packet::kRadPerTick));
}

/// The offsets of all 128 beams of one unit from their block's azimuth.
class Ruby128BeamOffsets {
 public:
  explicit Ruby128BeamOffsets(const Ruby128Calibration& calibration) noexcept {
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
      ticks_[i] = azimuth_offset_ticks(calibration.channels[i]);
    }
    const auto [least, most] = std::minmax_element(ticks_.begin(), ticks_.end());
    least_ticks_ = *least;
    most_ticks_ = *most;
  }

  [[nodiscard]] std::int32_t offset_ticks(std::int32_t step_ticks, int channel) const noexcept {
    return ruby_advance_ticks(step_ticks, channel) + ticks_[static_cast<std::size_t>(channel)];
  }
  /// hindmost_ticks() and foremost_ticks() return the least and the greatest offset of all beams.
  [[nodiscard]] std::int32_t hindmost_ticks() const noexcept { return least_ticks_; }
  [[nodiscard]] std::int32_t foremost_ticks(std::int32_t step_ticks) const noexcept {
    return step_ticks + most_ticks_;
  }

 private:
  std::array<std::int32_t, kRuby128Lasers> ticks_{};
  std::int32_t least_ticks_ = 0, most_ticks_ = 0;
};

}  // namespace terracut::ruby128
