// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/pcap_file.hpp"

#include <fmt/format.h>
#include <pcap/pcap.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>

#include "firmware_io/capture/file_kind.hpp"
#include "rt/files/ending.hpp"
#include "rt/files/plain_file.hpp"

namespace terracut::capture {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string reason_of(int error_number) {
  return std::generic_category().message(error_number);
}

Expected<File> open_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto kind = std::filesystem::status(path, error).type();
  if (kind == std::filesystem::file_type::not_found) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no such file; expected a pcap or pcapng capture", path.string()));
  }
  if (kind == std::filesystem::file_type::directory) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: is a folder; name the capture file inside it (`terracut segment` "
                            "labels folders of clouds)",
                            path.string()));
  }
  if (const Status twice = files::check_readable_twice(path); !twice) {
    return tl::unexpected(twice.error());
  }
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot be read: {}", path.string(), reason_of(errno)));
  }
  return file;
}

/// Returns the error for a file that libpcap refused; the message says what kind of file this is.
Error no_capture(const std::string& name, std::FILE* file, std::string_view libpcap_says) {
  std::array<std::uint8_t, 16> first{};
  std::rewind(file);
  const std::size_t count = std::fread(first.data(), 1, first.size(), file);
  if (count == 0) {
    return {ErrorCode::kMalformed,
            fmt::format("{}: is empty; expected a pcap or pcapng capture. Was the "
                        "recording or the copy interrupted?",
                        name)};
  }
  return {ErrorCode::kMalformed,
          fmt::format(
              "{}: is not a capture libpcap can read ({}); expected pcap or pcapng, found first "
              "bytes {}{}",
              name, libpcap_says, describe_first_bytes(std::span(first).first(count)),
              files::ending_of(name) == ".bin" ? ". A cloud by its name? `terracut segment` labels "
                                                 "clouds"
                                               : "")};
}

/// Converts a stamp to nanoseconds. With nanosecond precision tv_usec holds nanoseconds. libpcap
/// reads the unsigned seconds of a pcap as signed (from 2038 on); this is undone. Absurd pcapng
/// stamps are clamped instead of overflowing.
std::int64_t stamp_of(const timeval& stamp) noexcept {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  constexpr std::int64_t kLastSecond = 9'000'000'000;  // year 2255
  constexpr std::int64_t kWrap = std::int64_t{1} << 32;
  const std::int64_t signed_seconds = stamp.tv_sec;
  const bool wrapped = signed_seconds < 0 && signed_seconds >= -kWrap / 2;
  const std::int64_t seconds = wrapped ? signed_seconds + kWrap : signed_seconds;
  const std::int64_t fraction = stamp.tv_usec;
  if (seconds < 0 || fraction < 0) return 0;
  if (seconds > kLastSecond) return kLastSecond * kNanosecondsPerSecond;
  return seconds * kNanosecondsPerSecond + fraction % kNanosecondsPerSecond;
}

}  // namespace

void PcapFile::Close::operator()(::pcap* handle) const noexcept {
  ::pcap_close(handle);
}

Expected<PcapFile> PcapFile::open(std::filesystem::path path) {
  PcapFile file;
  file.name_ = path.string();
  file.path_ = std::move(path);
  if (Status opened = file.reopen(); !opened) return tl::unexpected(opened.error());
  return file;
}

Expected<PcapFile> PcapFile::open_memory(std::span<const std::uint8_t> capture, std::string name) {
  PcapFile file;
  file.name_ = std::move(name);
  file.memory_ = capture;
  if (Status opened = file.reopen(); !opened) return tl::unexpected(opened.error());
  return file;
}

std::string PcapFile::link_name() const {
  const char* name = ::pcap_datalink_val_to_name(link_type_);
  return fmt::format("{} ({})", name == nullptr ? "unknown" : name, link_type_);
}

Status PcapFile::reopen() {
  handle_.reset();
  records_this_pass_ = 0;
  is_at_end_ = false;
  break_off_.reset();

  File file;
  if (!path_.empty()) {
    Expected<File> opened = open_file(path_);
    if (!opened) return tl::unexpected(opened.error());
    file = std::move(*opened);
  } else {
    if (memory_.empty()) {
      return fail(ErrorCode::kMalformed, fmt::format("{}: is empty; expected a capture", name_));
    }
    // The file is opened for reading only, so the bytes stay unchanged.
    file.reset(::fmemopen(const_cast<std::uint8_t*>(memory_.data()), memory_.size(), "r"));
    if (!file) {
      return fail(ErrorCode::kUnreadable, fmt::format("{}: {}", name_, reason_of(errno)));
    }
  }

  std::array<char, PCAP_ERRBUF_SIZE> message{};
  handle_.reset(::pcap_fopen_offline_with_tstamp_precision(file.get(), PCAP_TSTAMP_PRECISION_NANO,
                                                           message.data()));
  if (!handle_) return tl::unexpected(no_capture(name_, file.get(), message.data()));
  static_cast<void>(file.release());  // pcap_close() closes it

  link_type_ = ::pcap_datalink(handle_.get());
  return {};
}

Error PcapFile::broken_off(const char* reason) {
  const long offset = std::ftell(::pcap_file(handle_.get()));
  const std::string_view text = reason;
  const bool mixed = text.find("different from the type of the first interface") != text.npos ||
                     text.find("different from the snapshot length") != text.npos;
  std::string what = fmt::format("{}: breaks off after packet {} (read up to byte {}): {}", name_,
                                 records_this_pass_, offset, text);
  if (mixed) {
    what +=
        "; libpcap reads one kind of interface a file. Write each interface to a file of its own: "
        "tshark -r FILE -Y frame.interface_id==0 -F nsecpcap -w one.pcap";
  } else {
    what += "; the packets before it are good. Was the recording or the copy interrupted?";
  }
  return {mixed ? ErrorCode::kUnsupported : ErrorCode::kMalformed, std::move(what)};
}

Expected<std::optional<PcapRecord>> PcapFile::next() {
  if (break_off_) return tl::unexpected(*break_off_);
  if (is_at_end_) return std::nullopt;
  ::pcap_pkthdr* header = nullptr;
  const unsigned char* data = nullptr;
  const int result = ::pcap_next_ex(handle_.get(), &header, &data);
  if (result == PCAP_ERROR_BREAK) {
    is_at_end_ = true;
    return std::nullopt;
  }
  if (result != 1) {
    break_off_ = broken_off(::pcap_geterr(handle_.get()));
    return tl::unexpected(*break_off_);
  }
  ++records_this_pass_;
  return PcapRecord{{data, header->caplen}, stamp_of(header->ts)};
}

Status PcapFile::rewind() {
  if (Status opened = reopen(); !opened) {
    break_off_ = opened.error();
    return opened;
  }
  return {};
}

}  // namespace terracut::capture
