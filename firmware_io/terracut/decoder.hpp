// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "terracut/calibration.hpp"
#include "terracut/error.hpp"
#include "terracut/frame.hpp"

namespace terracut {

/// The payload of one UDP datagram.
struct Packet {
  std::span<const std::uint8_t> payload;
  std::int64_t stamp_ns = 0;  ///< When it was received, nanoseconds since 1970 (UTC).
};

/// Packets in, frames of points out, without labels. Fixed memory: push() and next() allocate
/// nothing, lock nothing and throw nothing. One thread.
///
///   decoder.push(packet);
///   while (const Frame* frame = decoder.next()) ...
class Decoder {
 public:
  struct Config {
    int reorder_packets = 2;  ///< So many packets late still find their frame; latency of as many.
  };

  /// kInvalidArgument on a setting or mount out of range, kCapacityExceeded without memory.
  [[nodiscard]] static Expected<Decoder> make(const Calibration& calibration, const Mount& mount,
                                              const Config& config);
  [[nodiscard]] static Expected<Decoder> make(const Calibration& calibration,
                                              const Mount& mount = {}) {
    return make(calibration, mount, Config{});
  }
  Decoder(Decoder&&) noexcept;
  Decoder& operator=(Decoder&&) noexcept;
  ~Decoder();

  /// The payload must stay until next() has returned null. What is no data packet of the sensor is
  /// counted and left out.
  void push(const Packet& packet) noexcept;
  /// The stream ends: what is open is handed out.
  void end_stream() noexcept;
  /// The next frame that is complete, or null. Call it until then; valid until the next call.
  [[nodiscard]] const Frame* next() noexcept;

  /// Packets taken as data, and left out, so far.
  [[nodiscard]] std::uint64_t packets_decoded() const noexcept;
  [[nodiscard]] std::uint64_t packets_rejected() const noexcept;

 private:
  struct Engine;
  explicit Decoder(std::unique_ptr<Engine> engine) noexcept;
  std::unique_ptr<Engine> engine_;
};

/// The datagrams of a capture file (pcap, pcapng) that one sensor sent, in file order.
class Capture {
 public:
  /// Finds the sensor and, where its packets tell it, its calibration. kNotFound, kUnreadable,
  /// kMalformed, kUnsupported (no sensor that can be decoded), kInvalidArgument (several sensors).
  [[nodiscard]] static Expected<Capture> open(const std::filesystem::path& file);
  Capture(Capture&&) noexcept;
  Capture& operator=(Capture&&) noexcept;
  ~Capture();

  [[nodiscard]] Sensor sensor() const noexcept;
  /// kNoCalibration where the packets do not hold it whole.
  [[nodiscard]] const Expected<Calibration>& calibration() const noexcept;

  /// The next packet, whose payload is valid until the next call; nothing at the end. An error
  /// where the file breaks off.
  [[nodiscard]] Expected<std::optional<Packet>> next();

 private:
  struct Engine;
  explicit Capture(std::unique_ptr<Engine> engine) noexcept;
  std::unique_ptr<Engine> engine_;
};

}  // namespace terracut
