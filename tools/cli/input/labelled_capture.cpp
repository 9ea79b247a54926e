// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "labelled_capture.hpp"

#include <fmt/format.h>

#include <utility>

#include "firmware_io/sensor/told_table.hpp"
#include "pipeline/live/latest_near_ground.hpp"
#include "recorded_frames.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/settings/setup_choice.hpp"

namespace terracut::cli {

Expected<std::unique_ptr<LabelledCapture>> LabelledCapture::open(const Options& options,
                                                                 Makes makes) {
  std::unique_ptr<LabelledCapture> opened(new LabelledCapture(options));
  if (Status ready = opened->prepare(makes); !ready) return tl::unexpected(ready.error());
  return opened;
}

bool LabelledCapture::is_watched(std::uint32_t frame) noexcept {
  return frame % live::LatestNearGround::kFramesApart == 0;
}

Status LabelledCapture::prepare(Makes makes) {
  auto capture = open_capture(options_.capture);
  if (!capture) return tl::unexpected(capture.error());
  capture_ = *std::move(capture);
  options_.mount = stated_or_of_bag(options_.mount, capture_->bag_pose);
  CaptureFrames frames(*capture_, options_);
  auto mount = choose_mount(options_.mount, frames);
  if (!mount && !frames.fault().empty()) mount.error().message += "; " + frames.fault();
  if (!mount) return tl::unexpected(mount.error());
  mount_choice_ = *mount;
  const auto profile = ring_profile_of(capture_->calibration, mount->options);
  if (!profile) return tl::unexpected(profile.error());
  if (!options_.can_recording.empty()) {
    auto motion = RecordedMotion::open(options_, motion_memory_);
    if (!motion) return tl::unexpected(motion.error());
    motion_.emplace(*std::move(motion));
  }
  const bool is_moved_and_looked_at =
      makes == Makes::kPoints && motion_ && options_.method.scene.free_way;
  pipeline_.emplace(
      capture_->calibration, *profile,
      decoder_config_of(options_, capture_->sensor.columns, motion_ ? &motion_->motion() : nullptr),
      turn_method_of(options_.method), memory_, is_moved_and_looked_at ? Makes::kBoth : makes);
  pipeline_->watch_near_ground(near_ground_.get());
  clock_of_device_.emplace(options_.capture.clock_offset_s);
  profile_ = *profile;
  mount_.emplace(profile_.mount, *mount);
  report_ = {"replay", options_.capture.file.string(), capture_->sensor_line,
             capture_->calibration_line, options_.method};
  if (motion_) report_.motion_samples = 0;
  if (!options_.output.json.empty()) report_.entries.emplace(options_.output.json);
  part_.emplace(capture_->source, options_.capture);
  return {};
}

Status LabelledCapture::rewind(std::optional<double> start_s) {
  if (!ended_) pipeline_->end_stream();
  gives_frames_ = gives_frames_ || !ended_;
  while (gives_frames_ && pipeline_->next() != nullptr) {
  }
  gives_frames_ = false;
  if (Status status = capture_->source.rewind(); !status) return status;
  if (motion_) {
    if (Status status = motion_->restart(); !status) return status;
  }
  CaptureOptions from = options_.capture;
  if (start_s && from.duration_s) *from.duration_s += from.start_s - *start_s;
  if (start_s) from.start_s = *start_s;
  account_.before_start += part_->before_start();
  account_.behind_end += part_->behind_end();
  part_.emplace(capture_->source, from);
  pushed_ = nullptr;
  ended_ = false;
  return {};
}

const run::Frame* LabelledCapture::next() {
  for (;;) {
    run::Frame* frame = gives_frames_ ? pipeline_->next() : nullptr;
    if (frame != nullptr) {
      report_.add(frame->record);
      const std::uint32_t number = frame->record.info.number;
      if (is_watched(number)) mount_->add_frame(*near_ground_);
      pipeline_->watch_near_ground(is_watched(number + 1) ? near_ground_.get() : nullptr);
      return frame;
    }
    gives_frames_ = false;
    if (pushed_ != nullptr && !pipeline_->rejected()) note_packet(*pushed_);
    if (pushed_ != nullptr && pipeline_->rejected() == frame::Reject::kDeviceInfo) {
      ++account_.device_info;
    }
    pushed_ = nullptr;
    if (ended_) return nullptr;
    if (!decode_one()) {
      ended_ = true;
      pipeline_->end_stream();
    }
    gives_frames_ = true;
  }
}

bool LabelledCapture::decode_one() {
  pushed_ = part_->next();
  if (pushed_ == nullptr) {
    report_.interrupted = part_->stopped();
    report_.input_warning = part_->fault();
    if (!warned_of_part_) part_->warn_of_oddities();
    warned_of_part_ = true;
    return false;
  }
  if (wait_) wait_(pushed_->stamp_ns);
  if (motion_) motion_->hear_until(pushed_->stamp_ns);
  ++offered_;
  pipeline_->push(*pushed_);
  return true;
}

void LabelledCapture::note_packet(const packet::Datagram& datagram) {
  clock_of_device_->note(pipeline_->decoder(), datagram.stamp_ns);
  const auto* packet = hdl64e::packet_in(datagram.payload);
  if (packet != nullptr && hdl64e::is_hdl64e(*packet)) {
    status_.add(packet->status_type, packet->status_value, packet->stamp_us.value());
  }
}

capture::CaptureAccount LabelledCapture::account() const {
  capture::CaptureAccount account = account_;
  account.read = capture_->source.counters();
  account.before_start += part_->before_start();
  account.behind_end += part_->behind_end();
  account.decoded = decoder().packets_decoded();
  account.losses = decoder().losses();
  return account;
}

Status LabelledCapture::conclude() {
  const frame::LossCounters losses = pipeline_->decoder().losses();
  if (report_.totals.frames == 0) {
    return tl::unexpected(nothing_came_out(capture_->source, *part_, offered_, decoder()));
  }
  if (const std::string other = sensor::other_table_warning(status_, capture_->calibration);
      !other.empty()) {
    warn(other);
  }
  warn_of_other_senders(*capture_, capture_->source.counters(), options_.capture);
  report_.losses = losses;
  report_.datagrams = account();
  report_.blind = pipeline_->decoder().blind();
  report_.mount = mount_->figures();
  if (clock_of_device_->noted()) {
    report_.device_clock = clock_of_device_->text();
    if (const std::string warning = clock_of_device_->warning(); !warning.empty()) warn(warning);
  }
  if (!motion_) return {};
  report_.motion_samples = motion_->samples();
  if (const std::string warnings = motion_->warnings(); !warnings.empty()) warn(warnings);
  if (report_.totals.deskewed > 0) return {};
  return fail(ErrorCode::kMalformed,
              fmt::format("{}: none of the {} frames could be deskewed; is it of "
                          "this drive, its stamps on the clock of the capture's?",
                          options_.can_recording.string(), report_.totals.frames));
}

}  // namespace terracut::cli
