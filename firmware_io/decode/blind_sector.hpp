// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware_io/decode/head_sector.hpp"
#include "firmware_io/decode/packet_heads.hpp"
#include "firmware_io/frame/frame_info.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::decode {

[[nodiscard]] inline frame::BlindAzimuths blind_azimuths(const HeadSector& sector) noexcept {
  return {beams::wrap_cdeg(sector.once.from_ticks / kTicksPerCdeg),
          beams::wrap_cdeg(sector.once.to_ticks / kTicksPerCdeg)};
}

/// Finds out where a sensor with a limited field of view is blind: it sends nothing while its head
/// passes there. What is missing at the same azimuths in three turns running is blind, once; what
/// is missing beside it, or not every turn, is lost.
///
/// A wide gap might be either until the head has been there again, so its loss is not counted at
/// once: either the third gap shows that it was none, or a packet from where the gap was, at the
/// latest a turn later, that it was. Where a known sector ends is known to the packet: those who
/// keep their rhythm while they are blind end it anywhere within a packet, others always alike.
///
/// Angles in ticks of head azimuth, unwrapped (head_sector.hpp). Fixed memory, O(1) a call,
/// noexcept. One thread.
class BlindSector {
 public:
  static constexpr int kTurnsToLearn = 3;

  explicit BlindSector(std::int64_t turn_ticks) noexcept : sector_{{}, turn_ticks} {}

  /// How far the head turns from packet to packet: on the average, and at most.
  struct Stride {
    std::int64_t mean_ticks = 1, widest_ticks = 1;
  };
  /// Lost for certain.
  struct Loss {
    std::int64_t packets = 0, ticks = 0;
  };
  struct Verdict {
    /// What was lost of a gap, and the blind sector where that lies in it; empty where all of it
    /// is blind.
    HeadInterval lost;
    bool is_pending = false;   ///< It may be blind; if not, take_due() will have the loss.
    std::int64_t packets = 0;  ///< Lost in it, unless it is pending.
  };
  /// Narrower gaps are never blind.
  [[nodiscard]] std::int64_t least_ticks() const noexcept { return sector_.turn_ticks / 72; }

  /// The head was not seen in `gap`, for so many packets by their stamps; in it came `rejected`
  /// ones.
  [[nodiscard]] Verdict judge(const HeadInterval& gap, std::int64_t packets, std::int64_t rejected,
                              const Stride& stride) noexcept TERRACUT_NONBLOCKING;
  /// A packet sweeps over `swept`; after judge() of the gap before it.
  void pass(const HeadInterval& swept) noexcept TERRACUT_NONBLOCKING;
  /// The sector lies in a packet as that says (PacketHeads::behind_sector), to the packet.
  [[nodiscard]] bool is_inside(const PacketHeads& heads) const noexcept TERRACUT_NONBLOCKING;
  /// Instead of pass(): a packet that begins where `begin_ticks` says, with the sector, or what was
  /// seen of it, inside.
  [[nodiscard]] Verdict cross(std::int64_t begin_ticks, const HeadInterval& inside,
                              const Stride& stride) noexcept TERRACUT_NONBLOCKING;
  /// A packet came late and fills a part of a gap.
  void fill(const HeadInterval& found) noexcept TERRACUT_NONBLOCKING;
  /// What pass() and judge() have found to be lost since it was last taken.
  [[nodiscard]] Loss take_due() noexcept TERRACUT_NONBLOCKING;
  /// The stream ends: what was pending is lost. The sector stays known.
  void end() noexcept TERRACUT_NONBLOCKING { refute(); }

  /// Where the next packet is expected to begin when the head was seen until `head_ticks`: there,
  /// or behind the blind sector where none has begun there in the turns before.
  [[nodiscard]] std::int64_t next_packet(std::int64_t head_ticks) const noexcept
      TERRACUT_NONBLOCKING;
  [[nodiscard]] const HeadSector& sector() const noexcept { return sector_; }

 private:
  struct Gap {
    HeadInterval head;
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
  void move_to(const HeadInterval& common) noexcept;
  [[nodiscard]] bool follows(const HeadInterval& gap) const noexcept;
  [[nodiscard]] bool is_between(const HeadInterval& gap) const noexcept;
  void remember(const Gap& gap) noexcept;
  void learn() noexcept;
  void refute() noexcept TERRACUT_NONBLOCKING;
  void count(const Gap& gap) noexcept;

  HeadSector sector_;
  /// Gaps without loss have begun so much earlier than the sector, and ended so much later.
  std::int64_t earliest_ticks_ = 0, latest_ticks_ = 0;
  std::array<Gap, kTurnsToLearn> gaps_;  ///< Of successive turns, the newest last; the others ...
  int gaps_known_ = 0;                   ///< ... before this many are not used.
  Loss due_;
};

}  // namespace terracut::decode
