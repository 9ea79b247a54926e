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

/// Finds out where a sensor with a limited field of view is blind: it sends nothing while its head
/// passes there. What is missing at the same azimuths in three frames running is blind, once; what
/// is missing beside it, or not every frame, is lost.
///
/// A wide gap might be either until the head has been there again, so its loss is not counted at
/// once: either the third gap shows that it was none, or a packet from where the gap was, at the
/// latest a frame later, that it was. Where a known sector ends is known to the packet: those who
/// keep their rhythm while they are blind end it anywhere within a packet, others always alike.
///
/// Angles in ticks of head azimuth, unwrapped (rotor_sector.hpp). Fixed memory, O(1) a call,
/// noexcept. One thread.
class BlindSector {
 public:
  static constexpr int kFramesToLearn = 3;

  explicit BlindSector(std::int64_t revolution_ticks) noexcept : sector_{{}, revolution_ticks} {}

  /// How far the head rotates from packet to packet: on the average, and at most.
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
    packet::RotorInterval lost;
    bool is_pending = false;   ///< It may be blind; if not, take_due() will have the loss.
    std::int64_t packets = 0;  ///< Lost in it, unless it is pending.
  };
  /// Narrower gaps are never blind.
  [[nodiscard]] std::int64_t least_ticks() const noexcept { return sector_.revolution_ticks / 72; }

  /// The head was not seen in `gap`, for so many packets by their stamps; in it came `rejected`
  /// ones.
  [[nodiscard]] Verdict judge(const packet::RotorInterval& gap, std::int64_t packets,
                              std::int64_t rejected,
                              const Stride& stride) noexcept TERRACUT_NONBLOCKING;
  /// A packet sweeps over `swept`; after judge() of the gap before it.
  void pass(const packet::RotorInterval& swept) noexcept TERRACUT_NONBLOCKING;
  /// The sector lies in a packet as that says (PacketAzimuths::behind_sector), to the packet.
  [[nodiscard]] bool is_inside(const packet::PacketAzimuths& azimuths) const noexcept
      TERRACUT_NONBLOCKING;
  /// Instead of pass(): a packet that begins where `begin_ticks` says, with the sector, or what was
  /// seen of it, inside.
  [[nodiscard]] Verdict cross(std::int64_t begin_ticks, const packet::RotorInterval& inside,
                              const Stride& stride) noexcept TERRACUT_NONBLOCKING;
  /// A packet came late and fills a part of a gap, the first or the last of what is left of it but
  /// where several came late in no order.
  void fill(const packet::RotorInterval& found) noexcept TERRACUT_NONBLOCKING;
  /// What pass() and judge() have found to be lost since it was last taken.
  [[nodiscard]] Loss take_due() noexcept TERRACUT_NONBLOCKING;
  /// The stream ends: what was pending is lost. The sector stays known.
  void end() noexcept TERRACUT_NONBLOCKING { refute(); }

  /// Where the next packet is expected to begin when the head was seen until `rotor_ticks`: there,
  /// or behind the blind sector where none has begun there in the frames before.
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
  /// Gaps without loss have begun so much earlier than the sector, and ended so much later.
  std::int64_t earliest_ticks_ = 0, latest_ticks_ = 0;
  std::array<Gap, kFramesToLearn> gaps_;  ///< Of successive frames, the newest last; the others ...
  int gaps_known_ = 0;                    ///< ... before this many are not used.
  Loss due_;
};

}  // namespace terracut::decode
