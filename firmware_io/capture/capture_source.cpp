// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/capture_source.hpp"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <numeric>
#include <utility>

#include "firmware_io/bag/bag.hpp"

namespace terracut::capture {
namespace {

Status check_link_type(const PcapFile& file) {
  if (packet::is_supported_link_type(file.link_type())) return {};
  return fail(
      ErrorCode::kUnsupported,
      fmt::format("{}: link layer {} carries no UDP that terracut reads; expected Ethernet, Linux "
                  "cooked (v1, v2), raw IP, IPv4, NULL or LOOP",
                  file.name(), file.link_name()));
}

}  // namespace

std::uint64_t CaptureCounters::refused_total() const noexcept {
  return std::accumulate(refused.begin(), refused.end(), std::uint64_t{0});
}

Expected<CaptureSource> CaptureSource::open(std::filesystem::path path, CaptureFilter filter) {
  if (!bag::is_bag(path)) return over(PcapFile::open(std::move(path)), std::move(filter));
  auto packets = bag::BagPackets::open(path, filter.topic);
  if (!packets) return tl::unexpected(packets.error());
  return CaptureSource(*std::move(packets), std::move(filter));
}

Expected<CaptureSource> CaptureSource::open_memory(std::span<const std::uint8_t> capture,
                                                   std::string name, CaptureFilter filter) {
  return over(PcapFile::open_memory(capture, std::move(name)), std::move(filter));
}

Expected<CaptureSource> CaptureSource::over(Expected<PcapFile> file, CaptureFilter filter) {
  if (!file) return tl::unexpected(file.error());
  if (Status valid = check_link_type(*file); !valid) return tl::unexpected(valid.error());
  return CaptureSource(*std::move(file), std::move(filter));
}

Expected<std::optional<tl::expected<packet::Datagram, packet::FrameReject>>> CaptureSource::read() {
  if (auto* const packets = std::get_if<bag::BagPackets>(&file_)) {
    const auto packet = packets->next();
    if (!packet) return tl::unexpected(packet.error());
    if (!*packet) return std::nullopt;
    return **packet;
  }
  auto& file = std::get<PcapFile>(file_);
  const auto record = file.next();
  if (!record) return tl::unexpected(record.error());
  if (!*record) return std::nullopt;
  const auto datagram =
      packet::parse_udp_frame(file.link_type(), (*record)->bytes, (*record)->stamp_ns);
  if (datagram || datagram.error() != packet::FrameReject::kFragment) return datagram;
  return join(file.link_type(), (*record)->bytes, (*record)->stamp_ns);
}

tl::expected<packet::Datagram, packet::FrameReject> CaptureSource::join(
    int link_type, std::span<const std::uint8_t> frame, std::int64_t stamp_ns) {
  const auto fragment = packet::parse_ip_fragment(link_type, frame);
  if (!fragment) return tl::unexpected(packet::FrameReject::kShortCapture);
  const auto joined = fragments_.add(*fragment);
  if (!joined) return tl::unexpected(packet::FrameReject::kFragment);
  // The fragments before this one were counted as refused until now.
  const std::uint64_t before = joined->fragments - 1;
  counters_.refused[static_cast<std::size_t>(packet::FrameReject::kFragment)] -= before;
  counters_.joined += before;
  return packet::parse_udp(joined->whole, stamp_ns);
}

Expected<std::optional<packet::Datagram>> CaptureSource::next() {
  for (;;) {
    const auto read = this->read();
    if (!read) return tl::unexpected(read.error());
    if (!*read) return std::nullopt;
    ++counters_.frames;
    const auto& datagram = **read;
    if (!datagram) {
      ++counters_.refused[static_cast<std::size_t>(datagram.error())];
    } else if (filter_.port && datagram->destination_port != *filter_.port) {
      ++counters_.other_port;
    } else if (filter_.source_address && datagram->source_address != *filter_.source_address) {
      ++counters_.other_source;
    } else if (!is_in_stream(*datagram)) {
      ++counters_.other_stream;
    } else {
      ++counters_.delivered;
      return *datagram;
    }
  }
}

bool CaptureSource::is_in_stream(const packet::Datagram& datagram) const {
  const auto is_it = [](const auto& wanted, auto value) { return !wanted || *wanted == value; };
  return is_it(filter_.source_port, datagram.source_port) &&
         is_it(filter_.source_mac, datagram.source_mac) &&
         is_it(filter_.destination_address, datagram.destination_address) &&
         is_it(filter_.vlan, datagram.vlan) &&
         (!filter_.is_of_stream || filter_.is_of_stream(datagram));
}

Status CaptureSource::rewind() {
  fragments_.clear();
  Status rewound = std::visit([](auto& file) { return file.rewind(); }, file_);
  const auto* const file = std::get_if<PcapFile>(&file_);
  return rewound && file != nullptr ? check_link_type(*file) : rewound;
}

int CaptureSource::link_type() const noexcept {
  const auto* const file = std::get_if<PcapFile>(&file_);
  return file == nullptr ? -1 : file->link_type();
}

std::string CaptureSource::link_name() const {
  if (const auto* const packets = std::get_if<bag::BagPackets>(&file_)) {
    return packets->topic().type + " in " + packets->topic().name;
  }
  const char* const name = ::pcap_datalink_val_to_name(link_type());
  return name == nullptr ? "unknown" : name;
}

const std::string& CaptureSource::name() const noexcept {
  return std::visit([](const auto& file) -> const std::string& { return file.name(); }, file_);
}

}  // namespace terracut::capture
