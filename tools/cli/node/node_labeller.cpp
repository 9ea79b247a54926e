// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "node_labeller.hpp"

#include <fmt/format.h>

#include <utility>

#include "calib/beams/angle.hpp"
#include "firmware_io/cloud/cloud_to_image.hpp"
#include "firmware_io/cloud/elevation_bins.hpp"
#include "firmware_io/cloud/row_doubt.hpp"
#include "pipeline/ground/mount_search.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/settings/setup_choice.hpp"

namespace terracut::cli {
namespace {

using measure::SystemClock;

}  // namespace

NodeLabeller::NodeLabeller(const Options& options)
    : options_(options),
      stated_(options.mount),
      deadline_ns_(static_cast<std::int64_t>(options.deadline_ms * 1e6)),
      degradation_(deadline_ns_) {}

bool NodeLabeller::has_places() const noexcept {
  return cloud::has_places(cloud_.points);
}

bool NodeLabeller::learn_from_cloud() {
  kept_.push_back(cloud_);
  return kept_.size() >= (is_mount_open() ? mount::kFramesToFind : 1);
}

Status NodeLabeller::set_up() {
  const std::vector<cloud::Cloud> clouds = std::exchange(kept_, {});
  const auto rows = cloud::learn_rows_or_bins(
      clouds.size(), [&](std::size_t i) -> Expected<cloud::CloudView> { return clouds[i].view(); });
  if (!rows) return tl::unexpected(rows.error());
  const scan::RingTable& table = rows->rings.table;
  sensor_ = fmt::format("{} rows by {}", table.size(), description_of(rows->source));
  say(fmt::format("sensor: {}, from {:.1f} to {:.1f} degrees, {} columns", sensor_,
                  beams::rad_to_deg(table.back().elevation_rad),
                  beams::rad_to_deg(table.front().elevation_rad), rows->columns));
  if (const std::string doubt = cloud::doubt_of(*rows); !doubt.empty()) warn(doubt);
  MountChoice choice{.options = stated_};
  if (is_mount_open()) {
    choice = *choose_mount(guessing(stated_), mount_search(clouds, *rows).finder());
  }
  const auto profile = ring_profile_of(table, choice.options);
  if (!profile) return tl::unexpected(profile.error());
  mount_ = profile->mount;
  pipeline_.emplace(*rows, *profile, method_of(options_.method));
  if (const scene::Wanted wanted = options_.method.scene; wanted.any()) {
    const frame::RangeImage& image = pipeline_->image();
    scene_.emplace(wanted, *profile, image.shape(), image.return_capacity(), scene_memory_);
  }
  watch_.emplace(profile->mount, choice);
  return {};
}

ground::MountSearch NodeLabeller::mount_search(const std::vector<cloud::Cloud>& clouds,
                                               const cloud::SensorRows& rows) {
  memory::FixedMemory memory;
  cloud::CloudToImage to_image(rows, mount::kAtTheSensor, memory);
  ground::MountSearch search;
  for (const cloud::Cloud& cloud : clouds) {
    if (to_image.place(cloud.view())) search.add_frame(to_image.image());
  }
  return search;
}

bool NodeLabeller::skip_if_late(status::FrameRecord& record) const noexcept {
  const std::int64_t now_ns = SystemClock().realtime_ns();
  if (!is_ready() || now_ns < record.info.last_packet_ns + deadline_ns_) return false;
  record.level = status::Level::kSkipped;
  record.labels_ns = now_ns;
  return true;
}

Status NodeLabeller::label(status::FrameRecord& record) {
  const SystemClock clock;
  const bool is_timed = record.info.last_packet_ns != 0;
  if (is_timed && !degradation_.begin(record.info.last_packet_ns)) {
    record.level = status::Level::kSkipped;
    record.labels_ns = clock.realtime_ns();
    return {};
  }
  const std::int64_t begun_cpu_ns = clock.thread_cpu_ns();
  const Status labelled = pipeline_->label(cloud_.view(), record,
                                           is_timed ? degradation_.budget() : min_cut::CutBudget{});
  record.segment_cpu_ns = clock.thread_cpu_ns() - begun_cpu_ns;
  record.labels_ns = clock.realtime_ns();
  if (!labelled) return labelled;
  record.level = decltype(degradation_)::level_of(record.segmentation);
  if (!is_timed) return {};
  if (!degradation_.may_hand_on()) record.level = status::Level::kSkipped;
  // The time outside the stages counts as well: before them rows are found, after them points get
  // their labels.
  degradation_.end(record.stages, record.segmentation,
                   record.segment_cpu_ns - record.stages.sum_ns());
  return {};
}

void NodeLabeller::find_scene(publish::LabelledFrame& scene) {
  scene_->find(pipeline_->image(), pipeline_->labels(), pipeline_->heights_m());
  publish::set_scene(*scene_, scene);
}

void NodeLabeller::watch_mount() {
  watch_->add_frame(pipeline_->image());
}

}  // namespace terracut::cli
