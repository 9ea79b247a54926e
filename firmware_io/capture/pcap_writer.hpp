// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "firmware_io/packet/datagram.hpp"
#include "rt/error.hpp"
#include "rt/files/part_file.hpp"

namespace terracut::capture {

/// Writes UDP datagrams to a pcap file with nanosecond stamps, as Ethernet / IPv4 / UDP frames that
/// tcpdump, Wireshark and every driver read: IP and UDP checksums are right, hardware addresses are
/// locally administered ones made from the IPv4 addresses.
///
/// Writes whole or not at all: the bytes go to a temporary name in the same folder; finish()
/// renames it. Without a successful finish() nothing is left behind, and a file that stood at the
/// path stays. Not thread-safe; blocks on the disk: not for real-time threads.
class PcapWriter {
 public:
  static constexpr std::size_t kMaxPayloadBytes = 65507;  ///< The largest UDP payload over IPv4.
  static constexpr std::size_t kFileHeaderBytes = 24;
  /// Bytes before each payload: record, Ethernet, IPv4 and UDP headers.
  static constexpr std::size_t kRecordHeaderBytes = 16 + 14 + 20 + 8;

  /// Creates the temporary file and missing parent folders. Fails with kInvalidArgument if `path`
  /// is something other than a file, kWriteFailed if the temporary file cannot be made.
  [[nodiscard]] static Expected<PcapWriter> create(std::filesystem::path path);

  PcapWriter(PcapWriter&& other) noexcept;
  PcapWriter& operator=(PcapWriter&& other) noexcept;
  ~PcapWriter();

  /// True if payload and stamp are in the ranges of write().
  [[nodiscard]] static bool can_write(const packet::Datagram& datagram) noexcept;

  /// Appends one frame. Stamps may be in any order, in [0, 2^32) seconds since 1970. Fails with
  /// kInvalidArgument for a stamp or payload out of range (the datagram is left out, the capture
  /// stays good), kWriteFailed if the disk refuses; then every further call fails and no file is
  /// left.
  [[nodiscard]] Status write(const packet::Datagram& datagram);

  /// Writes what is still buffered and renames the file to its path. Call this once; later calls
  /// fail.
  [[nodiscard]] Status finish();

  [[nodiscard]] std::uint64_t packets() const noexcept { return packets_; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  PcapWriter() = default;
  [[nodiscard]] Status flush();
  [[nodiscard]] Status failed(const char* step, int error_number);
  [[nodiscard]] Error closed() const;
  void discard() noexcept;

  std::filesystem::path path_;
  files::Part part_;
  std::vector<std::uint8_t> buffer_;
  std::uint64_t packets_ = 0;
};

}  // namespace terracut::capture
