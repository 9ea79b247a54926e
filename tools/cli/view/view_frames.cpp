// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "view_frames.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pipeline/status/loss_causes.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::cli {
namespace {

double milliseconds(std::int64_t ns) {
  return static_cast<double>(ns / 1000) / 1000;
}

}  // namespace

ViewFrames::ViewFrames(const publish::RunFacts& facts) : facts_(facts) {}

template <class Record>
void ViewFrames::keep(const Record& record, bool late,
                      std::span<const points::LabelledPoint> points) {
  const std::shared_ptr<Kept> room = rooms_.take();
  room->points.resize(points.size());
  std::ranges::transform(points, room->points.begin(), stream::wire_point);
  room->header = stream::header_of(record, sensor::SensorModel::kUnknown, late, points.size());
  const std::lock_guard lock(mutex_);
  if (kept_.size() == (gives_sectors() ? kSectorsKept : 1)) kept_.pop_front();
  kept_.push_back(room);
  ++number_;
}

void ViewFrames::put_sector(const publish::LabelledSector& sector) {
  const std::int64_t wait_ns = sector.record.labels_ns - sector.record.first_packet_ns;
  keep(sector.record, wait_ns > facts_.deadline_ns, sector.points);
}

void ViewFrames::put(const publish::LabelledFrame& frame) {
  const Shown of_frame = shown(frame.record);
  if (!gives_sectors()) keep(frame.record, of_frame.missed, frame.points);
  const std::lock_guard lock(mutex_);
  losses_ += frame.record.info.losses;
  shown_.push_back(of_frame);
  if (shown_.size() > kFramesShown) shown_.pop_front();
}

void ViewFrames::put_figures(const status::MonitorSnapshot& figures) {
  const std::lock_guard lock(mutex_);
  run_ = figures;
}

ViewFrames::Later ViewFrames::after(std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  const std::uint64_t came = number_ - number;
  const std::size_t kept = std::min<std::uint64_t>(came, kept_.size());
  return {number_,
          {kept_.end() - static_cast<std::ptrdiff_t>(kept), kept_.end()},
          number == 0 ? 0 : came - kept};
}

ViewFrames::Shown ViewFrames::shown(const status::FrameRecord& record) const noexcept {
  if (facts_.deadline_ns == 0) {
    return {milliseconds(record.decode_cpu_ns + record.stages.sum_ns()), record.level, false};
  }
  const std::int64_t latency_ns = record.labels_ns - record.info.last_packet_ns;
  return {milliseconds(latency_ns), record.level, latency_ns > facts_.deadline_ns};
}

nlohmann::ordered_json ViewFrames::figures() const {
  nlohmann::ordered_json json;
  const std::lock_guard lock(mutex_);
  json["sensor"] = facts_.sensor;
  json["rows"] = facts_.rows;
  json["deadline_ms"] = nullptr;
  if (facts_.deadline_ns > 0) json["deadline_ms"] = milliseconds(facts_.deadline_ns);
  json["frames"] = nlohmann::ordered_json::array();
  for (const Shown& frame : shown_) {
    json["frames"].push_back({frame.ms, static_cast<int>(frame.level), frame.missed});
  }
  json["losses"] = json["onlookers"] = nlohmann::ordered_json::array();
  const auto add = [&](std::string_view cause, std::uint64_t count) {
    if (count == 0) return;
    json[status::is_of_onlookers(cause) ? "onlookers" : "losses"].push_back({cause, count});
  };
  if (!run_) {
    for (const status::NamedCount& loss : status::causes_of(losses_)) {
      add(loss.name.view(), loss.count);
    }
    return json;
  }
  if (run_->link != status::LinkState::kReceiving && run_->last_packet_ns != 0) {
    json["silent_s"] = milliseconds(measure::realtime_ns() - run_->last_packet_ns) / 1000;
  }
  add("deadlines_missed", run_->all_misses());
  add("frames_skipped", run_->levels[static_cast<std::size_t>(status::Level::kSkipped)]);
  for (const status::NamedCount& loss : run_->losses_in_use()) add(loss.name.view(), loss.count);
  return json;
}

}  // namespace terracut::cli
