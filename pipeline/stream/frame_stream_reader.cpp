// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/frame_stream_reader.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "rt/threads/wake_event.hpp"

namespace terracut::stream {
namespace {

constexpr std::size_t kWidePointsAtOnce = 1024;

}  // namespace

Expected<FrameStreamReader> FrameStreamReader::connect(const StreamAddress& address) {
  files::OwnedDescriptor socket(
      ::socket(address.is_unix() ? AF_UNIX : AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const SocketAddress to = socket_address(address);
  if (!socket || ::connect(socket.get(), to.get(), to.size) != 0) {
    const int reason = errno;
    const bool nobody = reason == ECONNREFUSED || reason == ENOENT;
    return fail(nobody ? ErrorCode::kNotFound : ErrorCode::kUnreadable,
                fmt::format("no labelled frames from {}: {}; expected the address given to "
                            "`terracut live --stream`",
                            to_string(address), std::strerror(reason)));
  }
  return FrameStreamReader(std::move(socket));
}

Expected<bool> FrameStreamReader::next(ReceivedFrame& frame, std::int64_t patience_ns) {
  header_.resize(kFramePreambleBytes);
  const auto begun = fill(header_, patience_ns);
  if (!begun) return tl::unexpected(begun.error());
  if (*begun == 0) return false;
  const auto header_bytes = frame_header_bytes(std::span(header_).first(*begun));
  if (!header_bytes) return tl::unexpected(header_bytes.error());
  header_.resize(*header_bytes);
  const auto rest_of_header = std::span(header_).subspan(kFramePreambleBytes);
  if (Status status = fill_all(rest_of_header, patience_ns); !status) {
    return tl::unexpected(status.error());
  }
  const auto header = parse_frame_header(header_);
  if (!header) return tl::unexpected(header.error());
  frame.header = *header;
  frame.points.resize(header->points);
  if (header->point_bytes == sizeof(LabelledPoint)) {
    const auto bytes = std::as_writable_bytes(std::span(frame.points));
    if (Status status = fill_all(bytes, patience_ns); !status) {
      return tl::unexpected(status.error());
    }
    return true;
  }
  // Piece by piece, so that a header's word alone takes no more memory than points can need.
  for (std::size_t first = 0; first < frame.points.size(); first += kWidePointsAtOnce) {
    const auto piece =
        std::span(frame.points)
            .subspan(first, std::min(kWidePointsAtOnce, frame.points.size() - first));
    wide_points_.resize(piece.size() * header->point_bytes);
    if (Status status = fill_all(wide_points_, patience_ns); !status) {
      return tl::unexpected(status.error());
    }
    for (std::size_t n = 0; n < piece.size(); ++n) {
      std::memcpy(&piece[n], wide_points_.data() + n * header->point_bytes, sizeof(LabelledPoint));
    }
  }
  return true;
}

Expected<std::size_t> FrameStreamReader::fill(std::span<std::byte> bytes,
                                              std::int64_t patience_ns) {
  std::size_t got_bytes = 0;
  while (got_bytes < bytes.size()) {
    ::pollfd polled{socket_.get(), POLLIN, 0};
    const ::timespec patience = threads::timespec_of(patience_ns);
    const int ready = ::ppoll(&polled, 1, patience_ns < 0 ? nullptr : &patience, nullptr);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) {
      return fail(ErrorCode::kUnreadable,
                  fmt::format("no labelled frame came for {} ms", patience_ns / 1'000'000));
    }
    const ::ssize_t got =
        ::recv(socket_.get(), bytes.data() + got_bytes, bytes.size() - got_bytes, 0);
    if (got < 0) {
      if (errno == EINTR) continue;
      return fail(ErrorCode::kUnreadable,
                  fmt::format("the stream of labelled frames broke: {}", std::strerror(errno)));
    }
    if (got == 0) break;
    got_bytes += static_cast<std::size_t>(got);
  }
  return got_bytes;
}

Status FrameStreamReader::fill_all(std::span<std::byte> bytes, std::int64_t patience_ns) {
  const auto got_bytes = fill(bytes, patience_ns);
  if (!got_bytes) return tl::unexpected(got_bytes.error());
  if (*got_bytes < bytes.size()) {
    return fail(ErrorCode::kMalformed, "the stream of labelled frames ended within a frame");
  }
  return {};
}

}  // namespace terracut::stream
