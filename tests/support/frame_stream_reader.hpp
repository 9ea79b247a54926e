// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "pipeline/stream/labelled_frame_wire.hpp"
#include "pipeline/stream/stream_address.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::test {

struct ReceivedFrame {
  stream::FrameWireHeader header;
  std::vector<stream::WirePoint> points;
  std::vector<float> heights_m;        ///< Of points that have one.
  std::vector<std::uint32_t> objects;  ///< Of points that have one.
};

/// The other end of a FrameStreamServer, as a C++ program downstream may have it: senders with
/// longer headers or points are read too, and what this version does not know is skipped.
class FrameStreamReader {
 public:
  [[nodiscard]] static Expected<FrameStreamReader> connect(const stream::StreamAddress& address) {
    files::OwnedDescriptor socket(
        ::socket(address.is_unix() ? AF_UNIX : AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const stream::SocketAddress to = socket_address(address);
    if (!socket || ::connect(socket.get(), to.get(), to.size) != 0) {
      return fail(ErrorCode::kNotFound,
                  "no labelled frames from " + to_string(address) + ": " + std::strerror(errno));
    }
    return FrameStreamReader(std::move(socket));
  }
  explicit FrameStreamReader(files::OwnedDescriptor socket) noexcept : socket_(std::move(socket)) {}

  /// Asks for sectors as they come, in place of whole frames. What is on its way comes first.
  void ask_for_sectors() const {
    ::send(socket_.get(), stream::kSectorsPlease.data(), stream::kSectorsPlease.size(),
           MSG_NOSIGNAL);
  }

  /// The next whole frame, or sector. False: the sender ended the stream, after a whole frame.
  /// kUnreadable: nothing came for `patience_ms` (-1: wait as long as it takes), or the connection
  /// broke. kMalformed: the stream ended within a frame, or is none of this version.
  [[nodiscard]] Expected<bool> next(ReceivedFrame& frame, int patience_ms) {
    const auto begun = fill(std::as_writable_bytes(std::span(&frame.header, 1)), patience_ms);
    if (!begun || *begun == 0) return begun.map([](std::size_t) { return false; });
    const stream::FrameWireHeader& header = frame.header;
    const bool is_known = *begun == sizeof header && header.magic == stream::kFrameMagic &&
                          header.version == stream::kFrameWireVersion &&
                          header.header_bytes >= sizeof header &&
                          header.point_bytes >= sizeof(stream::WirePoint) &&
                          header.points <= stream::kMostFramePoints;
    if (!is_known) return fail(ErrorCode::kMalformed, "no header of a labelled frame");
    const std::size_t more_header = header.header_bytes - sizeof header;
    rest_.resize(more_header + std::size_t{header.points} * header.point_bytes);
    const auto got = fill(rest_, patience_ms);
    if (!got) return tl::unexpected(got.error());
    if (*got < rest_.size()) return fail(ErrorCode::kMalformed, "the stream ended within a frame");
    const bool has_heights = header.point_bytes >= stream::kPointBytesWithHeight;
    frame.points.resize(header.points);
    const bool has_objects = header.point_bytes >= stream::kPointBytesWithObject;
    frame.heights_m.resize(has_heights ? header.points : 0);
    frame.objects.resize(has_objects ? header.points : 0);
    for (std::size_t n = 0; n < frame.points.size(); ++n) {
      const std::byte* const at = rest_.data() + more_header + n * header.point_bytes;
      std::memcpy(&frame.points[n], at, sizeof(stream::WirePoint));
      if (!has_heights) continue;
      std::memcpy(&frame.heights_m[n], at + sizeof(stream::WirePoint), sizeof(float));
      if (!has_objects) continue;
      std::memcpy(&frame.objects[n], at + stream::kPointBytesWithHeight, sizeof(std::uint32_t));
    }
    return true;
  }

 private:
  /// How many bytes came before the stream ended: all, or fewer.
  [[nodiscard]] Expected<std::size_t> fill(std::span<std::byte> bytes, int patience_ms) {
    std::size_t filled = 0;
    while (filled < bytes.size()) {
      ::pollfd polled{socket_.get(), POLLIN, 0};
      if (::poll(&polled, 1, patience_ms) == 0) {
        return fail(ErrorCode::kUnreadable, "no labelled frame came in time");
      }
      const ::ssize_t got = ::recv(socket_.get(), bytes.data() + filled, bytes.size() - filled, 0);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return fail(ErrorCode::kUnreadable, std::strerror(errno));
      if (got == 0) break;
      filled += static_cast<std::size_t>(got);
    }
    return filled;
  }

  files::OwnedDescriptor socket_;
  std::vector<std::byte> rest_;
};

}  // namespace terracut::test
