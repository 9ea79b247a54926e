// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "packet_pacer.hpp"

#include <sys/prctl.h>

#include <algorithm>
#include <ctime>

#include "rt/measure/thread_cpu_clock.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::send {

PacketPacer::PacketPacer(double rate, memory::FixedMemory& memory, std::int64_t start_delay_ns)
    : rate_(rate),
      start_delay_ns_(start_delay_ns),
      arena_(memory.take<std::uint8_t>("packet pacer", kArenaBytes)),
      planned_(memory.take<packet::Datagram>("packet pacer", UdpSender::kBatch)) {}

void PacketPacer::add(const packet::Datagram& datagram, UdpSender& sender) noexcept {
  const std::int64_t due = due_ns(datagram.stamp_ns);
  const std::size_t bytes = datagram.payload.size();
  if (planned_count_ > 0 &&
      (due != planned_due_ns_ || &sender != sender_ || planned_count_ == planned_.size() ||
       arena_used_ + bytes > arena_.size())) {
    flush();
  }
  planned_due_ns_ = due;
  sender_ = &sender;
  const auto copy = arena_.subspan(arena_used_, std::min(bytes, arena_.size()));
  std::copy_n(datagram.payload.begin(), copy.size(), copy.begin());
  arena_used_ += copy.size();
  planned_[planned_count_] = datagram;
  planned_[planned_count_].payload = copy;
  ++planned_count_;
}

void PacketPacer::flush() noexcept {
  if (planned_count_ > 0 && !stopped()) {
    if (rate_ > 0) {
      sleep_until(planned_due_ns_);
      const std::int64_t late_ns = measure::monotonic_ns() - planned_due_ns_;
      for (std::size_t i = 0; i < planned_count_ && !stopped(); ++i) lateness_.record(late_ns);
    }
    if (!stopped()) sender_->send(planned_.first(planned_count_));
  }
  planned_count_ = 0;
  arena_used_ = 0;
}

std::int64_t PacketPacer::due_ns(std::int64_t stamp_ns) noexcept {
  if (rate_ <= 0) return 0;
  if (!begun_) {
    begun_ = true;
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    first_stamp_ns_ = stamp_ns;
    first_due_ns_ = measure::monotonic_ns() + start_delay_ns_;
    planned_due_ns_ = first_due_ns_;
  }
  constexpr double kFar_ns = 4e18;  // a rate near 0 would overflow 64 bits
  const double after_ns = static_cast<double>(stamp_ns - first_stamp_ns_) / rate_;
  const std::int64_t due =
      first_due_ns_ + static_cast<std::int64_t>(std::clamp(after_ns, 0.0, kFar_ns));
  return std::max(due, planned_due_ns_);
}

/// Sleeps in slices, so that stop() takes effect without interrupting a sleep.
void PacketPacer::sleep_until(std::int64_t due_ns) const noexcept {
  constexpr std::int64_t kSlice_ns = 100'000'000;
  for (std::int64_t now_ns = measure::monotonic_ns(); now_ns < due_ns && !stopped();
       now_ns = measure::monotonic_ns()) {
    const timespec until =
        threads::timespec_of(due_ns - now_ns > kSlice_ns ? now_ns + kSlice_ns : due_ns);
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
  }
}

}  // namespace terracut::send
