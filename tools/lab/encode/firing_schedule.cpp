// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firing_schedule.hpp"

#include <algorithm>
#include <limits>

namespace terracut::encode {
namespace {

constexpr auto kLasers = static_cast<std::size_t>(hdl64e::kHdl64eLasers);
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
/// With nothing wanted nearer than this, a firing at the nominal step comes between.
constexpr std::int64_t kMaxStep_cdeg = 2 * FiringSchedule::kNominalStep_cdeg;
constexpr int kStepTries = 8;

/// The head azimuths, in ticks, at which a laser's firing may serve a beam.
struct Window {
  std::int64_t open, close, wanted;
};

Window window(const WantedBeam& beam, std::int32_t offset_ticks, std::int32_t tolerance_ticks) {
  const std::int64_t revolution_begin = std::int64_t{beam.frame} * decode::kRevolution_ticks;
  return {std::max(beam.ticks - tolerance_ticks, revolution_begin) - offset_ticks,
          std::min(beam.ticks + tolerance_ticks, revolution_begin + decode::kRevolution_ticks - 1) -
              offset_ticks,
          beam.ticks - offset_ticks};
}

std::int64_t floor_cdeg(std::int64_t ticks) {
  return (ticks >= 0 ? ticks : ticks - decode::kTicksPerCdeg + 1) / decode::kTicksPerCdeg;
}
std::int64_t ceil_cdeg(std::int64_t ticks) {
  return -floor_cdeg(-ticks);
}

/// Where the next firing is due, given the window of every laser's next beam.
std::int64_t due_cdeg(std::span<const Window> windows) {
  std::int64_t deadline = kNever;
  for (const Window& w : windows) deadline = std::min(deadline, w.close);
  if (deadline == kNever) return kNever;
  std::array<std::int64_t, kLasers> wanted;
  std::size_t count = 0;
  std::int64_t all_open = std::numeric_limits<std::int64_t>::min();
  for (const Window& w : windows) {
    if (w.open > deadline) continue;
    all_open = std::max(all_open, w.open);
    wanted[count++] = w.wanted;
  }
  auto* const middle = wanted.data() + count / 2;
  std::nth_element(wanted.data(), middle, wanted.data() + count);
  const std::int64_t nearest = floor_cdeg(*middle + decode::kTicksPerCdeg / 2);
  return std::min(std::max(nearest, ceil_cdeg(all_open)), floor_cdeg(deadline));
}

}  // namespace

FiringSchedule::FiringSchedule(const hdl64e::BeamOffsets& offsets, std::int64_t start_cdeg)
    : offsets_(offsets),
      last_cdeg_(start_cdeg),
      step_ticks_(static_cast<std::int32_t>(kNominalStep_cdeg) * decode::kTicksPerCdeg) {}

void FiringSchedule::queue(int laser, std::span<const WantedBeam> beams) {
  Queue& queue = queues_[static_cast<std::size_t>(laser)];
  queue.beams.erase(queue.beams.begin(),
                    queue.beams.begin() + static_cast<std::ptrdiff_t>(queue.next));
  queue.next = 0;
  queue.beams.insert(queue.beams.end(), beams.begin(), beams.end());
}

void FiringSchedule::place(std::int32_t step_ticks,
                           std::array<std::int64_t, kFirings>& azimuth_cdeg) const {
  std::array<std::size_t, kLasers> next;
  for (std::size_t laser = 0; laser < kLasers; ++laser) next[laser] = queues_[laser].next;
  std::int64_t last_cdeg = last_cdeg_;
  for (std::int64_t& azimuth : azimuth_cdeg) {
    const std::int64_t earliest = (last_cdeg + kMinStep_cdeg) * decode::kTicksPerCdeg;
    std::array<Window, kLasers> windows;
    for (std::size_t laser = 0; laser < kLasers; ++laser) {
      const auto& beams = queues_[laser].beams;
      const std::int32_t offset = offsets_.offset_ticks(step_ticks, static_cast<int>(laser));
      windows[laser] = {kNever, kNever, kNever};
      for (; next[laser] < beams.size(); ++next[laser]) {
        const WantedBeam& beam = beams[next[laser]];
        const Window w = window(beam, offset, beam.tolerance_ticks);
        if (w.close < earliest) continue;  // too late for this one whatever is done
        windows[laser] = w;
        break;
      }
    }
    const std::int64_t due = due_cdeg(windows);
    azimuth = std::max(due, last_cdeg + kMinStep_cdeg);
    if (due > last_cdeg + kMaxStep_cdeg) azimuth = last_cdeg + kNominalStep_cdeg;
    for (std::size_t laser = 0; laser < kLasers; ++laser) {
      if (windows[laser].open <= azimuth * decode::kTicksPerCdeg) ++next[laser];
    }
    last_cdeg = azimuth;
  }
}

void FiringSchedule::serve(Packet& packet) {
  for (std::size_t firing = 0; firing < packet.beams.size(); ++firing) {
    const std::int64_t head = packet.azimuth_cdeg[firing] * decode::kTicksPerCdeg;
    for (std::size_t laser = 0; laser < kLasers; ++laser) {
      Queue& queue = queues_[laser];
      const std::int32_t offset = offsets_.offset_ticks(step_ticks_, static_cast<int>(laser));
      packet.beams[firing][laser] = nullptr;
      for (; queue.next < queue.beams.size(); ++queue.next) {
        const WantedBeam& beam = queue.beams[queue.next];
        const Window w = window(beam, offset, beam.tolerance_ticks + kSlack_ticks);
        if (w.open > head) break;
        if (w.close >= head) {
          packet.beams[firing][laser] = &beam;
          ++queue.next;
          break;
        }
        ++dropped_;
      }
    }
  }
}

void FiringSchedule::next(Packet& packet) {
  for (int attempt = 0; attempt < kStepTries; ++attempt) {
    place(step_ticks_, packet.azimuth_cdeg);
    const auto first = packet.azimuth_cdeg.front(), last = packet.azimuth_cdeg.back();
    const auto step = hdl64e::column_step_ticks(beams::wrap_cdeg(first), beams::wrap_cdeg(last));
    if (step == step_ticks_) break;
    step_ticks_ = step;
  }
  last_cdeg_ = packet.azimuth_cdeg.back();
  serve(packet);
}

std::size_t FiringSchedule::firings_needed(
    std::span<const std::vector<WantedBeam>, hdl64e::kHdl64eLasers> by_laser,
    const hdl64e::BeamOffsets& offsets, std::int32_t tolerance_ticks) {
  constexpr std::int32_t kNominalStep_ticks =
      static_cast<std::int32_t>(kNominalStep_cdeg) * decode::kTicksPerCdeg;
  std::array<std::size_t, kLasers> next{};
  std::array<std::int32_t, kLasers> offset{};
  std::array<Window, kLasers> windows;
  const auto load = [&](std::size_t laser) {
    windows[laser] = next[laser] < by_laser[laser].size()
                         ? window(by_laser[laser][next[laser]], offset[laser], tolerance_ticks)
                         : Window{kNever, kNever, kNever};
  };
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    offset[laser] = offsets.offset_ticks(kNominalStep_ticks, static_cast<int>(laser));
    load(laser);
  }
  for (std::size_t firings = 0;; ++firings) {
    std::int64_t deadline = kNever;
    for (const Window& w : windows) deadline = std::min(deadline, w.close);
    if (deadline == kNever) return firings;
    for (std::size_t laser = 0; laser < kLasers; ++laser) {
      if (windows[laser].open > deadline) continue;
      ++next[laser];
      load(laser);
    }
  }
}

}  // namespace terracut::encode
