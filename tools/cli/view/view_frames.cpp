// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "view_frames.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "pipeline/free_way/outline.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::cli {
namespace {

double milliseconds(std::int64_t ns) {
  return static_cast<double>(ns / 1000) / 1000;
}

/// Returns metres, rounded.
double centimetres(float metres) {
  return std::round(static_cast<double>(metres) * 100) / 100;
}

/// Copies the points, with their heights where there are any, as the wire has them.
void keep_points(std::span<const points::LabelledPoint> points, std::span<const float> heights_m,
                 ViewFrames::Kept& kept) {
  if (!heights_m.empty()) kept.header.point_bytes = stream::kPointBytesWithHeight;
  kept.points.resize(points.size() * kept.header.point_bytes);
  stream::write_points(points, heights_m, {}, kept.header.point_bytes, kept.points);
}

nlohmann::ordered_json sight_json(const visibility::SightFigures& sight) {
  nlohmann::ordered_json json{
      {"state", sight.has_learnt == 0 ? "learning" : to_string(sight.worst().state)},
      {"text", sight_text(sight)},
      {"sectors", nlohmann::ordered_json::array()}};
  for (const visibility::SightFigures::Sector& sector : sight.sectors) {
    const bool is_judged = sight.has_learnt != 0 && sector.has_view != 0;
    json["sectors"].push_back(
        {is_judged ? to_string(sector.condition.state) : "unknown", centimetres(sector.visible_m)});
  }
  return json;
}

/// Returns the scores of one set of parameters, rounded as people read them.
nlohmann::ordered_json score_json(const quality::Quality& quality) {
  const auto rounded = [](double share) { return std::round(share * 1e5) / 1e5; };
  return {{"iou_g", rounded(quality.iou_ground())},
          {"recall_o", rounded(quality.recall_key_obstacles())},
          {"missed", quality.obstacle_as_ground},
          {"false", quality.ground_as_obstacle}};
}

}  // namespace

ViewFrames::ViewFrames(const publish::RunFacts& facts, ComparedWith compared)
    : facts_(facts), compared_(std::move(compared)) {}

void ViewFrames::put(const publish::LabelledFrame& frame, const FrameComparison& comparison) {
  const std::shared_ptr<Kept> room = rooms_.take();
  const Shown of_frame = shown(frame.record);
  room->header = stream::header_of(frame.record, sensor::SensorModel::kUnknown, of_frame.missed,
                                   frame.points.size());
  keep_points(frame.points, frame.heights_m, *room);
  room->comparison = comparison.of_returns;
  const std::lock_guard lock(mutex_);
  newest_ = room;
  if (gives_sectors()) {
    const std::shared_ptr<Kept> head = sector_rooms_.take();
    head->header = stream::without_points(room->header);
    head->points.clear();
    keep_sector(head);
  }
  ++frames_put_;
  losses_ += frame.record.info.losses;
  if (finds_anything()) {
    std::vector<quality::Quality> qualities;
    for (const auto& quality : {comparison.quality, comparison.quality_beside}) {
      if (quality) qualities.push_back(*quality);
    }
    found_.push_back({frame.record.info.number, frame.objects, frame.free_way, std::move(qualities),
                      comparison.differing});
    if (found_.size() > kFramesWithFinds) found_.pop_front();
  }
  shown_.push_back(of_frame);
  if (shown_.size() > kFramesShown) shown_.pop_front();
}

void ViewFrames::put_sector(const publish::LabelledSector& sector) {
  const std::shared_ptr<Kept> room = sector_rooms_.take();
  const points::SectorRecord& record = sector.record;
  room->header = stream::header_of(record, sensor::SensorModel::kUnknown,
                                   record.labels_ns - record.first_packet_ns > facts_.deadline_ns,
                                   sector.points.size());
  keep_points(sector.points, sector.heights_m, *room);
  const std::lock_guard lock(mutex_);
  keep_sector(room);
}

void ViewFrames::keep_sector(std::shared_ptr<const Kept> sector) {
  sectors_.push_back(std::move(sector));
  if (sectors_.size() > kSectorsKept) sectors_.pop_front();
  ++sectors_put_;
}

void ViewFrames::put_figures(const status::MonitorSnapshot& figures) {
  const std::lock_guard lock(mutex_);
  run_ = figures;
}

ViewFrames::Message ViewFrames::newest() const {
  const std::lock_guard lock(mutex_);
  return {frames_put_, newest_};
}

ViewFrames::Message ViewFrames::sector_after(std::uint64_t seen) const {
  const std::lock_guard lock(mutex_);
  if (seen == sectors_put_) return {seen, nullptr};
  const std::uint64_t before_oldest = sectors_put_ - sectors_.size();
  const std::uint64_t number = std::max(seen, before_oldest) + 1;
  return {number, sectors_[number - before_oldest - 1]};
}

ViewFrames::Shown ViewFrames::shown(const status::FrameRecord& record) const noexcept {
  if (facts_.deadline_ns == 0) {
    return {milliseconds(record.decode_cpu_ns + record.stages.sum_ns()), record.level, false};
  }
  const std::int64_t latency_ns = record.labels_ns - record.info.last_packet_ns;
  return {milliseconds(latency_ns), record.level, latency_ns > facts_.deadline_ns};
}

nlohmann::ordered_json ViewFrames::found(std::uint32_t frame) const {
  nlohmann::ordered_json json;
  json["boxes"] = json["free_way"] = nlohmann::ordered_json::array();
  if (compared_.any()) json["scores"] = nlohmann::ordered_json::array();
  const std::lock_guard lock(mutex_);
  const auto of_frame = std::find_if(found_.rbegin(), found_.rend(),
                                     [&](const Found& kept) { return kept.frame == frame; });
  if (of_frame == found_.rend()) return json;
  for (const objects::Object& object : of_frame->objects) {
    nlohmann::ordered_json corners = nlohmann::ordered_json::array();
    for (const objects::Corner& corner : object.box.corners()) {
      corners.push_back({centimetres(corner.x_m), centimetres(corner.y_m)});
    }
    json["boxes"].push_back({{"corners", std::move(corners)},
                             {"bottom_m", centimetres(object.ground_z_m + object.bottom_m)},
                             {"top_m", centimetres(object.ground_z_m + object.top_m)}});
  }
  for (const Corner& corner : free_way::outline(of_frame->free_way)) {
    json["free_way"].push_back({centimetres(corner.x_m), centimetres(corner.y_m)});
  }
  for (const quality::Quality& quality : of_frame->qualities) {
    json["scores"].push_back(score_json(quality));
  }
  if (!compared_.beside.empty()) json["differing"] = of_frame->differing;
  return json;
}

nlohmann::ordered_json ViewFrames::figures() const {
  nlohmann::ordered_json json;
  const std::lock_guard lock(mutex_);
  json["sensor"] = facts_.sensor;
  json["rows"] = facts_.rows;
  json["sensor_height_m"] = std::round(facts_.mount.height_m * 100) / 100;
  json["objects"] = facts_.found.objects;
  json["free_way"] = facts_.found.free_way;
  json["compared"] = nullptr;
  if (compared_.any()) {
    json["compared"] = {{"truth", compared_.truth},
                        {"names", nlohmann::json::array({compared_.name})}};
    if (!compared_.beside.empty()) json["compared"]["names"].push_back(compared_.beside);
  }
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
  if (run_->sight.is_watched != 0) json["sight"] = sight_json(run_->sight);
  return json;
}

}  // namespace terracut::cli
