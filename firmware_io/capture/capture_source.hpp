// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "firmware_io/bag/bag_packets.hpp"
#include "firmware_io/capture/fragment_joiner.hpp"
#include "firmware_io/capture/pcap_file.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/udp_frame.hpp"
#include "rt/error.hpp"

namespace terracut::capture {

/// Selects datagrams of a capture; an empty filter passes all. Most fields are those of Datagram.
struct CaptureFilter {
  std::optional<std::uint16_t> port{};            ///< UDP destination port.
  std::optional<std::uint32_t> source_address{};  ///< IPv4 of the sender, host byte order.
  std::optional<std::uint16_t> source_port{};
  std::optional<std::uint64_t> source_mac{};
  std::optional<std::uint32_t> destination_address{};
  std::optional<std::uint32_t> vlan{};  ///< 0: only datagrams outside any VLAN.
  /// A further condition, tested last; empty: none.
  std::function<bool(const packet::Datagram&)> is_of_stream{};
  std::string topic{};  ///< Of a bag; empty: its only one with packets.
};

/// Counts the frames of a capture; frames == delivered + joined + left_out().
struct CaptureCounters {
  std::uint64_t frames = 0;     ///< Records read from the file; of a bag, packets.
  std::uint64_t delivered = 0;  ///< Datagrams returned by next().
  /// IP fragments of datagrams that a later fragment completed.
  std::uint64_t joined = 0;
  std::array<std::uint64_t, packet::kFrameRejects>
      refused{};                   ///< Frames without a UDP datagram, by reason.
  std::uint64_t other_port = 0;    ///< Datagrams to another port.
  std::uint64_t other_source = 0;  ///< Datagrams to the right port from another sender.
  /// Datagrams to the right port from the right sender that fail the filter's other conditions.
  std::uint64_t other_stream = 0;

  [[nodiscard]] std::uint64_t refused_total() const noexcept;
  [[nodiscard]] std::uint64_t left_out() const noexcept {
    return refused_total() + other_port + other_source + other_stream;
  }
};

/// Reads UDP datagrams of a capture file (pcap with micro- or nanosecond stamps in either byte
/// order, or pcapng), or the packets in a topic of a bag, in file order. Stamps are always
/// nanoseconds. Not thread-safe.
class CaptureSource {
 public:
  /// Opens the file. Fails with kNotFound, kUnreadable, kMalformed (an empty file or no capture;
  /// the message says what it looks like) or kUnsupported (a link layer without IP); for a bag, as
  /// bag::BagPackets::open() does.
  [[nodiscard]] static Expected<CaptureSource> open(std::filesystem::path path,
                                                    CaptureFilter filter = {});

  /// Reads from memory, which must outlive the source; `name` stands for the path in messages.
  [[nodiscard]] static Expected<CaptureSource> open_memory(std::span<const std::uint8_t> capture,
                                                           std::string name,
                                                           CaptureFilter filter = {});

  /// Returns the next datagram that passes the filter; nothing at the end. Frames without a UDP
  /// datagram are counted and skipped; fragments are put together. The payload is valid until the
  /// next call.
  ///
  /// Fails with kMalformed (or kUnsupported for interfaces of different link types in one pcapng)
  /// if the file breaks off: the message says after which packet and at which byte, and every
  /// further call fails in the same way. Everything returned before stays valid, so a replay may
  /// finish with a warning. Allocates nothing per packet, but for the first fragments.
  [[nodiscard]] Expected<std::optional<packet::Datagram>> next();

  /// Goes back to the first packet, by opening the file again. Counters keep their values.
  [[nodiscard]] Status rewind();

  [[nodiscard]] const CaptureCounters& counters() const noexcept { return counters_; }
  /// DLT_ number of libpcap; for a bag -1.
  [[nodiscard]] int link_type() const noexcept;
  /// "EN10MB"; for a bag "velodyne_msgs/msg/VelodyneScan in /velodyne_packets".
  [[nodiscard]] std::string link_name() const;
  [[nodiscard]] const std::string& name() const noexcept;

 private:
  using File = std::variant<PcapFile, bag::BagPackets>;

  CaptureSource(File file, CaptureFilter filter)
      : file_(std::move(file)), filter_(std::move(filter)) {}
  /// Checks the filter's conditions other than port and sender.
  [[nodiscard]] bool is_in_stream(const packet::Datagram& datagram) const;
  [[nodiscard]] static Expected<CaptureSource> over(Expected<PcapFile> file, CaptureFilter filter);
  /// Returns the next datagram of the file; of a frame without one, the reason.
  [[nodiscard]] Expected<std::optional<tl::expected<packet::Datagram, packet::FrameReject>>> read();

  /// Joins the fragment in a frame to those before it: returns the datagram, or kFragment.
  [[nodiscard]] tl::expected<packet::Datagram, packet::FrameReject> join(
      int link_type, std::span<const std::uint8_t> frame, std::int64_t stamp_ns);

  File file_;
  CaptureFilter filter_;
  CaptureCounters counters_;
  FragmentJoiner fragments_;
};

}  // namespace terracut::capture
