// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware_io/frame/frame_info.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/rotor_sector.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::decode {

[[nodiscard]] inline frame::BlindAzimuths blind_azimuths(
    const packet::RotorSector& sector) noexcept {
  return {beams::wrap_cdeg(sector.once.from_ticks / packet::kTicksPerCdeg),
          beams::wrap_cdeg(sector.once.to_ticks / packet::kTicksPerCdeg)};
}

/// Finds the blind sector of a sensor with a limited field of view, which sends nothing while its
/// head passes that sector. Azimuths missing in three successive frames are blind; all others
/// missing are lost.
///
/// A wide gap is pending until the head passes there again: a packet from inside the gap means
/// loss, a third gap in a row a blind sector. The ends of a known sector are exact to one packet:
/// some sensors send on at a fixed rhythm, so that a gap ends anywhere within a packet; others
/// always end it at the same azimuth.
///
/// Angles are azimuths of the head in ticks, counted on over revolutions (rotor_sector.hpp). Fixed
/// memory, O(1) per call, noexcept. One thread.
class BlindSector {
 public:
  static constexpr int kFramesToLearn = 3;

  explicit BlindSector(std::int64_t revolution_ticks) noexcept : sector_{{}, revolution_ticks} {}

  /// Sets the sector where a sensor says that it is blind, in azimuths of any revolution, before
  /// its packets come; packets that contradict it change it as they do one that was learnt. Less
  /// than least_ticks() is none.
  void tell(const packet::RotorInterval& blind) noexcept {
    if (blind.ticks() >= least_ticks()) sector_.once = blind;
  }

  /// How far the head rotates from packet to packet: on average, and at most.
  struct Stride {
    std::int64_t mean_ticks = 1, widest_ticks = 1;
  };
  /// Packets and azimuth that are certainly lost.
  struct Loss {
    std::int64_t packets = 0, ticks = 0;
  };
  struct Verdict {
    /// The lost part of a gap. If the lost part includes a blind sector, the sector counts as lost,
    /// too. Empty if all of the gap is blind.
    packet::RotorInterval lost;
    bool is_pending = false;   ///< The gap may be blind; if not, take_due() returns the loss later.
    std::int64_t packets = 0;  ///< Packets lost in the gap; 0 while the gap is pending.
  };
  /// Returns the least width of a blind sector; narrower gaps are losses.
  [[nodiscard]] std::int64_t least_ticks() const noexcept { return sector_.revolution_ticks / 72; }

  /// Judges a gap, azimuths that no packet covered. By the device stamps, `packets` are missing in
  /// the gap; `rejected` of these arrived but were rejected.
  [[nodiscard]] Verdict judge(const packet::RotorInterval& gap, std::int64_t packets,
                              std::int64_t rejected,
                              const Stride& stride) noexcept TERRACUT_NONBLOCKING;
  /// Notes the azimuths `swept` that a packet covered. Call judge() for the gap before that packet
  /// first.
  void pass(const packet::RotorInterval& swept) noexcept TERRACUT_NONBLOCKING;
  /// True if the blind sector lies where PacketAzimuths::behind_sector says, to within a packet.
  [[nodiscard]] bool is_inside(const packet::PacketAzimuths& azimuths) const noexcept
      TERRACUT_NONBLOCKING;
  /// Replaces pass() for a packet that begins at `begin_ticks` and has the blind sector inside: the
  /// head fired nothing in the interval `inside`.
  [[nodiscard]] Verdict cross(std::int64_t begin_ticks, const packet::RotorInterval& inside,
                              const Stride& stride) noexcept TERRACUT_NONBLOCKING;
  /// Notes that a late packet fills part of the newest gap, which becomes narrower if the packet
  /// lies at one of its ends.
  void fill(const packet::RotorInterval& found) noexcept TERRACUT_NONBLOCKING;
  /// Returns and clears the losses that pass() and judge() have found since the last call.
  [[nodiscard]] Loss take_due() noexcept TERRACUT_NONBLOCKING;
  /// Ends the stream: pending gaps count as lost. The sector stays known.
  void end() noexcept TERRACUT_NONBLOCKING { refute(); }

  /// Returns where the next packet is expected to begin if the head was seen until `rotor_ticks`:
  /// at that azimuth, or after the blind sector if no packet began there in earlier frames.
  [[nodiscard]] std::int64_t next_packet(std::int64_t rotor_ticks) const noexcept
      TERRACUT_NONBLOCKING;
  [[nodiscard]] const packet::RotorSector& sector() const noexcept { return sector_; }

 private:
  struct Gap {
    packet::RotorInterval head;
    std::int64_t packets = 0, rejected = 0;
    Stride stride;
    bool is_pending = false;
  };

  [[nodiscard]] Verdict beside_sector(const Gap& gap) noexcept;
  [[nodiscard]] static bool is_within_packet(std::int64_t ticks, const Stride& stride) noexcept {
    return ticks * 20 < stride.widest_ticks * 19;
  }
  static void note_end(std::int64_t ticks, const Stride& stride,
                       std::int64_t& widest_ticks) noexcept;
  [[nodiscard]] std::int64_t packets_in(std::int64_t ticks, const Stride& stride) const noexcept;
  void move_to(const packet::RotorInterval& common) noexcept;
  [[nodiscard]] bool follows(const packet::RotorInterval& gap) const noexcept;
  [[nodiscard]] bool is_between(const packet::RotorInterval& gap) const noexcept;
  void remember(const Gap& gap) noexcept;
  void learn() noexcept;
  void refute() noexcept TERRACUT_NONBLOCKING;
  void count(const Gap& gap) noexcept;

  packet::RotorSector sector_;
  /// Of the gaps without loss, the earliest azimuth at which one began before the sector and the
  /// latest at which one ended after it.
  std::int64_t earliest_ticks_ = 0, latest_ticks_ = 0;
  std::array<Gap, kFramesToLearn> gaps_;  ///< Gaps of successive frames, newest last.
  int gaps_known_ = 0;                    ///< Number of valid elements at the end of gaps_.
  Loss due_;
};

}  // namespace terracut::decode
