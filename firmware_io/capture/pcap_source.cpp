// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/pcap_source.hpp"

#include <fmt/format.h>

#include <numeric>
#include <utility>

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

std::uint64_t PcapCounters::refused_total() const noexcept {
  return std::accumulate(refused.begin(), refused.end(), std::uint64_t{0});
}

Expected<PcapSource> PcapSource::open(std::filesystem::path path, PcapFilter filter) {
  return over(PcapFile::open(std::move(path)), std::move(filter));
}

Expected<PcapSource> PcapSource::open_memory(std::span<const std::uint8_t> capture,
                                             std::string name, PcapFilter filter) {
  return over(PcapFile::open_memory(capture, std::move(name)), std::move(filter));
}

Expected<PcapSource> PcapSource::over(Expected<PcapFile> file, PcapFilter filter) {
  if (!file) return tl::unexpected(file.error());
  if (Status valid = check_link_type(*file); !valid) return tl::unexpected(valid.error());
  return PcapSource(*std::move(file), std::move(filter));
}

Expected<std::optional<packet::Datagram>> PcapSource::next() {
  for (;;) {
    const auto record = file_.next();
    if (!record) return tl::unexpected(record.error());
    if (!*record) return std::nullopt;
    ++counters_.frames;
    const auto datagram =
        packet::parse_udp_frame(file_.link_type(), (*record)->bytes, (*record)->stamp_ns);
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

bool PcapSource::is_in_stream(const packet::Datagram& datagram) const {
  const auto is_it = [](const auto& wanted, auto value) { return !wanted || *wanted == value; };
  return is_it(filter_.source_port, datagram.source_port) &&
         is_it(filter_.source_mac, datagram.source_mac) &&
         is_it(filter_.destination_address, datagram.destination_address) &&
         is_it(filter_.vlan, datagram.vlan) &&
         (!filter_.is_of_stream || filter_.is_of_stream(datagram));
}

Status PcapSource::rewind() {
  if (Status rewound = file_.rewind(); !rewound) return rewound;
  return check_link_type(file_);
}

}  // namespace terracut::capture
