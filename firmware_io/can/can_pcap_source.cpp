// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/can/can_pcap_source.hpp"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <string_view>

#include "firmware_io/can/can_wire.hpp"

#ifndef DLT_LINUX_SLL2
#define DLT_LINUX_SLL2 276  // libpcap older than 1.10
#endif

namespace terracut::can {
namespace {

// Sizes of the header of a cooked capture, and where in it the big-endian protocol stands.
constexpr std::size_t kCookedBytes = 16, kCookedProtocolAt = 14;
constexpr std::size_t kCooked2Bytes = 20, kCooked2ProtocolAt = 0;
constexpr unsigned kCanProtocol = 0x000C, kCanFdProtocol = 0x000D;

bool has_can(int link_type) {
  return link_type == DLT_CAN_SOCKETCAN || link_type == DLT_LINUX_SLL ||
         link_type == DLT_LINUX_SLL2;
}

/// Returns the CAN frame that follows a cooked header; nothing if the header names another
/// protocol.
std::optional<std::span<const std::uint8_t>> behind_header(std::span<const std::uint8_t> bytes,
                                                           std::size_t header_bytes,
                                                           std::size_t protocol_at) {
  if (bytes.size() < header_bytes) return std::nullopt;
  const unsigned protocol = unsigned{bytes[protocol_at]} << 8 | bytes[protocol_at + 1];
  if (protocol != kCanProtocol && protocol != kCanFdProtocol) return std::nullopt;
  return bytes.subspan(header_bytes);
}

std::string_view describe(CanReject reject) {
  switch (reject) {
    case CanReject::kTruncated:
      return "it ends before its data do; was the capture made with a short snapshot length?";
    case CanReject::kLength:
      return "its length is more than such a frame can have";
    case CanReject::kId:
      return "its id has more than the 11 bits of its format";
    case CanReject::kXl:
      break;
  }
  return "it is a CAN XL frame";
}

}  // namespace

Expected<CanPcapSource> CanPcapSource::open(std::filesystem::path path) {
  return over(capture::PcapFile::open(std::move(path)));
}

Expected<CanPcapSource> CanPcapSource::open_memory(std::span<const std::uint8_t> capture,
                                                   std::string name) {
  return over(capture::PcapFile::open_memory(capture, std::move(name)));
}

Expected<CanPcapSource> CanPcapSource::over(Expected<capture::PcapFile> file) {
  if (!file) return tl::unexpected(file.error());
  if (!has_can(file->link_type())) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: link layer {} carries no CAN frames; expected a capture of a CAN "
                            "interface (227) or of all interfaces (113, 276)",
                            file->name(), file->link_name()));
  }
  return CanPcapSource(*std::move(file));
}

Expected<std::optional<CanFrame>> CanPcapSource::next() {
  for (;;) {
    const auto record = file_.next();
    if (!record) return tl::unexpected(record.error());
    if (!*record) return std::nullopt;
    ++counters_.records;
    // Byte order of the CAN id: libpcap writes it big-endian when it captures from one CAN
    // interface. In a cooked capture it has the order of the capturing machine, and libpcap swaps
    // it when a machine of the other order reads the file.
    auto bytes = std::optional((*record)->bytes);
    CanIdOrder order = CanIdOrder::kNative;
    if (file_.link_type() == DLT_CAN_SOCKETCAN) {
      order = CanIdOrder::kBigEndian;
    } else if (file_.link_type() == DLT_LINUX_SLL) {
      bytes = behind_header(*bytes, kCookedBytes, kCookedProtocolAt);
    } else {
      bytes = behind_header(*bytes, kCooked2Bytes, kCooked2ProtocolAt);
    }
    if (!bytes) {
      ++counters_.no_frame;
      continue;
    }
    auto frame = parse_can_wire(*bytes, order);
    if (frame) {
      ++counters_.delivered;
      frame->stamp_ns = (*record)->stamp_ns;
      return *frame;
    }
    if (frame.error() == CanReject::kXl) {
      ++counters_.no_frame;
      continue;
    }
    ++counters_.malformed;
    if (first_fault_.empty()) {
      first_fault_ = fmt::format("{}: record {}: {}", file_.name(), counters_.records,
                                 describe(frame.error()));
    }
  }
}

}  // namespace terracut::can
