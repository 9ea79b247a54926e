// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "frame_outlet.hpp"

#include <string_view>
#include <utility>

#include "rt/caught.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::live {

FrameOutlet::FrameOutlet(std::optional<Stream> stream, publish::Publisher& publisher, Slots& slots,
                         SectorPool* sectors, const threads::WakeEvent& ready, Finders finders)
    : stream_(std::move(stream)),
      publisher_(publisher),
      slots_(slots),
      sectors_(sectors),
      ready_(ready),
      finders_(std::move(finders)),
      // A failure of this thread needs no handler: the slots count the frames that nobody takes.
      thread_([this] { work(); }, [](std::string_view) {}) {}

bool FrameOutlet::finish(std::chrono::milliseconds patience) {
  begin_to_finish();
  return thread_.ends_within(patience);
}

void FrameOutlet::begin_to_finish() {
  finish_ = true;
  ready_.wake();
}

void FrameOutlet::work() {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  if (finders_.sight != nullptr) sight_figures_.publish(finders_.sight->found().sight());
  while (true) {
    const bool last_round = finish_;
    hand_out_sectors();
    for (Slots::Frame frame; slots_.take(frame);) {
      hand_out_sectors();  // those of a frame come before it
      const bool is_handed_out = hand_out(frame);
      look(frame);
      slots_.give_back(is_handed_out);
    }
    stream::FrameStreamServer* const open = server();
    if (open != nullptr) {
      open->work_round();
      figures_.publish(open->figures());
    }
    if (last_round) return;
    (void)ready_.wait(open != nullptr ? open->descriptor() : -1, kSecond_ns);
  }
}

void FrameOutlet::hand_out_sectors() {
  if (sectors_ == nullptr) return;
  for (SectorPool::Frame sector; sectors_->take(sector);) {
    const bool served = !stream_ || !stream_->serves_sectors || stream(sector);
    sectors_->give_back(served && publish(sector));
  }
}

bool FrameOutlet::publish(const SectorPool::Frame& sector) {
  if (!publisher_.wants_sectors()) return true;
  return rt::caught([&]() -> Status {
           const auto shared = std::make_shared<publish::LabelledSector>();
           shared->record = sector.record;
           shared->points.assign(sector.items.begin(), sector.items.end());
           shared->heights_m.assign(sector.heights_m.begin(), sector.heights_m.end());
           find_complete_objects(*shared);
           publisher_.put_sector(shared);
           return {};
         })
      .has_value();
}

void FrameOutlet::find_complete_objects(publish::LabelledSector& sector) {
  if (finders_.complete == nullptr) return;
  const auto objects = finders_.complete->take(sector.record, sector.points, sector.heights_m);
  sector.objects.assign(objects.begin(), objects.end());
  const std::int64_t now_ns = measure::realtime_ns();
  for (const CompleteObject& of : objects) waits_.record(now_ns - of.last_packet_ns);
}

bool FrameOutlet::stream(const Slots::Frame& frame) {
  const status::FrameRecord& record = frame.record;
  const bool late = record.labels_ns - record.info.last_packet_ns > stream_->deadline_ns;
  return stream({stream::header_of(record, stream_->sensor, late, frame.items.size()), frame.items,
                 frame.heights_m,
                 stream_->serves_objects ? finders_.scene->found().object_of_return()
                                         : std::span<const std::uint16_t>()},
                while_closed_);
}

bool FrameOutlet::stream(const SectorPool::Frame& sector) {
  const points::SectorRecord& record = sector.record;
  const bool late = record.labels_ns - record.first_packet_ns > stream_->deadline_ns;
  return stream({stream::header_of(record, stream_->sensor, late, sector.items.size()),
                 sector.items,
                 sector.heights_m,
                 {}},
                sectors_while_closed_);
}

bool FrameOutlet::stream(const stream::LabelledFrame& frame,
                         std::atomic<std::uint64_t>& while_closed) {
  stream::FrameStreamServer* const open = server();
  if (open == nullptr) {
    ++while_closed;
    return true;
  }
  return open->serve(frame);
}

void FrameOutlet::look(const Slots::Frame& frame) {
  if (finders_.complete != nullptr) object_waits_.publish(waits_);
  if (finders_.sight == nullptr) return;
  finders_.sight->find(frame.record.info, frame.items, frame.heights_m);
  sight_figures_.publish(finders_.sight->found().sight());
}

void FrameOutlet::find_scene(const Slots::Frame& frame) {
  if (finders_.scene == nullptr) return;
  finders_.scene->find(frame.record.info, frame.items, frame.heights_m);
}

bool FrameOutlet::hand_out(const Slots::Frame& frame) {
  const bool has_objects_first = stream_ && stream_->serves_objects;
  if (has_objects_first) find_scene(frame);
  const bool served = !stream_ || stream(frame);
  if (!publisher_.has_sinks()) return served;
  if (!has_objects_first) find_scene(frame);
  const Status published = rt::caught([&]() -> Status {
    const auto shared = publisher_.buffer();
    shared->record = frame.record;
    shared->points.assign(frame.items.begin(), frame.items.end());
    shared->heights_m.assign(frame.heights_m.begin(), frame.heights_m.end());
    if (finders_.scene != nullptr) publish::set_scene(finders_.scene->found(), *shared);
    publisher_.put(shared);
    return {};
  });
  return served && published;
}

}  // namespace terracut::live
