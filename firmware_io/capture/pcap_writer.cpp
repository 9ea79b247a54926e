// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/pcap_writer.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <initializer_list>
#include <system_error>
#include <utility>

#include "firmware_io/packet/udp_checksum.hpp"

namespace terracut::capture {
namespace {

constexpr std::size_t kFlushAtBytes = std::size_t{256} * 1024;
constexpr std::size_t kEthernetBytes = 14;
constexpr std::size_t kIpBytes = 20;
constexpr std::size_t kUdpBytes = 8;
constexpr std::size_t kHeaderBytes = kEthernetBytes + kIpBytes + kUdpBytes;
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::int64_t kStampLimit_ns = (std::int64_t{1} << 32) * kNanosecondsPerSecond;

void append(std::vector<std::uint8_t>& bytes, std::initializer_list<std::uint8_t> values) {
  bytes.insert(bytes.end(), values);
}
void append_little_u32(std::vector<std::uint8_t>& bytes, std::uint64_t value) {
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift & 0xFF));
  }
}
void append_big_u16(std::vector<std::uint8_t>& bytes, std::uint64_t value) {
  append(bytes,
         {static_cast<std::uint8_t>(value >> 8 & 0xFF), static_cast<std::uint8_t>(value & 0xFF)});
}
void append_big_u32(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  append_big_u16(bytes, value >> 16);
  append_big_u16(bytes, value & 0xFFFF);
}

/// Appends the MAC address made from an IPv4 address: 02:00 (locally administered) and the IPv4
/// address, or the broadcast address for x.x.x.255.
void append_hardware_address(std::vector<std::uint8_t>& bytes, std::uint32_t address) {
  if ((address & 0xFF) == 0xFF) {
    append(bytes, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF});
    return;
  }
  append(bytes, {0x02, 0x00});
  append_big_u32(bytes, address);
}

void append_file_header(std::vector<std::uint8_t>& bytes) {
  constexpr std::uint32_t kNanosecondMagic = 0xA1B23C4D;
  constexpr std::uint32_t kSnapshotBytes = 262144;
  constexpr std::uint32_t kEthernetLink = 1;
  append_little_u32(bytes, kNanosecondMagic);
  append(bytes, {2, 0, 4, 0});  // version 2.4
  append_little_u32(bytes, 0);  // stamps are UTC
  append_little_u32(bytes, 0);
  append_little_u32(bytes, kSnapshotBytes);
  append_little_u32(bytes, kEthernetLink);
}

void append_record(std::vector<std::uint8_t>& bytes, const packet::Datagram& datagram) {
  const std::size_t frame_bytes = kHeaderBytes + datagram.payload.size();
  append_little_u32(bytes, static_cast<std::uint64_t>(datagram.stamp_ns / kNanosecondsPerSecond));
  append_little_u32(bytes, static_cast<std::uint64_t>(datagram.stamp_ns % kNanosecondsPerSecond));
  append_little_u32(bytes, frame_bytes);
  append_little_u32(bytes, frame_bytes);

  append_hardware_address(bytes, datagram.destination_address);
  append_hardware_address(bytes, datagram.source_address);
  append(bytes, {0x08, 0x00});

  const std::size_t ip_at = bytes.size();
  append(bytes, {0x45, 0x00});
  append_big_u16(bytes, kIpBytes + kUdpBytes + datagram.payload.size());
  append(bytes, {0, 0, 0x40, 0, 64, 17, 0, 0});  // no id, do not fragment, 64 hops, UDP, checksum
  append_big_u32(bytes, datagram.source_address);
  append_big_u32(bytes, datagram.destination_address);
  const std::uint16_t ip_sum = packet::internet_checksum(std::span(bytes).subspan(ip_at, kIpBytes));
  bytes[ip_at + 10] = static_cast<std::uint8_t>(ip_sum >> 8);
  bytes[ip_at + 11] = static_cast<std::uint8_t>(ip_sum & 0xFF);

  append_big_u16(bytes, datagram.source_port);
  append_big_u16(bytes, datagram.destination_port);
  append_big_u16(bytes, kUdpBytes + datagram.payload.size());
  append_big_u16(bytes, packet::udp_checksum(datagram));
  bytes.insert(bytes.end(), datagram.payload.begin(), datagram.payload.end());
}

}  // namespace

bool PcapWriter::can_write(const packet::Datagram& datagram) noexcept {
  return datagram.payload.size() <= kMaxPayloadBytes && datagram.stamp_ns >= 0 &&
         datagram.stamp_ns < kStampLimit_ns;
}

Expected<PcapWriter> PcapWriter::create(std::filesystem::path path) {
  std::error_code error;
  const auto standing = std::filesystem::status(path, error).type();
  if (standing != std::filesystem::file_type::not_found &&
      standing != std::filesystem::file_type::regular) {
    return fail(
        ErrorCode::kInvalidArgument,
        fmt::format("{}: exists and is not a file; name a capture file to write", path.string()));
  }
  if (path.has_parent_path()) {
    std::filesystem::create_directories(path.parent_path(), error);
  }
  PcapWriter writer;
  writer.part_ = files::make_part_file(path);
  writer.path_ = std::move(path);
  if (!writer.part_.lock) {
    const int error_number = errno;
    return tl::unexpected(
        writer.failed("creating a temporary file beside it", error_number).error());
  }
  writer.buffer_.reserve(kFlushAtBytes + kHeaderBytes + kMaxPayloadBytes + 16);
  append_file_header(writer.buffer_);
  return writer;
}

PcapWriter::PcapWriter(PcapWriter&& other) noexcept {
  *this = std::move(other);
}

PcapWriter& PcapWriter::operator=(PcapWriter&& other) noexcept {
  if (this != &other) {
    discard();
    path_ = std::move(other.path_);
    part_ = std::move(other.part_);
    buffer_ = std::move(other.buffer_);
    packets_ = other.packets_;
  }
  return *this;
}

PcapWriter::~PcapWriter() {
  discard();
}

void PcapWriter::discard() noexcept {
  if (!part_.lock) return;
  ::unlink(part_.path.c_str());
  part_.lock.close();
}

Status PcapWriter::failed(const char* step, int error_number) {
  discard();
  return fail(
      ErrorCode::kWriteFailed,
      fmt::format("{}: could not be written: {}: {}; nothing was left in its place. Check the "
                  "folder, its rights and the free space",
                  path_.string(), step, std::generic_category().message(error_number)));
}

Error PcapWriter::closed() const {
  return {
      ErrorCode::kWriteFailed,
      fmt::format("{}: the capture was finished, or had failed, before this call", path_.string())};
}

Status PcapWriter::flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ::ssize_t written =
        ::write(part_.lock.get(), buffer_.data() + done, buffer_.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return failed("writing", errno);
    done += static_cast<std::size_t>(written);
  }
  buffer_.clear();
  return {};
}

Status PcapWriter::write(const packet::Datagram& datagram) {
  if (!part_.lock) return tl::unexpected(closed());
  if (datagram.payload.size() > kMaxPayloadBytes) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: packet {}: {} bytes of payload; a UDP datagram holds at most {}",
                            path_.string(), packets_, datagram.payload.size(), kMaxPayloadBytes));
  }
  if (datagram.stamp_ns < 0 || datagram.stamp_ns >= kStampLimit_ns) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: packet {}: stamp {} ns; a pcap holds 0 (1970) up to {} ns (2106)",
                            path_.string(), packets_, datagram.stamp_ns, kStampLimit_ns - 1));
  }
  append_record(buffer_, datagram);
  ++packets_;
  if (buffer_.size() >= kFlushAtBytes) return flush();
  return {};
}

Status PcapWriter::finish() {
  if (!part_.lock) return tl::unexpected(closed());
  if (Status flushed = flush(); !flushed) return flushed;
  // Some file systems report a full disk only at close(). So a copy of the descriptor is closed;
  // the original holds the lock until the end.
  if (::close(::dup(part_.lock.get())) != 0) return failed("closing", errno);
  if (::rename(part_.path.c_str(), path_.c_str()) != 0) {
    return failed("renaming the temporary file to it", errno);
  }
  part_.lock.close();
  return {};
}

}  // namespace terracut::capture
