// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <tl/expected.hpp>

#include "firmware_io/net/packet_ring.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "pipeline/recorder/dump_policy.hpp"
#include "pipeline/recorder/dump_record.hpp"
#include "pipeline/status/frame_record.hpp"
#include "rt/error.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::recorder {

/// The records of the last frames, whose times are written beside a dump.
struct DumpFrames {
  std::span<const status::FrameRecord> times;
  std::span<const std::string_view> stages;  ///< Names for FrameRecord::stage_cpu_ns.
};

/// Keeps the last seconds of datagrams in fixed memory and writes them to disk when something went
/// wrong: as a pcap, which `terracut replay` can play, with the times of the frames as JSON beside
/// it (`X.pcap` and `X.frames.json`).
///
/// Two threads: one adds, another one dumps. A dump first copies the ring to memory of its own (so
/// twice the ring's size is taken at start), then writes the copy, so that a stalled disk loses no
/// datagram.
class FlightRecorder {
 public:
  /// Takes all memory. Throws std::invalid_argument for a size of 0.
  FlightRecorder(const net::PacketRingSize& size, memory::FixedMemory& memory)
      : ring_(size, memory), window_(size, memory) {}

  /// Adds a datagram; for the receive thread. Wait-free, allocates nothing, touches no file.
  void add(const packet::Datagram& datagram) noexcept TERRACUT_NONBLOCKING { ring_.add(datagram); }

  /// Writes the capture and its times, each whole or not at all; no capture stays without its
  /// times. Not for real-time threads: blocks on the disk. Fails with kNothingCameOut if no
  /// datagram is held, else with the errors of PcapWriter.
  [[nodiscard]] Expected<DumpReport> dump(const std::filesystem::path& capture, DumpReason reason,
                                          const DumpFrames& frames);

  /// Dumps if `policy` allows a dump, to the path that `policy` gives; `policy` counts the outcome.
  [[nodiscard]] tl::expected<DumpReport, RefusedDump> dump(DumpPolicy& policy, DumpReason reason,
                                                           const DumpFrames& frames);

  [[nodiscard]] const net::PacketRing& ring() const noexcept { return ring_; }

 private:
  [[nodiscard]] DumpReport copy();
  [[nodiscard]] std::uint64_t capture_bytes() const noexcept;
  [[nodiscard]] Status write(DumpReport& report, std::string_view times) const;

  net::PacketRing ring_;
  net::PacketWindow window_;
};

}  // namespace terracut::recorder
