// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "played_clouds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/points/labelled_points.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/input/recorded_frames.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

constexpr std::int64_t kPeriod_ns = 100'000'000;

}  // namespace

Expected<std::unique_ptr<PlayedClouds>> PlayedClouds::open(const std::filesystem::path& clouds,
                                                           const Options& options, FrameTruth truth,
                                                           const MethodOptions* beside) {
  auto reader = CloudReader::open(clouds, options.capture.topic);
  if (!reader) return tl::unexpected(reader.error());
  std::unique_ptr<PlayedClouds> opened(new PlayedClouds(*std::move(reader), std::move(truth)));
  const auto rows = rows_of(opened->reader_, options.capture.calibration);
  if (!rows) return tl::unexpected(rows.error());
  CloudFrames frames(opened->reader_, *rows);
  const auto mount = choose_mount(opened->reader_.stated(options.mount), frames);
  if (!mount) return tl::unexpected(mount.error());
  const auto profile = ring_profile_of(rows->rings.table, mount->options);
  if (!profile) return tl::unexpected(profile.error());
  opened->sensor_line_ = fmt::format("{} rows of clouds", rows->rings.table.size());
  opened->mount_ = profile->mount;
  opened->pipeline_ =
      std::make_unique<run::CloudPipeline>(*rows, *profile, method_of(options.method));
  if (beside != nullptr) {
    const frame::RangeImage& image = opened->pipeline_->image();
    opened->beside_ =
        method_of(*beside)({*profile, image.shape(), image.return_capacity()}, opened->memory_);
  }
  if (const scene::Wanted wanted = options.method.scene; wanted.any()) {
    const frame::RangeImage& image = opened->pipeline_->image();
    opened->scene_.emplace(wanted, *profile, image.shape(), image.return_capacity(),
                           opened->memory_);
  }
  return opened;
}

double PlayedClouds::frame_s() const {
  return static_cast<double>(kPeriod_ns) * 1e-9;
}

std::optional<PlayedRecording::Span> PlayedClouds::next() {
  while (next_ < reader_.size() && !stop_wanted()) {
    const std::size_t index = next_++;
    if (const Status labelled = label(index); !labelled) {
      trouble_ = labelled.error().message;
      warn(trouble_);
      continue;
    }
    const auto begin_ns = static_cast<std::int64_t>(index) * kPeriod_ns;
    return Span{begin_ns, begin_ns + kPeriod_ns - 1};
  }
  return std::nullopt;
}

Status PlayedClouds::label(std::size_t index) {
  const auto cloud = reader_.read(index);
  if (!cloud) return tl::unexpected(cloud.error());
  record_ = {};
  record_.info.complete = true;
  record_.info.number = reader_.number(index);
  // Players of recordings expect stamps that rise from frame to frame.
  record_.info.first_packet_ns = static_cast<std::int64_t>(index + 1) * kPeriod_ns;
  record_.info.last_packet_ns = record_.info.first_packet_ns;
  if (const Status labelled = pipeline_->label(*cloud, record_); !labelled) {
    return fail(labelled.error().code, reader_.place(index) + ": " + labelled.error().message);
  }
  if (beside_) (void)beside_->segment(pipeline_->image());
  read_truth(index, cloud->points.size());
  return {};
}

void PlayedClouds::read_truth(std::size_t index, std::size_t points) {
  point_truth_.clear();
  if (!truth_.exists()) {
    truth_read_ = reader_.read_labels(index, points, point_truth_);
  } else {
    truth_read_ = truth_.read(reader_.name(index), points);
    point_truth_.assign(truth_.labels().begin(), truth_.labels().end());
  }
  if (!truth_read_) point_truth_.clear();
}

Status PlayedClouds::take(PlayedFrame& frame) {
  frame.record = record_;
  frame.points.resize(pipeline_->image().returns());
  (void)points::pack_labelled_points(pipeline_->image(), pipeline_->labels(), frame.points);
  const std::span<const float> heights_m = pipeline_->heights_m();
  frame.heights_m.assign(heights_m.begin(), heights_m.end());
  if (scene_) {
    scene_->find(pipeline_->image(), pipeline_->labels(), heights_m);
    publish::set_scene(*scene_, frame);
  }
  compare(pipeline_->labels(), beside_ ? beside_->labels() : std::span<const frame::Label>(),
          pipeline_->truth_of_returns(point_truth_), frame.comparison);
  return doubt_.judge(truth_read_);
}

Status PlayedClouds::go_to(double seek_s) {
  const double index = std::round(std::max(seek_s, 0.0) / frame_s());
  next_ = static_cast<std::size_t>(std::min(index, static_cast<double>(reader_.size() - 1)));
  return {};
}

Status PlayedClouds::conclude() {
  return fail(ErrorCode::kNothingCameOut,
              fmt::format("none of the {} clouds could be labelled; the last: {}", reader_.size(),
                          trouble_));
}

void PlayedClouds::measure(const OnLength& on_length) const {
  (void)on_length(kPeriod_ns, static_cast<std::int64_t>(reader_.size()) * kPeriod_ns);
}

}  // namespace terracut::cli
