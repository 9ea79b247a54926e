// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_stream.hpp"

#include <boost/asio/write.hpp>

#include <string_view>
#include <utility>

namespace terracut::cli {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

/// The head of an answer without a length: its body ends with the connection.
constexpr std::string_view kHead =
    "HTTP/1.1 200 OK\r\n"
    "Content-Type: application/octet-stream\r\n"
    "Cache-Control: no-store\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Connection: close\r\n\r\n";

}  // namespace

FrameStream::FrameStream(HttpStream stream, ViewSource& source, Streamed what)
    : stream_(std::move(stream)), source_(source), what_(what) {
  ++source_.streams;
}

FrameStream::~FrameStream() {
  --source_.streams;
}

void FrameStream::begin() {
  is_sending_ = true;
  asio::async_write(stream_, asio::buffer(kHead),
                    [self = shared_from_this()](error_code error, std::size_t) {
                      if (error) return self->stream_.close();
                      self->is_sending_ = false;
                      self->send_next();
                    });
  notice_end();
}

void FrameStream::send_next() {
  if (is_sending_) return;
  const bool by_sectors = what_ == Streamed::kSectors;
  const ViewFrames::Message next =
      by_sectors ? source_.frames.sector_after(seen_) : source_.frames.newest();
  if (next.number == seen_) return;
  const std::uint64_t skipped = seen_ == 0 ? 0 : next.number - seen_ - 1;
  (by_sectors ? source_.sectors_skipped : source_.skipped) += skipped;
  seen_ = next.number;
  kept_ = next.kept;
  const std::uint32_t missed = header_.missed + static_cast<std::uint32_t>(skipped);
  header_ = kept_->header;
  header_.missed = missed;
  const bool is_compared = what_ == Streamed::kComparedFrames && !kept_->comparison.empty();
  if (is_compared) header_.flags |= kFrameCompared;
  is_sending_ = true;
  const std::array<asio::const_buffer, 3> parts{
      asio::buffer(&header_, sizeof(header_)), asio::buffer(kept_->points),
      asio::buffer(kept_->comparison.data(), is_compared ? kept_->comparison.size() : 0)};
  asio::async_write(stream_, parts, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->stream_.close();
    self->is_sending_ = false;
    self->kept_ = nullptr;
    ++self->source_.sent;
    self->send_next();
  });
}

void FrameStream::notice_end() {
  stream_.async_read_some(asio::buffer(heard_),
                          [self = shared_from_this()](error_code error, std::size_t) {
                            if (error) return self->stream_.close();
                            self->notice_end();
                          });
}

}  // namespace terracut::cli
