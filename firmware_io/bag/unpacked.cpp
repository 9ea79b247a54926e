// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/bag/unpacked.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <memory>
#include <system_error>

#include "rt/files/plain_file.hpp"

namespace terracut::bag {
namespace {

struct FreeStream {
  void operator()(ZSTD_DStream* stream) const noexcept { ZSTD_freeDStream(stream); }
};
using Stream = std::unique_ptr<ZSTD_DStream, FreeStream>;

/// Limits the window that a frame may ask for, and with it the memory of its decoder: 128 MiB.
Stream zstd_stream() {
  constexpr int kMostWindowLog = 27;
  Stream stream(ZSTD_createDStream());
  ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, kMostWindowLog);
  return stream;
}

tl::unexpected<Error> too_large() {
  return fail(ErrorCode::kMalformed, fmt::format("unpacks to more than {} MiB", kMostBytes >> 20));
}

Status unpack_zstd(std::span<const std::byte> packed, std::vector<std::byte>& plain) {
  constexpr std::size_t kStep = std::size_t{1} << 20;
  const Stream stream = zstd_stream();
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::size_t filled = 0, left = 1;
  while (left != 0 || in.pos < in.size) {
    if (filled == plain.size()) {
      if (filled == kMostBytes) return too_large();
      plain.resize(std::min(kMostBytes, filled + std::max(kStep, filled)));
    }
    ZSTD_outBuffer out{plain.data(), plain.size(), filled};
    const std::size_t read_before = in.pos;
    left = ZSTD_decompressStream(stream.get(), &out, &in);
    const bool stands_still = out.pos == filled && in.pos == read_before;
    filled = out.pos;
    if (ZSTD_isError(left) != 0 || (left != 0 && stands_still && in.pos == in.size)) {
      plain.resize(filled);
      return fail(ErrorCode::kMalformed,
                  fmt::format("zstd: {}", ZSTD_isError(left) != 0 ? ZSTD_getErrorName(left)
                                                                  : "the data end too early"));
    }
  }
  plain.resize(filled);
  return {};
}

tl::unexpected<Error> refused(ErrorCode code, const char* what) {
  return fail(code, fmt::format("{}: {}", what, std::generic_category().message(errno)));
}

Status write_all(int to, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ::ssize_t written = ::write(to, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return refused(ErrorCode::kWriteFailed, "its unpacked copy");
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return {};
}

}  // namespace

bool begins_as_zstd(std::span<const std::byte> bytes) noexcept {
  constexpr std::array kMagic{std::byte{0x28}, std::byte{0xB5}, std::byte{0x2F}, std::byte{0xFD}};
  return bytes.size() >= kMagic.size() && std::ranges::equal(bytes.first(kMagic.size()), kMagic);
}

Status unpack(std::string_view compression, std::span<const std::byte> packed,
              std::vector<std::byte>& plain) {
  plain.clear();
  if (compression == "zstd") return unpack_zstd(packed, plain);
  if (compression == "lz4") return unpack_lz4(packed, plain);
  return fail(ErrorCode::kUnsupported, "its compression is none of zstd and lz4");
}

Status unpack_zstd_file(const std::filesystem::path& from, int to) {
  constexpr std::uint64_t kMostTimesLarger = 100, kAlwaysAllowed = std::uint64_t{1} << 20;
  const auto file = files::open_plain_file(from);
  if (!file) return tl::unexpected(file.error());
  const Stream stream = zstd_stream();
  std::vector<std::byte> packed(ZSTD_DStreamInSize()), plain(ZSTD_DStreamOutSize());
  std::uint64_t read = 0, written = 0;
  std::size_t left = 0;
  for (;;) {
    const ::ssize_t got = ::read(file->get(), packed.data(), packed.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return refused(ErrorCode::kUnreadable, "reading it");
    if (got == 0) break;
    read += static_cast<std::uint64_t>(got);
    ZSTD_inBuffer in{packed.data(), static_cast<std::size_t>(got), 0};
    for (bool is_full = true; in.pos < in.size || is_full;) {
      ZSTD_outBuffer out{plain.data(), plain.size(), 0};
      left = ZSTD_decompressStream(stream.get(), &out, &in);
      if (ZSTD_isError(left) != 0) {
        return fail(ErrorCode::kMalformed, fmt::format("zstd: {}", ZSTD_getErrorName(left)));
      }
      is_full = out.pos == out.size;
      written += out.pos;
      if (written > kAlwaysAllowed + kMostTimesLarger * read) {
        return fail(ErrorCode::kMalformed, "unpacks to more than a hundred times its size");
      }
      const Status done = write_all(to, std::span(plain).first(out.pos));
      if (!done) return done;
    }
  }
  // A file that was cut off is read up to there: its reader says that it breaks off.
  return {};
}

}  // namespace terracut::bag
