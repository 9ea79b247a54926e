// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "stream_writer.hpp"

#include <utility>

namespace terracut::run {

StreamWriter::StreamWriter(stream::FrameStreamServer server, stream::StreamedSensor sensor,
                           std::int64_t deadline_ns, Slots& slots, const threads::WakeEvent& ready)
    : server_(std::move(server)),
      sensor_(sensor),
      deadline_ns_(deadline_ns),
      slots_(slots),
      ready_(ready),
      thread_([this] { work(); }) {}

bool StreamWriter::finish(std::chrono::milliseconds patience) {
  finish_ = true;
  ready_.wake();
  return thread_.ends_within(patience);
}

void StreamWriter::work() {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  while (!finish_) {
    (void)ready_.wait(server_.descriptor(), kSecond_ns);
    for (Slots::Frame frame; slots_.take(frame);) slots_.give_back(serve(frame));
    server_.work_round();
    figures_.publish(server_.figures());
  }
}

bool StreamWriter::serve(const Slots::Frame& frame) {
  const std::int64_t latency_ns = frame.record.labels_ns - frame.record.info.last_packet_ns;
  return server_.serve({.record = frame.record,
                        .sensor = sensor_,
                        .late = latency_ns > deadline_ns_,
                        .points = frame.items});
}

}  // namespace terracut::run
