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
  std::int64_t stamp_ns = 0;  ///< Time of reception, nanoseconds since 1970 (UTC).
};

/// Turns packets into frames of points, without labels. Fixed memory: push() and next() allocate
/// nothing, lock nothing and throw nothing. One thread.
///
///   decoder.push(packet);
///   while (const Frame* frame = decoder.next()) ...
class Decoder {
 public:
  struct Config {
    /// A packet that comes up to this many packets late still reaches its frame; adds latency.
    int reorder_packets = 2;
  };

  /// Makes a decoder. Fails with kInvalidArgument if a setting or the mount is out of range,
  /// kCapacityExceeded if there is not enough memory.
  [[nodiscard]] static Expected<Decoder> make(const Calibration& calibration, const Mount& mount,
                                              const Config& config);
  [[nodiscard]] static Expected<Decoder> make(const Calibration& calibration,
                                              const Mount& mount = {}) {
    return make(calibration, mount, Config{});
  }
  Decoder(Decoder&&) noexcept;
  Decoder& operator=(Decoder&&) noexcept;
  ~Decoder();

  /// Takes a packet; its payload must stay valid until next() has returned null. Anything but the
  /// sensor's data packets is counted and left out.
  void push(const Packet& packet) noexcept;
  /// Ends the stream: next() then returns the frames still open.
  void end_stream() noexcept;
  /// Returns the next complete frame, or null. Call it until it returns null; a frame is valid
  /// until the next call.
  [[nodiscard]] const Frame* next() noexcept;

  /// These return how many packets were decoded and left out so far.
  [[nodiscard]] std::uint64_t packets_decoded() const noexcept;
  [[nodiscard]] std::uint64_t packets_rejected() const noexcept;

 private:
  struct Engine;
  explicit Decoder(std::unique_ptr<Engine> engine) noexcept;
  std::unique_ptr<Engine> engine_;
};

/// Reads the datagrams that one sensor sent from a capture file (pcap, pcapng), in file order.
class Capture {
 public:
  /// Finds the sensor and, if its packets contain it, its calibration. Fails with kNotFound,
  /// kUnreadable, kMalformed, kUnsupported (no sensor that can be decoded) or kInvalidArgument
  /// (several sensors).
  [[nodiscard]] static Expected<Capture> open(const std::filesystem::path& file);
  Capture(Capture&&) noexcept;
  Capture& operator=(Capture&&) noexcept;
  ~Capture();

  [[nodiscard]] Sensor sensor() const noexcept;
  /// Returns the calibration from the packets. Fails with kNoCalibration if they do not hold all of
  /// it.
  [[nodiscard]] const Expected<Calibration>& calibration() const noexcept;

  /// Returns the next packet, whose payload is valid until the next call; nothing at the end. Fails
  /// if the file breaks off.
  [[nodiscard]] Expected<std::optional<Packet>> next();

 private:
  struct Engine;
  explicit Capture(std::unique_ptr<Engine> engine) noexcept;
  std::unique_ptr<Engine> engine_;
};

}  // namespace terracut
