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

FrameStream::FrameStream(HttpStream stream, ViewSource& source)
    : stream_(std::move(stream)), source_(source) {
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
                      self->send_later();
                    });
  notice_end();
}

void FrameStream::send_later() {
  if (is_sending_) return;
  ViewFrames::Later later = source_.frames.after(seen_);
  if (later.kept.empty()) return;
  seen_ = later.number;
  source_.skipped += later.skipped;
  missed_ += static_cast<std::uint32_t>(later.skipped);
  kept_ = std::move(later.kept);
  headers_.clear();
  for (const auto& each : kept_) headers_.emplace_back(each->header).missed = missed_;
  std::vector<asio::const_buffer> parts;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    parts.push_back(asio::buffer(&headers_[i], sizeof(headers_[i])));
    parts.push_back(asio::buffer(kept_[i]->points));
  }
  is_sending_ = true;
  asio::async_write(stream_, parts, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->stream_.close();
    self->is_sending_ = false;
    self->source_.sent += self->kept_.size();
    self->kept_.clear();
    self->send_later();
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
